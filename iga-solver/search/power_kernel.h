// SPDX-License-Identifier: GPL-2.0-or-later
// What a search computes on the power form of elements (power_element.h), as functions on plain numbers: they
// are compiled once for each instruction set that simd_level.h knows, and once for each of the degrees 2 x 2
// and 3 x 3 and for all others.
//
// An element is a row of numbers: its origin O (3), its size, then (A_x, A_y, A_z), and W of a rational
// patch, of every coefficient a_ij, i + (p+1) j of them before it.  Rows are aligned to 64 bytes.
#pragma once

#include "nurbs/max_degree.h"
#include "nurbs/simd_level.h"
#include "search/descent_limits.h"

namespace search {

using nurbs::available;
using nurbs::simd_level;
using nurbs::SimdLevel;

/// phi = |S - d|^2 / 2 at one local point, with derivatives by s.  Symmetric matrices as (00, 01, 11).
struct DistanceJet {
  double phi;
  double gradient[2];  ///< r.S_i with r = S - d
  double metric[3];    ///< S_i.S_j
  double hessian[3];   ///< S_i.S_j + r.S_ij
  double r[3], S_i[2][3], S_ij[3][3];
};

/// The control points of one element.
struct ElementNet {
  const double* points;   ///< the first; three numbers each
  const double* origin;   ///< the one in the middle
  const double* weights;  ///< of a rational patch
  int stride;             ///< from one row of the patch's control points to the next
};

/// Numbers of an element's row.
constexpr int row_length(int coefficients, bool rational) {
  return 4 + (rational ? 4 * coefficients : 3 * coefficients + 1);  // the last is read with three others
}

/// Where a Newton iteration inside one element ends.
struct NewtonEnd {
  alignas(32) double foot[3];  ///< S
  double distance;             ///< |S - d|; that of the last point accepted if there is no foot
  double s[2];                 ///< the foot's, or those of the last point accepted
  double next[2];              ///< where a step from there leads, outside perhaps
  int iterations;              ///< 0 if the first step already needs more than this iteration
  bool done;                   ///< the foot is found
};

/// The elements of one direction.
struct AxisNumbers {
  double front, back;                ///< parameters of the patch's ends
  double elements_per_length, last;  ///< as if all elements were equal; the number of the last
  const double* elements;  ///< of each begin, end, half width and its inverse, and four more numbers
};

/// Many iterations, number by number.
struct NewtonBatch {
  static constexpr int kCapacity = 64;  // a multiple of the length of every word

  int count;
  const AxisNumbers* axes[2];
  alignas(64) double d[3][kCapacity];
  double xi[2][kCapacity];  ///< parameters where to start; then the foot's, if there is one

  // What locate() makes of xi; element: e_0 + n_0 e_1, or -1 where elements are not equal.
  int element[kCapacity];
  double s[2][kCapacity], begin[2][kCapacity], end[2][kCapacity], half_width[2][kCapacity];

  const double* row[kCapacity];  ///< of the element

  // As in NewtonEnd (s, too); borders: on how many ends of the patch the foot lies.
  double next[2][kCapacity], foot[3][kCapacity], distance[kCapacity];
  long long iterations[kCapacity], done[kCapacity], borders[kCapacity];

  NewtonEnd newton_end(int k) const {
    return {{foot[0][k], foot[1][k], foot[2][k]}, distance[k], {s[0][k], s[1][k]}, {next[0][k], next[1][k]},
            static_cast<int>(iterations[k]),      done[k] != 0};
  }
};

/// The functions for one pair of degrees and one instruction set.
struct ElementKernel {
  using Matrix = double[nurbs::kMaxDegree + 1];  ///< a row of it

  int p, q;
  /// out[k + (p+1) l] = sum_ij M0[k][i] M1[l][j] P_ij, four numbers each, with the homogeneous points
  /// P_ij = (w (P - O), w), or (P - O, 0) of a polynomial patch, relative to the one in the middle, O.
  void (*transform)(int p, int q, const Matrix* M0, const Matrix* M1, const ElementNet& net, double* out);
  /// The element's row; M0, M1 make powers.
  void (*build)(int p, int q, const Matrix* M0, const Matrix* M1, const ElementNet& net, double* row);
  void (*evaluate)(int p, int q, const double* element, const double (&s)[2], const double (&d)[3],
                   DistanceJet& out);
  /// Newton's method while phi is convex and every full step stays inside the element and leads downhill:
  /// nearly all warm searches.  The general descent does the rest (element_descent.h).  The start (s0, s1)
  /// comes by value: numbers just written one by one cannot be read back as a word without waiting.
  void (*newton)(int p, int q, const double* element, const double* d, double s0, double s1, NewtonEnd& end);
  /// The same for many points, several in a SIMD word, each in any element.
  void (*newton_batch)(int p, int q, NewtonBatch& batch);
  /// Elements and local coordinates where they start, as ElementAxis::locate finds them.
  void (*locate)(NewtonBatch& batch);
};

/// Throws std::invalid_argument if this machine does not have the instruction set.
ElementKernel element_kernel(int p, int q, bool rational, SimdLevel level);

}  // namespace search
