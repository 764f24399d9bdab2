// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry_io/cad_hdf5.h"
#include "geometry_io/hdf5_file.h"
#include "nurbs/usable_number.h"

namespace geometry_io {
namespace {

using brep::CadModel;
using brep::Vector3;

constexpr double kSame = 1e-9;       // of axes and of the ends of trims
constexpr int kMaxCurveDegree = 25;  // as CAD programs have it

// One row per thing, checked as it is read.
class TableIn {
 public:
  TableIn(const Hdf5Input& file, std::string group, const char* counted)
      : file_(file), group_(std::move(group)), rows_(file.numbers(path(counted)).numbers.size()) {}
  size_t rows() const { return rows_; }
  std::string path(const std::string& name) const { return group_ + "/" + name; }
  [[noreturn]] void fail(const std::string& name, size_t row, const std::string& message) const {
    file_.fail(path(name), fmt::format("row {}: {}", row, message));
  }

  /// rows() x count usable numbers.
  const std::vector<double>& numbers(const std::string& name, size_t count = 1) const {
    const Hdf5Value& value = file_.numbers(path(name));
    if (value.numbers.size() != rows_ * count)
      file_.fail(path(name),
                 fmt::format("shape is {}, expected {} rows of {}", shape_text(value.shape), rows_, count));
    for (size_t i = 0; i < value.numbers.size(); ++i)
      if (!nurbs::is_usable(value.numbers[i]))
        fail(name, i / count,
             fmt::format("{}, expected a finite number of at most 1e+100", value.numbers[i]));
    return value.numbers;
  }
  /// One each, >= low.
  const std::vector<double>& numbers_from(const std::string& name, double low) const {
    const std::vector<double>& all = numbers(name);
    for (size_t i = 0; i < rows_; ++i)
      if (!(all[i] >= low)) fail(name, i, fmt::format("{}, expected {} at least", all[i], low));
    return all;
  }
  std::vector<int> integers(const std::string& name, double low, double high, size_t count = 1) const {
    const std::vector<double>& all = numbers(name, count);
    std::vector<int> out(all.size());
    for (size_t i = 0; i < all.size(); ++i) {
      if (!(all[i] >= low && all[i] <= high && all[i] == std::floor(all[i])))
        fail(name, i / count, fmt::format("{}, expected a whole number from {} to {}", all[i], low, high));
      out[i] = static_cast<int>(all[i]);
    }
    return out;
  }
  const std::vector<std::string>& texts(const std::string& name) const {
    const std::vector<std::string>& all = file_.texts(path(name));
    if (all.size() != rows_) file_.fail(path(name), fmt::format("{} texts, expected {}", all.size(), rows_));
    return all;
  }

