// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/hdf5_schema.h"

namespace geometry_io {

void add_root(int version, const std::string& units, Hdf5Builder& file) {
  file.set_text("/", "format", kFormatName);
  file.set_integers("/", "version", {version});
  file.set_text("/", "units", units);
  file.add_group("/patches");
}

template <int Dim>
void add_patch(const nurbs::Patch<Dim>& patch, size_t number, Hdf5Builder& file) {
  const std::string path = "/patches/" + std::to_string(number);
  file.add_group(path);
  std::vector<int> degrees;
  for (int d = 0; d < Dim; ++d) {
    const nurbs::KnotVector& knots = patch.space.knots(d);
    degrees.push_back(knots.degree());
    file.add_numbers(path + "/" + kKnots[d], {knots.knots().size()}, knots.knots());
  }
  file.set_integers(path, "degrees", degrees);
  std::vector<std::uint64_t> shape = net_shape<Dim>(patch.space.knots());
  if (patch.space.rational()) file.add_numbers(path + "/weights", shape, patch.space.weights());
  shape.push_back(3);
  const double* points = patch.control_points.data();
  file.add_numbers(path + "/control_points", shape, {points, points + patch.control_points.size()});
}
template void add_patch(const nurbs::Surface&, size_t, Hdf5Builder&);
template void add_patch(const nurbs::Volume&, size_t, Hdf5Builder&);

}  // namespace geometry_io
