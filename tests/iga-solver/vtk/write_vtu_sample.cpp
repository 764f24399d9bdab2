// SPDX-License-Identifier: GPL-2.0-or-later
// usage: write_vtu_sample OUT.vtu <SAMPLE
// Writes patches that stand as plain numbers on the standard input:
//   Dim, number of patches; per patch and direction: degree, number of knots, knots; 1 or 0 (rational or
//   not), weights if rational, control points, field `scalar` and `vector` per control point, field `number`
//   per element.
#include <iostream>

#include "vtk/vtu_file.h"

namespace {

template <class T>
T next() {
  T value;
  if (!(std::cin >> value)) throw std::runtime_error("the sample ends early");
  return value;
}

std::vector<double> numbers(int count) {
  std::vector<double> values(count);
  for (double& value : values) value = next<double>();
  return values;
}

Eigen::MatrixXd matrix(int rows, int columns) {
  const std::vector<double> values = numbers(rows * columns);
  return Eigen::Map<const Eigen::MatrixXd>(values.data(), rows, columns);
}

nurbs::KnotVector knot_vector() {
  const int degree = next<int>(), count = next<int>();
  return {degree, numbers(count)};
}

template <int Dim, std::size_t... Direction>
vtk::PatchFields<Dim> patch(std::index_sequence<Direction...>) {
  std::array<nurbs::KnotVector, Dim> knots{((void)Direction, knot_vector())...};  // braces keep the order
  int count = 1;
  for (const nurbs::KnotVector& direction : knots) count *= direction.control_point_count();
  std::vector<double> weights;
  if (next<int>() == 1) weights = numbers(count);
  const nurbs::Space<Dim> space(knots, weights);
  nurbs::Patch<Dim> geometry{space, matrix(3, count)};
  std::vector<vtk::Field> control_points;
  control_points.push_back({"scalar", matrix(1, count)});
  control_points.push_back({"vector", matrix(3, count)});
  return {std::move(geometry), control_points, {{"number", matrix(1, space.element_count())}}};
}

template <int Dim>
void write(const std::string& path) {
  std::vector<vtk::PatchFields<Dim>> patches;
  for (int count = next<int>(); count > 0; --count)
    patches.push_back(patch<Dim>(std::make_index_sequence<Dim>()));
  vtk::write_vtu(path, patches);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  if (next<int>() == 2)
    write<2>(argv[1]);
  else
    write<3>(argv[1]);
}
