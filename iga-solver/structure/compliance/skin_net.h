// SPDX-License-Identifier: GPL-2.0-or-later
// How forces at a foot of the skin are on the body's nodes.
#pragma once

#include "structure/compliance/net_mean.h"
#include "structure/compliance/smooth_seams.h"

namespace structure {

struct SkinNet {
  SmoothSeams seams;
  NetMean mean;

  SkinNet(const ReferenceBody& body, const std::vector<SkinPiece>& skin)
      : seams(body, skin), mean(body, skin, seams) {}
  /// What is beside a unit force where it is spread, carried as that is.
  NetMean::Beside beside(const SkinPoint& foot) const {
    NetMean::Beside beside = mean.beside(foot);
    seams.carry(beside.nodes, beside.Z);
    return beside;
  }
};

}  // namespace structure
