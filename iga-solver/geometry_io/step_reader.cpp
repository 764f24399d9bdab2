// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/step_reader.h"

#include <fmt/format.h>

#include <BRepBndLib.hxx>
#include <BRepLib.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Eigen/Geometry>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "geometry_io/cad_cuts.h"
#include "geometry_io/cad_joints.h"
#include "geometry_io/cad_sewing.h"
#include "geometry_io/input_error.h"
#include "geometry_io/step_curves.h"
#include "geometry_io/step_document.h"
#include "geometry_io/step_faces.h"
#include "geometry_io/step_loops.h"

namespace geometry_io {
namespace {

constexpr double kSewing = 1e-6, kSewingOfGaps = 1.1e-4, kWidestGap = 5e-3;  // of the size
constexpr double kSmallest = 1e-3;  // size of a model whose tolerances are told apart from it [mm]

Handle(Geom_Surface) untrimmed(Handle(Geom_Surface) surface) {
  for (auto part = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface); !part.IsNull();
       part = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface))
    surface = part->BasisSurface();
  return surface;
}

// Files say 6.28318530718: ends of whole turns, poles and tips are put where they are meant.
void snap(brep::CadFace& face) {
  constexpr double kNear = 1e-11;
  const brep::Face& s = face.shape;
  const bool turns[] = {s.kind != brep::Kind::plane, s.kind == brep::Kind::torus};
  const auto move = [&](int direction, double from, double to) {
    for (brep::Loop& loop : face.loops)
      for (brep::Trim& trim : loop)
        for (double& x : trim.curve.points.row(direction))
          if (std::abs(x - from) <= kNear) x = to;
  };
  for (int d = 0; d < 2; ++d)
    if (turns[d] && std::abs(s.high[d] - s.low[d] - nurbs::kTwoPi) <= kNear) {
      const double low = std::abs(s.low[d]) <= kNear ? 0.0 : s.low[d];
      move(d, s.low[d], low);
      move(d, s.high[d], low + nurbs::kTwoPi);
    }
  if (s.kind == brep::Kind::sphere)
    for (const double pole : {-0.5 * nurbs::kPi, 0.5 * nurbs::kPi}) move(1, pole, pole);
  if (s.kind == brep::Kind::cone) move(1, 0.0, 0.0);
}

class ModelMaker {
 public:
  ModelMaker(StepDocument document, const StepOptions& options)
      : document_(std::move(document)), options_(options) {}

  brep::CadModel model() {
    model_.unit = document_.unit;
    model_.healed = document_.healed;
    for (const StepBody& body : document_.bodies) add_body(body);
    sew_sheets();
    refuse_wide_gaps();
    return std::move(model_);
  }

 private:
  void add_body(const StepBody& body) {
    const int number = static_cast<int>(model_.solids.size());
    const size_t first = model_.faces.size();
    BRepLib::BuildCurves3d(body.shape);
    for (TopExp_Explorer it(body.shape, TopAbs_FACE); it.More(); it.Next())
      add_face(TopoDS::Face(it.Current()), number);
    const bool closed = body.solid && is_closed(first);
    if (body.solid && !closed)
      model_.healed.push_back(
          fmt::format("solid {} '{}' has free edges: it is a sheet, not a body", number + 1, body.name));
    if (!closed)
      for (size_t f = first; f < model_.faces.size(); ++f) model_.faces[f].outward = 0;
    model_.solids.push_back({body.name, body.colour, closed});
    boxes_.emplace_back();
    BRepBndLib::Add(body.shape, boxes_.back(), false);
  }

  // Faces that lie side by side without a common edge get one: what touches, be it of one sheet or of
  // several, then what misses each other by little, of sheets of one name.
  void sew_sheets() {
    std::vector<int> all;
    std::map<std::string, std::vector<int>> named;
    for (size_t s = 0; s < model_.solids.size(); ++s) {
      if (model_.solids[s].closed) continue;
      all.push_back(static_cast<int>(s));
      named[model_.solids[s].name].push_back(all.back());
    }
    if (named.size() > 1) sew_together(all, "sheets", {kSewing});
    for (const auto& [name, sheets] : named)
      sew_together(sheets, fmt::format("sheet '{}'", name), {kSewing, kSewingOfGaps});
  }

