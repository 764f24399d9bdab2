// SPDX-License-Identifier: GPL-2.0-or-later
// Borders that lie side by side, or stand on faces, and become edges: counts and lengths of theory, feet.
#include "geometry_io/cad_sewing.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numeric>

#include "brep/builder.h"
#include "brep/foot_search.h"
#include "geometry_io/cad_measures.h"
#include "geometry_io/step_reader.h"
#include "parts.h"
#include "reader_files.h"
#include "write_files.h"

namespace {

using brep::CadFace;
using brep::CadModel;
using brep::Vector3;
using step_parts::check_borders;
using testing::HasSubstr;

class Sewing : public step_parts::Files {
 protected:
  using Kind = geometry_io::EdgeMeasure::Kind;

  CadModel read_part(const std::string& file) const {
    for (const step_parts::Part& part : step_parts::border_parts())
      if (part.file == file) step_parts::write(part, path(""));
    return geometry_io::read_step(bytes(file));
  }

  // How many edges there are of every kind, and how long all free ones are.
  struct Edges {
    int free = 0, smooth = 0, sharp = 0, many = 0;
    double free_length = 0.0;
  };
  static Edges edges_of(const CadModel& model) {
    Edges edges;
    const std::vector<geometry_io::EdgeMeasure> measured = geometry_io::measured_edges(model);
    for (std::size_t e = 0; e < measured.size(); ++e) {
      const brep::CadEdge& edge = model.edges[e];
      edges.free += measured[e].kind == Kind::free;
      edges.smooth += measured[e].kind == Kind::smooth;
      edges.sharp += measured[e].kind == Kind::sharp;
      edges.many += measured[e].kind == Kind::many;
      if (measured[e].kind == Kind::free)
        edges.free_length += edge.length * (edge.kind == brep::CadEdge::Kind::circle ? edge.R : 1.0);
    }
    return edges;
  }

