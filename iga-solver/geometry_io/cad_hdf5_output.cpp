// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>

#include "geometry_io/cad_hdf5.h"
#include "geometry_io/hdf5_schema.h"

namespace geometry_io {
namespace {

using brep::Vector3;

// One row of a table per thing.
class TableOut {
 public:
  TableOut(Hdf5Builder& file, std::string group, size_t rows)
      : file_(file), group_(std::move(group)), rows_(rows) {
    file_.add_group(group_);
  }
  /// A number of each: value(i).
  template <class Value>
  void column(const char* name, Value value) {
    std::vector<double> numbers(rows_);
    for (size_t i = 0; i < rows_; ++i) numbers[i] = static_cast<double>(value(i));
    file_.add_numbers(group_ + "/" + name, {rows_}, std::move(numbers));
  }
  /// Several of each: values(i) with begin and end, `count` of them.
  template <class Values>
  void columns(const char* name, size_t count, Values values) {
    std::vector<double> numbers;
    numbers.reserve(rows_ * count);
    for (size_t i = 0; i < rows_; ++i)
      for (const double x : values(i)) numbers.push_back(x);
    file_.add_numbers(group_ + "/" + name, {rows_, count}, std::move(numbers));
  }
  template <class Text>
  void texts(const char* name, Text text) {
    std::vector<std::string> all(rows_);
    for (size_t i = 0; i < rows_; ++i) all[i] = text(i);
    file_.add_texts(group_ + "/" + name, all);
  }

 private:
  Hdf5Builder& file_;
  const std::string group_;
  const size_t rows_;
};

std::vector<double> row(std::initializer_list<Vector3> vectors) {
  std::vector<double> numbers;
  for (const Vector3& v : vectors) numbers.insert(numbers.end(), v.data(), v.data() + 3);
  return numbers;
}

// Splines one behind the other: degree and number of points in the table, numbers in three long arrays.
template <int Dim>
void add_splines(TableOut& table, Hdf5Builder& file, const std::string& group,
                 const std::vector<const brep::Spline<Dim>*>& splines) {
  table.column("degree", [&](size_t i) { return splines[i]->degree; });
  table.column("points", [&](size_t i) { return splines[i]->points.cols(); });
  table.column("rational", [&](size_t i) { return splines[i]->weights.empty() ? 0 : 1; });
  std::vector<double> knots, points, weights;
  for (const brep::Spline<Dim>* spline : splines) {
    knots.insert(knots.end(), spline->knots.begin(), spline->knots.end());
    points.insert(points.end(), spline->points.data(), spline->points.data() + spline->points.size());
    weights.insert(weights.end(), spline->weights.begin(), spline->weights.end());
  }
  const size_t n_knots = knots.size(), n_points = points.size() / Dim, n_weights = weights.size();
  file.add_numbers(group + "/knots", {n_knots}, std::move(knots));
  file.add_numbers(group + "/control_points", {n_points, Dim}, std::move(points));
  file.add_numbers(group + "/weights", {n_weights}, std::move(weights));
}

void add_faces(const std::vector<brep::CadFace>& faces, Hdf5Builder& file) {
  TableOut table(file, "/faces", faces.size());
  table.column("kind", [&](size_t i) { return static_cast<int>(faces[i].shape.kind); });
  table.columns("frame", 12, [&](size_t i) {
    const brep::Frame& f = faces[i].shape.frame;
    return row({f.origin, f.x, f.y, f.z});
  });
  table.columns("radii", 2, [&](size_t i) { return std::array{faces[i].shape.R, faces[i].shape.r}; });
  table.columns("range", 4, [&](size_t i) {
    const brep::Face& s = faces[i].shape;
    return std::array{s.low[0], s.low[1], s.high[0], s.high[1]};
  });
  table.column("patch", [&](size_t i) { return faces[i].shape.patch; });
  table.column("solid", [&](size_t i) { return faces[i].solid; });
  table.column("outward", [&](size_t i) { return faces[i].outward; });
  table.column("number", [&](size_t i) { return faces[i].number; });
  table.column("entity", [&](size_t i) { return faces[i].entity; });
  table.column("colour", [&](size_t i) { return faces[i].colour; });
  table.column("tolerance", [&](size_t i) { return faces[i].tolerance; });
  table.texts("name", [&](size_t i) { return faces[i].name; });
  table.column("loops", [&](size_t i) { return faces[i].loops.size(); });
}

void add_trims(const std::vector<brep::CadFace>& faces, Hdf5Builder& file) {
  std::vector<const brep::Loop*> loops;
  std::vector<const brep::Trim*> trims;
  std::vector<const brep::Spline<2>*> curves;
  for (const brep::CadFace& face : faces)
    for (const brep::Loop& loop : face.loops) {
      loops.push_back(&loop);
      for (const brep::Trim& trim : loop) {
        trims.push_back(&trim);
        curves.push_back(&trim.curve);
      }
    }
  TableOut(file, "/loops", loops.size()).column("trims", [&](size_t i) { return loops[i]->size(); });
  TableOut table(file, "/trims", trims.size());
  table.column("edge", [&](size_t i) { return trims[i]->edge; });
  table.column("forward", [&](size_t i) { return trims[i]->forward ? 1 : 0; });
  add_splines<2>(table, file, "/trims", curves);
}

void add_edges(const std::vector<brep::CadEdge>& edges, Hdf5Builder& file) {
  TableOut table(file, "/edges", edges.size());
  table.column("kind", [&](size_t i) { return static_cast<int>(edges[i].kind); });
  table.columns("frame", 9, [&](size_t i) { return row({edges[i].origin, edges[i].axis, edges[i].radial}); });
  table.column("radius", [&](size_t i) { return edges[i].R; });
  table.column("length", [&](size_t i) { return edges[i].length; });
  table.columns("vertices", 2, [&](size_t i) {
    return std::array{static_cast<double>(edges[i].vertex[0]), static_cast<double>(edges[i].vertex[1])};
  });
  table.column("tolerance", [&](size_t i) { return edges[i].tolerance; });
  std::vector<const brep::Spline<3>*> curves;
  for (const brep::CadEdge& edge : edges) curves.push_back(&edge.curve);
  add_splines<3>(table, file, "/edges", curves);
}

}  // namespace

void add_cad_file(const brep::CadModel& model, const std::string& units, Hdf5Builder& file) {
  add_root(kCadVersion, units, file);
  for (size_t p = 0; p < model.patches.size(); ++p) add_patch(model.patches[p], p, file);
  file.set_text("/", "length_unit", model.unit);
  add_faces(model.faces, file);
  add_trims(model.faces, file);
  add_edges(model.edges, file);
  TableOut vertices(file, "/vertices", model.vertices.size());
  vertices.columns("point", 3, [&](size_t i) { return row({model.vertices[i].point}); });
  vertices.column("tolerance", [&](size_t i) { return model.vertices[i].tolerance; });
  TableOut solids(file, "/solids", model.solids.size());
  solids.texts("name", [&](size_t i) { return model.solids[i].name; });
  solids.column("colour", [&](size_t i) { return model.solids[i].colour; });
  solids.column("closed", [&](size_t i) { return model.solids[i].closed ? 1 : 0; });
  file.add_texts("/healed", model.healed);
}

}  // namespace geometry_io