  void sew_together(const std::vector<int>& sheets, const std::string& what,
                    const std::vector<double>& within) {
    const double size = size_of(sheets);
    Sewn sewn;
    for (const double relative : within) {
      const Sewn more = sew(model_, sheets, relative * size);
      sewn = {sewn.edges + more.edges, std::max(sewn.widest, more.widest)};
    }
    const auto report = [&](const char* how, const Sewn& done) {
      if (done.edges > 0)
        model_.healed.push_back(fmt::format("{}: {} {} edges, over gaps up to {:.3g} mm ({:.2g} of its size)",
                                            what, how, done.edges, done.widest, done.widest / size));
    };
    report("sewn along", sewn);
    report("joined to faces that it stands on along", join_to_faces(model_, sheets, within.back() * size));
    drop_unused(model_);
  }

  double size_of(const std::vector<int>& sheets) const {
    Bnd_Box box;
    for (const int sheet : sheets) box.Add(boxes_[sheet]);
    return std::sqrt(std::max(box.SquareExtent(), 0.0));
  }

  void add_face(const TopoDS_Face& face, int solid) {
    brep::CadFace out;
    out.number = static_cast<int>(model_.faces.size()) + 1;
    out.solid = solid;
    if (const StepLabel* label = document_.labels.Seek(face.Located(TopLoc_Location()))) {
      out.entity = label->entity;
      out.colour = label->colour;
      out.name = one_line(label->name);
    }
    try {
      shape_face(face, out);
    } catch (const std::exception& error) {
      throw std::runtime_error(fmt::format("{}: {}", place(out), error.what()));
    } catch (const Standard_Failure& failure) {
      throw std::runtime_error(
          fmt::format("{}: OpenCASCADE fails: {}", place(out), failure.GetMessageString()));
    }
    model_.faces.push_back(std::move(out));
  }

  static std::string place(const brep::CadFace& face) {
    return fmt::format("face {}{}{}", face.number, face.entity > 0 ? fmt::format(" (#{})", face.entity) : "",
                       face.name.empty() ? "" : fmt::format(" '{}'", face.name));
  }

  void shape_face(const TopoDS_Face& face, brep::CadFace& out) {
    const Handle(Geom_Surface) geometry = BRep_Tool::Surface(face);
    if (geometry.IsNull()) throw std::runtime_error("no surface, expected one");
    if (std::abs(face.Location().Transformation().ScaleFactor() - 1.0) > 1e-12)
      throw std::runtime_error("placed with another scale or as a mirror image, expected its own geometry");
    const GeomAdaptor_Surface surface(untrimmed(geometry));
    const RawLoops raw = loops_of(face, surface);
    const ParameterBox box = box_of(raw.loops);
    bool fitted_surface = false;
    ReadSurface read = surface_of(surface, box, options_.offset_tolerance, fitted_surface);
    int fitted = raw.fitted;
    out.loops = mapped(
        raw, read, box, [&](const RawTrim& trim) { return edge_number(trim); }, fitted);
    out.shape = read.shape;
    if (read.patch) {
      out.shape.patch = static_cast<int>(model_.patches.size());
      model_.patches.push_back(std::move(*read.patch));
    }
    set_range(out.loops, out.shape);
    if (out.shape.kind != brep::Kind::nurbs) {
      snap(out);
      set_range(out.loops, out.shape);
    }
    out.tolerance = BRep_Tool::Tolerance(face);
    const int side = read.same_side() ? 1 : -1;
    out.outward = face.Orientation() == TopAbs_FORWARD    ? side
                  : face.Orientation() == TopAbs_REVERSED ? -side
                                                          : 0;
    report(out, fitted_surface, fitted, raw.widest_gap);
  }

