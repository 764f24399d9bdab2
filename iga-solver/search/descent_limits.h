// SPDX-License-Identifier: GPL-2.0-or-later
// What descents to a foot go by: phi = |S - d|^2 / 2 over local coordinates from -1 to 1 of an element.
#pragma once

namespace search {

/// phi counts as convex where its curvature is above this; a plane has 1.
constexpr double kLeastCurvature = 1e-10;
/// A tangent shorter than this part of the element's size vanishes, as at a pole.
constexpr double kPole = 1e-6;
/// Armijo's condition: the part of the predicted decrease that a step must bring.
constexpr double kDecrease = 0.1;
/// Coordinates nearer to an element's border than this are on it.
constexpr double kWellInside = 1.0 - 0x1p-48;
/// Lengths below sqrt(2 phi + size^2) times this are round-off of the evaluation.
constexpr double kRoundOff = 0x1p-50;

}  // namespace search
