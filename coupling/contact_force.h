// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace coupling {

/// One contact as the rank of its particle reports it.  Plain data: it travels as one piece of bytes.
struct ContactForce {
  long tag;      ///< particle's global id
  int branch;    ///< which of the particle's contacts with this wall
  int patch;     ///< of the foot
  double xi[2];  ///< foot on the patch
  double F[3];   ///< force on the surface [force]
  /// Of a contact that is corrected by what the mesh gives way, how stiff its law is along the normal
  /// [force/length].
  double stiffness = 0.0;
  /// And a couple: forces dR_A/dxi_j couple[j] on its control points, whose sum is zero [force].
  bool has_couple = false;
  bool is_spread = false;
  double couple[2][3] = {};
  /// And, if it is spread, what is beside the foot: forces Z_A spread on control points (net_spread.h), whose
  /// sum is zero [force].
  double spread[3] = {};
};

}  // namespace coupling
