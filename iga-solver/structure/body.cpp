// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/body.h"

#include <fmt/format.h>

#include <algorithm>

namespace structure {

void Body::internal_force_change(const NodalVectors& u, const NodalVectors& w, NodalVectors& f) const {
  constexpr double kSmall = 1e-6;  // of the body's extent
  const double size = w.lpNorm<Eigen::Infinity>();
  if (size == 0.0) return f.setZero(), void();
  const NodalVectors& X = reference();
  const double step = kSmall * (X.rowwise().maxCoeff() - X.rowwise().minCoeff()).maxCoeff() / size;
  NodalVectors before(3, w.cols());
  internal_force(u - step * w, before);
  internal_force(u + step * w, f);
  f = (f - before) / (2.0 * step);
}

void Body::mass_product(const NodalVectors& a, NodalVectors& f,
                        const std::function<void()>& shares_ready) const {
  f.setZero();
  for (int e = 0; e < element_count(); ++e) {
    const std::vector<int> nodes = element_nodes(e);
    const Eigen::MatrixXd mass = element_mass_matrix(e);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = 0; j < nodes.size(); ++j)
        f.col(nodes[i]) += mass(Eigen::Index(i), Eigen::Index(j)) * a.col(nodes[j]);
  }
  shares_ready();
}

std::vector<int> Body::element_nodes(int element) const {
  NodalVectors numbers = NodalVectors::Zero(3, node_count());
  for (int A = 0; A < node_count(); ++A) numbers(0, A) = A + 1.0;
  const int padded = padded_functions(element);
  std::vector<double> values(3 * std::size_t(padded));
  gather(element, numbers, values.data());
  std::vector<int> nodes;
  for (int a = 0; a < padded; ++a)
    if (values[a] > 0.0) nodes.push_back(static_cast<int>(values[a]) - 1);
  return nodes;
}

bool is_linear(const Body& body) {
  const std::vector<const Material*> materials = body.materials();
  return std::all_of(materials.begin(), materials.end(), [](const Material* m) { return m->is_linear(); });
}

std::string text(const Vector3& x) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", x[0], x[1], x[2]); }

}  // namespace structure