  void report(const brep::CadFace& face, bool fitted_surface, int fitted, double gap) {
    if (fitted_surface)
      model_.healed.push_back(fmt::format("{}: its surface was fitted within {:.3g} mm", place(face),
                                          std::max(options_.offset_tolerance, 1e-9)));
    if (fitted > 0)
      model_.healed.push_back(fmt::format("{}: {} curves of its border fitted within 1e-10 of its parameters",
                                          place(face), fitted));
    if (gap > 0.0)
      model_.healed.push_back(fmt::format("{}: gaps in its border up to {:.3g} mm closed", place(face), gap));
  }

  int edge_number(const RawTrim& trim) {
    const TopoDS_Edge& edge = trim.edge;
    const int known = edges_.FindIndex(edge);
    if (known > 0) {
      double& tolerance = model_.edges[known - 1].tolerance;
      tolerance = std::max(tolerance, trim.gap);
      return known - 1;
    }
    edges_.Add(edge);
    bool fitted = false;
    brep::CadEdge out = edge_of(edge, 1e-9, fitted);
    out.tolerance = std::max(BRep_Tool::Tolerance(edge), trim.gap);
    const TopoDS_Edge along = TopoDS::Edge(edge.Oriented(TopAbs_FORWARD));
    out.vertex[0] = vertex_number(TopExp::FirstVertex(along));
    out.vertex[1] = vertex_number(TopExp::LastVertex(along));
    model_.edges.push_back(std::move(out));
    if (fitted)
      model_.healed.push_back(
          fmt::format("edge {}: its curve was fitted within 1e-9 mm", model_.edges.size()));
    return static_cast<int>(model_.edges.size()) - 1;
  }

  int vertex_number(const TopoDS_Vertex& vertex) {
    if (vertex.IsNull()) return -1;
    const int known = vertices_.FindIndex(vertex);
    if (known > 0) return known - 1;
    vertices_.Add(vertex);
    model_.vertices.push_back({vector(BRep_Tool::Pnt(vertex)), BRep_Tool::Tolerance(vertex)});
    return static_cast<int>(model_.vertices.size()) - 1;
  }

  // Where borders miss their edges by so much, curves have been mixed up.
  void refuse_wide_gaps() const {
    Eigen::AlignedBox3d box;
    for (const brep::CadVertex& vertex : model_.vertices) box.extend(vertex.point);
    const double size = box.isEmpty() ? 0.0 : box.diagonal().norm();
    for (const brep::CadFace& face : model_.faces)
      for (const brep::Loop& loop : face.loops)
        for (const brep::Trim& trim : loop) {
          const double gap = trim.edge < 0 ? 0.0 : model_.edges[trim.edge].tolerance;
          if (gap > kWidestGap * size && size > kSmallest)
            throw std::runtime_error(
                fmt::format("{}: an edge of its border that its faces miss by up to {:.3g} mm, expected {} "
                            "of the size at most",
                            place(face), gap, kWidestGap));
        }
  }

  // Each edge twice in the loops of the faces from this one on.
  bool is_closed(size_t first) const {
    std::vector<int> uses(model_.edges.size(), 0);
    for (size_t f = first; f < model_.faces.size(); ++f)
      for (const brep::Loop& loop : model_.faces[f].loops)
        for (const brep::Trim& trim : loop)
          if (trim.edge >= 0) ++uses[trim.edge];
    return std::none_of(uses.begin(), uses.end(), [](int n) { return n == 1; });
  }

  StepDocument document_;
  const StepOptions options_;
  brep::CadModel model_;
  std::vector<Bnd_Box> boxes_;  // of solids [mm]
  TopTools_IndexedMapOfShape edges_, vertices_;
};

}  // namespace

brep::CadModel read_step(const std::string& bytes, const StepOptions& options) {
  try {
    return ModelMaker(step_document(bytes), options).model();
  } catch (const Standard_Failure& failure) {
    throw std::runtime_error(fmt::format("OpenCASCADE fails: {}", failure.GetMessageString()));
  }
}

}  // namespace geometry_io
