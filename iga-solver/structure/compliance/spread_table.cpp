// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/spread_table.h"

#include "structure/compliance/table_polynomial.h"

namespace structure {

SpreadTable::SpreadTable(const std::array<int, 2>& counts, const Values& values) : counts_(counts) {
  const Eigen::MatrixXd of_s = lobatto_powers(counts[0]), of_t = lobatto_powers(counts[1]);
  for (const std::vector<double>& scalar : values) {
    const Eigen::MatrixXd powers =
        of_s * Eigen::MatrixXd::Map(scalar.data(), counts[0], counts[1]) * of_t.transpose();
    powers_.insert(powers_.end(), powers.data(), powers.data() + powers.size());
  }
}

ComplianceTable::Value SpreadTable::at(int scalar, const nurbs::Parameter<2>& low,
                                       const nurbs::Parameter<2>& high, const nurbs::Parameter<2>& xi) const {
  const double* const first = powers_.data() + static_cast<std::size_t>(scalar) * counts_[0] * counts_[1];
  std::array<double, 2> change, own;
  for (int d = 0; d < 2; ++d) {
    change[d] = 2.0 / (high[d] - low[d]);
    own[d] = change[d] * (xi[d] - low[d]) - 1.0;
  }
  TablePolynomial at(first, counts_, own[0], own[1]);
  if (strips_.reach(own[0], own[1])) strips_.add(own[0], own[1], scalar, 1, &at.value, &at.by_s, &at.by_t);
  return {at.value, {at.by_s * change[0], at.by_t * change[1]}};
}

}  // namespace structure