 private:
  const Hdf5Input& file_;
  const std::string group_;
  const size_t rows_;
};

constexpr double kMost = std::numeric_limits<int>::max();

Vector3 vector_at(const std::vector<double>& numbers, size_t first) {
  return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

bool is_unit(const Vector3& v) { return std::abs(v.norm() - 1.0) <= kSame; }

// Takes what belongs to one thing after the other from a long array.
class Taker {
 public:
  Taker(const Hdf5Input& file, std::string path, size_t per_item = 1)
      : file_(file), path_(std::move(path)), all_(file.numbers(path_).numbers), per_item_(per_item) {}
  const double* take(size_t items) {
    if (items * per_item_ > all_.size() - next_)
      file_.fail(path_, fmt::format("{} numbers, expected more by the table", all_.size()));
    const double* from = all_.data() + next_;
    next_ += items * per_item_;
    return from;
  }
  void end() const {
    if (next_ != all_.size())
      file_.fail(path_, fmt::format("{} numbers, expected {} by the table", all_.size(), next_));
  }

 private:
  const Hdf5Input& file_;
  const std::string path_;
  const std::vector<double>& all_;
  const size_t per_item_;
  size_t next_ = 0;
};

bool are_open(const std::vector<double>& knots, int degree) {
  const size_t n = knots.size();
  for (size_t i = 0; i + 1 < n; ++i)
    if (!(knots[i] <= knots[i + 1])) return false;
  return knots.front() == knots[degree] && knots[n - 1] == knots[n - 1 - degree] &&
         knots.front() < knots.back();
}

/// Splines of a table; those without points are left as they are.
template <int Dim>
std::vector<brep::Spline<Dim>> read_splines(const Hdf5Input& file, const TableIn& table, int fewest) {
  const std::vector<int> degree = table.integers("degree", 1, kMaxCurveDegree),
                         count = table.integers("points", fewest, kMost),
                         rational = table.integers("rational", 0, 1);
  Taker knots(file, table.path("knots")), points(file, table.path("control_points"), Dim),
      weights(file, table.path("weights"));
  std::vector<brep::Spline<Dim>> all(table.rows());
  for (size_t i = 0; i < table.rows(); ++i) {
    brep::Spline<Dim>& spline = all[i];
    spline.degree = degree[i];
    const size_t n = count[i];
    if (n == 0) continue;
    if (n <= static_cast<size_t>(degree[i]))
      table.fail("points", i, fmt::format("{}, expected more than the degree {}", n, degree[i]));
    const double* from = knots.take(n + degree[i] + 1);
    spline.knots.assign(from, from + n + degree[i] + 1);
    spline.points = Eigen::Map<const Eigen::Matrix<double, Dim, Eigen::Dynamic>>(points.take(n), Dim, n);
    if (rational[i] != 0) {
      from = weights.take(n);
      spline.weights.assign(from, from + n);
    }
    if (!std::all_of(spline.knots.begin(), spline.knots.end(), nurbs::is_usable) ||
        !are_open(spline.knots, spline.degree))
      table.fail("knots", i, "knots that are not open or do not rise");
    if (!std::all_of(spline.points.data(), spline.points.data() + spline.points.size(), nurbs::is_usable))
      table.fail("control_points", i, "a number that is not finite or above 1e+100");
    for (const double w : spline.weights)
      if (!(nurbs::is_usable(w) && w > 0.0))
        table.fail("weights", i, fmt::format("weight {}, expected a number > 0", w));
  }
  knots.end();
  points.end();
  weights.end();
  return all;
}

void check_shape(const TableIn& table, size_t i, const brep::Face& shape,
                 const std::vector<nurbs::Surface>& patches) {
  const brep::Frame& f = shape.frame;
  if (!is_unit(f.x) || !is_unit(f.y) || !((f.x.cross(f.y) - f.z).norm() <= kSame))
    table.fail("frame", i, "axes that are not orthonormal and right-handed");
  const bool has_R = shape.kind == brep::Kind::cylinder || shape.kind == brep::Kind::sphere ||
                     shape.kind == brep::Kind::torus;
  if (has_R && !(shape.R > 0.0))
    table.fail("radii", i, fmt::format("radius {}, expected a number > 0", shape.R));
  if (shape.kind == brep::Kind::torus && !(shape.r > 0.0 && shape.r < shape.R))
    table.fail("radii", i, fmt::format("tube of radius {}, expected > 0 and < {}", shape.r, shape.R));
  if (shape.kind == brep::Kind::cone && !(shape.r > 0.0 && shape.r < 0.5 * nurbs::kPi))
    table.fail("radii", i, fmt::format("angle {}, expected one in (0, pi/2)", shape.r));
  const int last = static_cast<int>(patches.size()) - 1;
  if (shape.kind == brep::Kind::nurbs ? shape.patch < 0 || shape.patch > last : shape.patch != -1)
    table.fail(
        "patch", i,
        fmt::format("{}, expected a patch from 0 to {} of a face of kind 5, else -1", shape.patch, last));
  for (int d = 0; d < 2; ++d)
    if (!(shape.low[d] < shape.high[d])) table.fail("range", i, "an empty range");
}

void check_closed(const TableIn& table, size_t face, const brep::CadFace& out) {
  for (const brep::Loop& loop : out.loops)
    for (size_t k = 0; k < loop.size(); ++k) {
      const auto& points = loop[k].curve.points;
      const Eigen::Vector2d gap =
          loop[(k + 1) % loop.size()].curve.points.col(0) - points.col(points.cols() - 1);
      for (int d = 0; d < 2; ++d)
        if (!(std::abs(gap[d]) <= kSame * (out.shape.high[d] - out.shape.low[d])))
          table.fail("loops", face,
                     fmt::format("a loop that is open by {:.3g}, expected a closed one", gap.norm()));
    }
}

void read_faces(const Hdf5Input& file, CadModel& model) {
  const TableIn faces(file, "/faces", "kind"), loops(file, "/loops", "trims"), trims(file, "/trims", "edge");
  if (faces.rows() == 0) file.fail("/faces/kind", "no faces, expected one at least");
  const std::vector<int> kind = faces.integers("kind", 0, static_cast<int>(brep::Kind::nurbs)),
                         patch = faces.integers("patch", -1, kMost),
                         solid = faces.integers("solid", -1, static_cast<double>(model.solids.size()) - 1.0),
                         outward = faces.integers("outward", -1, 1),
                         number = faces.integers("number", 0, kMost),
                         entity = faces.integers("entity", 0, kMost),
                         colour = faces.integers("colour", -1, 0xFFFFFF),
                         loop_count = faces.integers("loops", 1, kMost),
                         trim_count = loops.integers("trims", 1, kMost),
                         edge = trims.integers("edge", -1, static_cast<double>(model.edges.size()) - 1.0),
                         forward = trims.integers("forward", 0, 1);
  const std::vector<double>&frame = faces.numbers("frame", 12), &radii = faces.numbers("radii", 2),
        &range = faces.numbers("range", 4), &tolerance = faces.numbers_from("tolerance", 0.0);
  const std::vector<std::string>& name = faces.texts("name");
  std::vector<brep::Spline<2>> curves = read_splines<2>(file, trims, 1);
  size_t next_loop = 0, next_trim = 0;
  for (size_t i = 0; i < faces.rows(); ++i) {
    brep::CadFace out;
    out.shape.kind = static_cast<brep::Kind>(kind[i]);
    out.shape.frame = {vector_at(frame, 12 * i), vector_at(frame, 12 * i + 3), vector_at(frame, 12 * i + 6),
                       vector_at(frame, 12 * i + 9)};
    out.shape.R = radii[2 * i], out.shape.r = radii[2 * i + 1];
    out.shape.low = {range[4 * i], range[4 * i + 1]}, out.shape.high = {range[4 * i + 2], range[4 * i + 3]};
    out.shape.patch = patch[i];
    check_shape(faces, i, out.shape, model.patches);
    out.solid = solid[i], out.outward = outward[i], out.number = number[i], out.entity = entity[i];
    out.colour = colour[i], out.name = name[i], out.tolerance = tolerance[i];
    for (int l = 0; l < loop_count[i]; ++l, ++next_loop) {
      if (next_loop >= loops.rows()) faces.fail("loops", i, "more loops than there are in /loops");
      brep::Loop loop;
      for (int t = 0; t < trim_count[next_loop]; ++t, ++next_trim) {
        if (next_trim >= trims.rows()) loops.fail("trims", next_loop, "more trims than there are in /trims");
        loop.push_back({std::move(curves[next_trim]), edge[next_trim], forward[next_trim] != 0});
      }
      out.loops.push_back(std::move(loop));
    }
    check_closed(faces, i, out);
    model.faces.push_back(std::move(out));
  }
  if (next_loop != loops.rows() || next_trim != trims.rows())
    file.fail("/loops", "more loops or trims than the faces have");
}

void read_edges(const Hdf5Input& file, CadModel& model) {
  const TableIn edges(file, "/edges", "kind");
  const std::vector<int> kind = edges.integers("kind", 0, 2),
                         vertices = edges.integers("vertices", -1,
                                                   static_cast<double>(model.vertices.size()) - 1.0, 2);
  const std::vector<double>&frame = edges.numbers("frame", 9), &radius = edges.numbers("radius"),
        &length = edges.numbers("length"), &tolerance = edges.numbers_from("tolerance", 0.0);
  std::vector<brep::Spline<3>> curves = read_splines<3>(file, edges, 0);
  for (size_t i = 0; i < edges.rows(); ++i) {
    brep::CadEdge out;
    out.kind = static_cast<brep::CadEdge::Kind>(kind[i]);
    out.origin = vector_at(frame, 9 * i), out.axis = vector_at(frame, 9 * i + 3),
    out.radial = vector_at(frame, 9 * i + 6);
    out.R = radius[i], out.length = length[i];
    out.vertex[0] = vertices[2 * i], out.vertex[1] = vertices[2 * i + 1];
    out.tolerance = tolerance[i];
    out.curve = std::move(curves[i]);
    const bool spline = out.kind == brep::CadEdge::Kind::spline,
               circle = out.kind == brep::CadEdge::Kind::circle;
    if (spline != (out.curve.points.cols() > 0))
      edges.fail("points", i, "a spline without points, or points of another edge");
    if (!spline && (!is_unit(out.axis) || !(out.length > 0.0)))
      edges.fail("frame", i, "a line or an arc without direction or length");
    if (circle && !(out.R > 0.0 && is_unit(out.radial) && std::abs(out.radial.dot(out.axis)) <= kSame))
      edges.fail("frame", i, "an arc without radius, or whose axes are not orthonormal");
    model.edges.push_back(std::move(out));
  }
}

}  // namespace

brep::CadModel read_cad(const Hdf5Input& file, std::vector<nurbs::Surface> patches) {
  CadModel model;
  model.patches = std::move(patches);
  model.unit = file.text("/", "length_unit");
  model.healed = file.texts("/healed");
  const TableIn vertices(file, "/vertices", "tolerance"), solids(file, "/solids", "closed");
  const std::vector<double>&point = vertices.numbers("point", 3),
        &tolerance = vertices.numbers_from("tolerance", 0.0);
  for (size_t i = 0; i < vertices.rows(); ++i)
    model.vertices.push_back({vector_at(point, 3 * i), tolerance[i]});
  const std::vector<int> colour = solids.integers("colour", -1, 0xFFFFFF),
                         closed = solids.integers("closed", 0, 1);
  const std::vector<std::string>& name = solids.texts("name");
  for (size_t i = 0; i < solids.rows(); ++i) model.solids.push_back({name[i], colour[i], closed[i] != 0});
  read_edges(file, model);
  read_faces(file, model);
  return model;
}

}  // namespace geometry_io