  static int feet_near(const CadModel& model, const Vector3& d, double reach) {
    std::vector<int> all(model.faces.size());
    std::iota(all.begin(), all.end(), 0);
    const brep::Surface wall = brep::from_cad(model, all);
    const brep::FootSearch search(wall);
    std::vector<int> near;
    std::vector<brep::Foot> feet;
    search.near(d, reach, near);
    search.feet(d, reach, near.data(), static_cast<int>(near.size()), feet);
    return static_cast<int>(feet.size());
  }
};

// Four faces of a trough with three borders that miss each other by 0.01 mm; its other ten edges stay free.
TEST_F(Sewing, GapsAreSewn) {
  const CadModel model = read_part("gaps.step");
  EXPECT_THAT(model.healed, testing::Contains(HasSubstr("sewn along 3 edges, over gaps up to 0.0141 mm")));
  int smooth = 0, sharp = 0, free = 0;
  for (const geometry_io::EdgeMeasure& edge : geometry_io::measured_edges(model)) {
    smooth += edge.kind == Kind::smooth, sharp += edge.kind == Kind::sharp, free += edge.kind == Kind::free;
    if (edge.kind == Kind::free) continue;
    EXPECT_NEAR(edge.gap, 0.01, 0.005);
  }
  EXPECT_EQ(smooth, 2);
  EXPECT_EQ(sharp, 1);
  EXPECT_EQ(free, 10);
  // What faces are called is what they are in the file.
  ASSERT_EQ(model.faces.size(), 4u);
  EXPECT_TRUE(model.faces[1].shape.kind == brep::Kind::cylinder);
  for (int f = 0; f < 4; ++f) EXPECT_GT(model.faces[f].entity, 0);
}

// The border of the first plate is cut where those of the others end, nowhere else.
TEST_F(Sewing, UnequalBordersAreSewn) {
  const CadModel model = read_part("unequal_plates.step");
  int smooth = 0, sharp = 0;
  double free = 0.0;
  const std::vector<geometry_io::EdgeMeasure> measured = geometry_io::measured_edges(model);
  ASSERT_EQ(measured.size(), 20u);
  for (std::size_t e = 0; e < measured.size(); ++e) {
    smooth += measured[e].kind == Kind::smooth, sharp += measured[e].kind == Kind::sharp;
    if (measured[e].kind == Kind::free) free += model.edges[e].length;
    EXPECT_GT(model.edges[e].length, 9.9);
    EXPECT_LE(measured[e].gap, 0.0151);
  }
  EXPECT_EQ(smooth, 4);
  EXPECT_EQ(sharp, 1);
  const double all = 220.0 + 180.0 + 2.0 * (25.0 + std::hypot(30.0, 10.0)) + 100.0 + 120.0;
  EXPECT_NEAR(free, all - 2.0 * (40.0 + 25.0 + 20.0 + 30.0 + 30.0), 1e-9);
  for (const CadFace& face : model.faces) check_borders(model, face);
}

// Closed borders are cut where those beside them begin.
TEST_F(Sewing, AHoleIsPatched) {
  const CadModel model = read_part("patched_hole.step");
  const Edges edges = edges_of(model);
  EXPECT_EQ(edges.smooth, 2);
  EXPECT_EQ(edges.free, 4);
  EXPECT_NEAR(edges.free_length, 320.0, 1e-9);
  double area = 0.0;
  for (const CadFace& face : model.faces) {
    check_borders(model, face);
    area += geometry_io::area_of(model, face);
  }
  EXPECT_NEAR(area, 6000.0 - M_PI * (15.0 * 15.0 - 14.99 * 14.99), 1e-6);
}

// Sheets that touch are sewn to each other, and are still what they were.
TEST_F(Sewing, LooseFacesAreSewn) {
  const CadModel model = read_part("loose_faces.step");
  const Edges edges = edges_of(model);
  EXPECT_EQ(edges.sharp, 12);
  EXPECT_EQ(edges.free, 0);
  EXPECT_EQ(model.vertices.size(), 8u);
  ASSERT_EQ(model.solids.size(), 6u);
  for (int f = 0; f < 6; ++f) EXPECT_EQ(model.faces[f].solid, f);
}

TEST_F(Sewing, PagesOfABookAreNotSewn) {
  const CadModel model = read_part("parallel_plates.step");
  EXPECT_EQ(model.edges.size(), 12u);
  EXPECT_EQ(model.vertices.size(), 12u);
  for (const char* word : {"sewn", "joined"})
    EXPECT_THAT(model.healed, testing::Not(testing::Contains(HasSubstr(word))));
}

// Under a plate on which another one stands there is one contact, in both corners above there are two.
TEST_F(Sewing, TheFootOfATeeIsAnEdge) {
  const CadModel model = read_part("tee.step");
  EXPECT_THAT(model.healed, testing::Contains(HasSubstr("joined to faces that it stands on along 1 edges")));
  const Edges edges = edges_of(model);
  EXPECT_EQ(edges.many, 1);
  EXPECT_NEAR(edges.free_length, 320.0 + 200.0 - 60.0, 1e-9);
  for (const CadFace& face : model.faces) check_borders(model, face);
  for (const double beside : {-1.0, -0.01, -1e-3, 0.0, 1e-3, 0.01, 1.0})
    for (const double along : {0.02, 1.0, 30.0, 59.0, 59.98})
      EXPECT_EQ(feet_near(model, {50.0 + beside, along, -2.0}, 2.5), 1) << beside << " " << along;
  for (const double beside : {-1.0, -0.1, 0.1, 1.0})
    EXPECT_EQ(feet_near(model, {50.0 + beside, 30.0, 1.0}, 1.5), 2) << beside;
}

// Cut at borders that they cross, slits, loops; areas stay what they were.
TEST_F(Sewing, FacesStandOnOthers) {
  const CadModel model = read_part("standing_faces.step");
  const Edges edges = edges_of(model);
  EXPECT_EQ(edges.many, 6);
  EXPECT_EQ(edges.sharp, 2);   // gutter and plate, the angle's corner
  EXPECT_EQ(edges.smooth, 3);  // of the plate, in two parts, and the tube's seam
  const double around = 2.0 * M_PI * 12.0, slope = std::hypot(4.0, 30.0);
  const double feet = 80.0 + 25.0 + 20.0 + around + 30.0, sewn = 60.0 + 60.0 + 20.0;
  const double all =
      240.0 + 200.0 + 2.0 * (90.0 + slope) + 90.0 + 80.0 + 2.0 * around + 120.0 + 2.0 * M_PI * 20.0 + 150.0;
  EXPECT_NEAR(edges.free_length, all - feet - 2.0 * sewn, 1e-8);
  double area = 0.0;
  for (const CadFace& face : model.faces) {
    check_borders(model, face);
    area += geometry_io::area_of(model, face);
  }
  EXPECT_NEAR(area, 6000.0 + 90.0 * slope + 500.0 + 400.0 + 25.0 * around + M_PI * 20.0 * 60.0 + 1350.0,
              1e-6);
}

}  // namespace
