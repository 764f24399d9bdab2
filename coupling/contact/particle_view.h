// SPDX-License-Identifier: GPL-2.0-or-later
// The particles of one rank, as their code keeps them.
#pragma once

#include "coupling/contact/contact_memory.h"

namespace contact {

/// Arrays of `count` particles: numbers, or rows of three.  They belong to the caller and need to last for
/// one call only.
struct ParticleView {
  int count;
  const int* tag;        ///< global ids, each particle's own on all ranks
  const double* radius;  ///< [length]
  const double* x;       ///< centres [length]
  const double* v;       ///< velocities [length/time]
  double* f;             ///< forces: those of the wall are added [force]
  double* torque;        ///< likewise, about the centres [force length]
  const int* mask;       ///< particles meet the wall if this has the bit `group`; null: all do
  int group;
  ContactMemory memory;          ///< slots of contacts that go with their particle, from rank to rank, too
  const double* mass = nullptr;  ///< [mass]; null: as heavy as can be

  bool meets_wall(int i) const { return !mask || (mask[i] & group); }
  nurbs::Vector3 centre(int i) const { return nurbs::Vector3::Map(x + 3 * i); }
  nurbs::Vector3 velocity(int i) const { return nurbs::Vector3::Map(v + 3 * i); }
};

}  // namespace contact
