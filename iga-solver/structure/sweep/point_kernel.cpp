// SPDX-License-Identifier: GPL-2.0-or-later
// Compiled once for each instruction set, as line_kernel.cpp is.
#include "structure/sweep/point_kernel.h"

#include "nurbs/lanes.h"
#include "structure/material/dual.h"
#include "structure/material/law_list.h"

namespace structure {

using namespace nurbs::lanes;

namespace {

using LaneTensor = Tensor<Lanes>;

/// Geometry of the points of one word.
struct PointGeometry {
  LaneTensor K;     // J^-1, over W if rational: K(d, j) = dxi_d / dX_j
  Lanes w_det;      // w|J|, times the law's modulus
  Lanes g[3] = {};  // dW / W; rational only
};

/// Of a map that stretches along the axes: direction d of the parameters goes along axis (d + Shift) % 3.
template <int Shift>
struct AlignedGeometry {
  static constexpr int axis(int d) { return (d + Shift) % 3; }
  double k[3];  // 1 / J(axis(d), d)
  Lanes w_det;
};

/// 1 / x, and 0 of 0: lanes without a span have no Jacobian.
inline Lanes inverse_or_zero(const Lanes& x) {
  const Lanes one = Lanes{} + 1.0;
  return x != 0.0 ? one / x : Lanes{};
}

/// Sets K to J^-1 and gives |J|.
[[gnu::always_inline]] inline Lanes invert(const LaneTensor& J, LaneTensor& K) {
  for (int d = 0; d < 3; ++d)
    for (int j = 0; j < 3; ++j) {
      const int d1 = (d + 1) % 3, d2 = (d + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      K(d, j) = J(j1, d1) * J(j2, d2) - J(j1, d2) * J(j2, d1);
    }
  const Lanes det = J(0, 0) * K(0, 0) + J(1, 0) * K(0, 1) + J(2, 0) * K(0, 2), inverse = inverse_or_zero(det);
  for (int d = 0; d < 3; ++d)
    for (int j = 0; j < 3; ++j) K(d, j) *= inverse;
  return det;
}

/// From the derivatives of X (times W, and of W if rational); `weight` is that of the points.  Gives |J|.
template <bool Rational>
[[gnu::always_inline]] inline Lanes work_out(const double* fields, const Lanes& weight,
                                             PointGeometry& geometry) {
  constexpr int kQuantities = Rational ? 4 : 3;
  LaneTensor J;
  for (int i = 0; i < 3; ++i)
    for (int d = 0; d < 3; ++d) J(i, d) = load(fields + (kQuantities * i + d) * kLanes);
  Lanes over_W{};
  if (Rational) {
    const double* const W = fields + 3 * kQuantities * kLanes;
    over_W = inverse_or_zero(load(W + 3 * kLanes));
    for (int d = 0; d < 3; ++d) geometry.g[d] = over_W * load(W + d * kLanes);
    for (int i = 0; i < 3; ++i)
      for (int d = 0; d < 3; ++d)
        J(i, d) = over_W * (J(i, d) - load(fields + (kQuantities * i + 3) * kLanes) * geometry.g[d]);
  }
  const Lanes det = invert(J, geometry.K);
  geometry.w_det = weight * det;
  if (Rational)
    for (auto& row : geometry.K.m)
      for (Lanes& entry : row) entry *= over_W;
  return det;
}

template <GeometryMode Mode, bool Rational>
constexpr int quantities() {
  return Rational ? 4 : 3;
}
template <GeometryMode Mode, bool Rational>
constexpr int fields() {
  return Mode != GeometryMode::recomputed ? 3 : Rational ? 7 : 6;
}

/// The processor does not see by itself that the table goes on after the next rows have been swept: the plate
/// of Table 2 takes half the time (68 and 35 ns per degree of freedom).
constexpr int kTableWordsAhead = 16;

template <GeometryMode Mode, bool Rational>
[[gnu::always_inline]] inline void find_geometry(const PointRow& row, int word, const double* values,
                                                 double modulus, PointGeometry& geometry) {
  const Lanes weight = modulus * row.weight * load(row.weights + std::size_t(word) * kLanes);
  if constexpr (Mode == GeometryMode::affine) {
    for (int k = 0; k < 9; ++k) geometry.K.m[k / 3][k % 3] = Lanes{} + row.affine[k];
    geometry.w_det = weight * row.affine[9];
  } else if constexpr (Mode == GeometryMode::stored) {
    constexpr int kWord = table_numbers(Rational) * kLanes;
    const double* table = row.table + std::size_t(word) * kWord;
    prefetch(table + kTableWordsAhead * kWord, kWord);
    for (int k = 0; k < 9; ++k) geometry.K.m[k / 3][k % 3] = load(table + k * kLanes);
    geometry.w_det = modulus * load(table + 9 * kLanes);
    if (Rational)
      for (int d = 0; d < 3; ++d) geometry.g[d] = load(table + (10 + d) * kLanes);
  } else {
    work_out<Rational>(values + 3 * quantities<Mode, Rational>() * kLanes, weight, geometry);
  }
}

/// H = (dN - N g) K
template <bool Rational>
[[gnu::always_inline]] inline LaneTensor gradient(const double* values, const PointGeometry& geometry) {
  constexpr int kQuantities = Rational ? 4 : 3;
  LaneTensor H;
  for (int i = 0; i < 3; ++i, values += kQuantities * kLanes) {
    Lanes d_u[3];
    for (int d = 0; d < 3; ++d) {
      d_u[d] = load(values + d * kLanes);
      if (Rational) d_u[d] -= load(values + 3 * kLanes) * geometry.g[d];
    }
    for (int j = 0; j < 3; ++j)
      H(i, j) = d_u[0] * geometry.K(0, j) + d_u[1] * geometry.K(1, j) + d_u[2] * geometry.K(2, j);
  }
  return H;
}

/// T = w|J| P K^T, and -T g.
template <bool Rational>
[[gnu::always_inline]] inline void put_stress(const LaneTensor& P, const PointGeometry& geometry,
                                              double* values) {
  constexpr int kQuantities = Rational ? 4 : 3;
  for (int i = 0; i < 3; ++i, values += kQuantities * kLanes) {
    Lanes T[3], T_g{};
    for (int d = 0; d < 3; ++d) {
      T[d] = geometry.w_det *
             (P(i, 0) * geometry.K(d, 0) + P(i, 1) * geometry.K(d, 1) + P(i, 2) * geometry.K(d, 2));
      store(T[d], values + d * kLanes);
      if (Rational) T_g -= T[d] * geometry.g[d];
    }
    if (Rational) store(T_g, values + 3 * kLanes);
  }
}

template <int Shift>
[[gnu::always_inline]] inline void find_geometry(const PointRow& row, int word, double modulus,
                                                 AlignedGeometry<Shift>& geometry) {
  for (int d = 0; d < 3; ++d) geometry.k[d] = row.affine[3 * d + AlignedGeometry<Shift>::axis(d)];
  geometry.w_det = modulus * row.weight * row.affine[9] * load(row.weights + std::size_t(word) * kLanes);
}

template <int Shift>
[[gnu::always_inline]] inline LaneTensor gradient(const double* values,
                                                  const AlignedGeometry<Shift>& geometry) {
  LaneTensor H;
  for (int i = 0; i < 3; ++i)
    for (int d = 0; d < 3; ++d) H(i, geometry.axis(d)) = geometry.k[d] * load(values + (3 * i + d) * kLanes);
  return H;
}

template <int Shift>
[[gnu::always_inline]] inline void put_stress(const LaneTensor& P, const AlignedGeometry<Shift>& geometry,
                                              double* values) {
  for (int d = 0; d < 3; ++d) {
    const Lanes factor = geometry.w_det * geometry.k[d];
    for (int i = 0; i < 3; ++i) store(factor * P(i, geometry.axis(d)), values + (3 * i + d) * kLanes);
  }
}

/// A law that the kernels do not hold, in the place of one: point after point.
struct OutsideWord {
  static constexpr double modulus = 1.0;  // [Pa]
  const OutsideLaw& outside;
  const double* weights;
  const std::ptrdiff_t* offset;

  LaneTensor unit_stress(const LaneTensor& H) const {
    LaneTensor P{};
    for (int lane = 0; lane < kLanes; ++lane) {
      if (weights[lane] == 0.0) continue;
      double h[9], p[9];
      for (int k = 0; k < 9; ++k) h[k] = H.m[k / 3][k % 3][lane];
      outside.stress(outside.law, h, outside.state + offset[lane],
                     outside.next ? outside.next + offset[lane] : nullptr, outside.dt, p);
      for (int k = 0; k < 9; ++k) P.m[k / 3][k % 3][lane] = p[k];
    }
    return P;
  }
  Lanes unit_energy(const LaneTensor& H) const {
    Lanes energy{};
    for (int lane = 0; lane < kLanes; ++lane) {
      if (weights[lane] == 0.0) continue;
      double h[9];
      for (int k = 0; k < 9; ++k) h[k] = H.m[k / 3][k % 3][lane];
      energy[lane] = outside.energy_density(outside.law, h, outside.state + offset[lane]);
    }
    return energy;
  }
};

/// dP of a law that kernels hold, and of one that they do not.
template <class Law>
[[gnu::always_inline]] inline LaneTensor change_at(const Law& law, const LaneTensor& H, const LaneTensor& G) {
  return unit_stress_change(law, H, G);
}
LaneTensor change_at(const OutsideWord& law, const LaneTensor& H, const LaneTensor& G) {
  LaneTensor dP{};
  for (int lane = 0; lane < kLanes; ++lane) {
    if (law.weights[lane] == 0.0) continue;
    double h[9], g[9], dp[9];
    for (int k = 0; k < 9; ++k) {
      h[k] = H.m[k / 3][k % 3][lane];
      g[k] = G.m[k / 3][k % 3][lane];
    }
    law.outside.stress_change(law.outside.law, h, g, law.outside.state + law.offset[lane], dp);
    for (int k = 0; k < 9; ++k) dP.m[k / 3][k % 3][lane] = dp[k];
  }
  return dP;
}

/// The law at the points of a word.
template <class Law>
[[gnu::always_inline]] inline const Law& law_at(const PointRow& row, int /*word*/, const Law*) {
  return *static_cast<const Law*>(row.law);
}
[[gnu::always_inline]] inline OutsideWord law_at(const PointRow& row, int word, const OutsideWord*) {
  const OutsideLaw& outside = *static_cast<const OutsideLaw*>(row.law);
  return {outside, row.weights + std::size_t(word) * kLanes, outside.offset + std::size_t(word) * kLanes};
}

template <class Law, GeometryMode Mode, bool Rational>
void stress_loop(const PointRow& row, PointSums& /*sums*/) {
  constexpr std::size_t kStride =
      std::size_t(fields<Mode, Rational>()) * quantities<Mode, Rational>() * kLanes;
  double* values = row.values;
  for (int word = 0; word < row.words; ++word, values += kStride) {
    const auto& law = law_at(row, word, static_cast<const Law*>(nullptr));
    PointGeometry geometry;
    find_geometry<Mode, Rational>(row, word, values, law.modulus, geometry);
    const LaneTensor H = gradient<Rational>(values, geometry);
    put_stress<Rational>(law.unit_stress(H), geometry, values);
  }
}

template <class Law, GeometryMode Mode, bool Rational>
void energy_loop(const PointRow& row, PointSums& sums) {
  constexpr std::size_t kStride =
      std::size_t(fields<Mode, Rational>()) * quantities<Mode, Rational>() * kLanes;
  const double* values = row.values;
  Lanes energy{};
  for (int word = 0; word < row.words; ++word, values += kStride) {
    const auto& law = law_at(row, word, static_cast<const Law*>(nullptr));
    PointGeometry geometry;
    find_geometry<Mode, Rational>(row, word, values, law.modulus, geometry);
    const LaneTensor H = gradient<Rational>(values, geometry);
    energy += geometry.w_det * law.unit_energy(H);
  }
  for (int lane = 0; lane < kLanes; ++lane) sums.sum += energy[lane];
}

template <class Law, GeometryMode Mode, bool Rational>
void stress_change_loop(const PointRow& row, PointSums& /*sums*/) {
  constexpr int kThree = 3 * quantities<Mode, Rational>() * kLanes;
  constexpr std::size_t kStride = std::size_t(fields<Mode, Rational>()) * kThree / 3 + kThree;
  double* values = row.values;
  for (int word = 0; word < row.words; ++word, values += kStride) {
    const auto& law = law_at(row, word, static_cast<const Law*>(nullptr));
    PointGeometry geometry;
    find_geometry<Mode, Rational>(row, word, values + kThree, law.modulus, geometry);
    const LaneTensor H = gradient<Rational>(values, geometry);
    const LaneTensor G = gradient<Rational>(values + kThree, geometry);
    put_stress<Rational>(change_at(law, H, G), geometry, values);
  }
}

template <class Law, int Shift>
void aligned_stress_loop(const PointRow& row, PointSums& /*sums*/) {
  double* values = row.values;
  for (int word = 0; word < row.words; ++word, values += 9 * kLanes) {
    const auto& law = law_at(row, word, static_cast<const Law*>(nullptr));
    AlignedGeometry<Shift> geometry;
    find_geometry(row, word, law.modulus, geometry);
    const LaneTensor H = gradient(values, geometry);
    put_stress(law.unit_stress(H), geometry, values);
  }
}

void note_least(const Lanes& det, const double* weights, PointSums& sums) {
  for (int lane = 0; lane < kLanes; ++lane)
    if (weights[lane] != 0.0 && !(det[lane] >= sums.least_det)) sums.least_det = det[lane];
}

template <bool Rational>
void tabulate(const PointRow& row, PointSums& sums) {
  constexpr std::size_t kStride = (Rational ? 16 : 9) * kLanes;
  for (int word = 0; word < row.words; ++word) {
    const double* weights = row.weights + std::size_t(word) * kLanes;
    PointGeometry geometry;
    note_least(work_out<Rational>(row.values + kStride * word, row.weight * load(weights), geometry), weights,
               sums);
    double* table = row.table + std::size_t(word) * table_numbers(Rational) * kLanes;
    for (int k = 0; k < 9; ++k) store(geometry.K.m[k / 3][k % 3], table + k * kLanes);
    store(geometry.w_det, table + 9 * kLanes);
    if (Rational)
      for (int d = 0; d < 3; ++d) store(geometry.g[d], table + (10 + d) * kLanes);
  }
}

// Values have four quantities here, rational or not: the function itself is tested.
template <bool Rational>
void mass(const PointRow& row, PointSums& sums) {
  constexpr int kFields = Rational ? 4 : 3;
  for (int word = 0; word < row.words; ++word) {
    const double* weights = row.weights + std::size_t(word) * kLanes;
    double* values = row.values + std::size_t(word) * kFields * 4 * kLanes;
    double packed[kFields * (Rational ? 4 : 3) * kLanes];
    for (int c = 0; c < kFields; ++c)
      for (int k = 0; k < (Rational ? 4 : 3); ++k)
        store(load(values + (4 * c + k) * kLanes), packed + ((Rational ? 4 : 3) * c + k) * kLanes);
    PointGeometry geometry;
    note_least(work_out<Rational>(packed, row.weight * load(weights), geometry), weights, sums);
    Lanes share = geometry.w_det;
    for (int lane = 0; lane < kLanes; ++lane) sums.sum += share[lane];
    if (Rational) share *= inverse_or_zero(load(values + 15 * kLanes));
    for (int k = 0; k < 3; ++k) store(Lanes{}, values + k * kLanes);
    store(share, values + 3 * kLanes);
  }
}

template <GeometryMode Mode, bool Rational, class... Laws>
constexpr PointLoops loops(LawList<Laws...>) {
  return {{stress_loop<Laws, Mode, Rational>..., stress_loop<OutsideWord, Mode, Rational>},
          {energy_loop<Laws, Mode, Rational>..., energy_loop<OutsideWord, Mode, Rational>},
          {stress_change_loop<Laws, Mode, Rational>..., stress_change_loop<OutsideWord, Mode, Rational>}};
}

template <int Shift, class... Laws>
constexpr PointLoops aligned_loops(LawList<Laws...>) {
  return {{aligned_stress_loop<Laws, Shift>..., aligned_stress_loop<OutsideWord, Shift>},
          {energy_loop<Laws, GeometryMode::affine, false>...,
           energy_loop<OutsideWord, GeometryMode::affine, false>},
          {stress_change_loop<Laws, GeometryMode::affine, false>...,
           stress_change_loop<OutsideWord, GeometryMode::affine, false>}};
}

template <GeometryMode Mode>
constexpr PointLoops kLoops[2] = {loops<Mode, false>(ElasticLaws{}), loops<Mode, true>(ElasticLaws{})};
constexpr PointLoops kAlignedLoops[3] = {aligned_loops<0>(ElasticLaws{}), aligned_loops<1>(ElasticLaws{}),
                                         aligned_loops<2>(ElasticLaws{})};
constexpr GeometryLoops kGeometryLoops[2] = {{tabulate<false>, mass<false>}, {tabulate<true>, mass<true>}};

}  // namespace

namespace NURBS_SIMD_LEVEL {
const PointLoops& point_loops(GeometryMode mode, bool rational) {
  return mode == GeometryMode::affine   ? kLoops<GeometryMode::affine>[rational]
         : mode == GeometryMode::stored ? kLoops<GeometryMode::stored>[rational]
                                        : kLoops<GeometryMode::recomputed>[rational];
}
const PointLoops& aligned_loops(int shift) { return kAlignedLoops[shift]; }
const GeometryLoops& geometry_loops(bool rational) { return kGeometryLoops[rational]; }
}  // namespace NURBS_SIMD_LEVEL

}  // namespace structure
