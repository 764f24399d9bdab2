// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/analysis/mass_matrix.h"

#include <vector>

#include "nurbs/memory.h"

namespace structure {

MassMatrix::MassMatrix(const Body& body, MassKind kind) : matrix_(body.node_count(), body.node_count()) {
  std::vector<Eigen::Triplet<double>> entries;
  if (kind == MassKind::lumped) {
    for (int A = 0; A < body.node_count(); ++A) entries.emplace_back(A, A, body.row_sum_mass()[A]);
  } else {
    constexpr double kMore = 1.5;  // of the matrix that they become
    const auto of_element = static_cast<double>(body.element_nodes(0).size());
    const double count = body.element_count() * of_element * of_element;
    nurbs::expect_memory(kMore * count * sizeof(entries.front()), "the matrix of consistent masses");
    entries.reserve(static_cast<std::size_t>(count));
    for (int e = 0; e < body.element_count(); ++e) {
      const std::vector<int> nodes = body.element_nodes(e);
      const Eigen::MatrixXd mass = body.element_mass_matrix(e);
      for (std::size_t b = 0; b < nodes.size(); ++b)
        for (std::size_t a = 0; a < nodes.size(); ++a)
          entries.emplace_back(nodes[a], nodes[b], mass(Eigen::Index(a), Eigen::Index(b)));
    }
  }
  matrix_.setFromTriplets(entries.begin(), entries.end());
}

}  // namespace structure
