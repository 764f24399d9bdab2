// SPDX-License-Identifier: GPL-2.0-or-later
// What stiffnesses of elements are made of, whatever the material.  Elements near one another are asked for
// the same elements, so those that were asked for last are remembered.
#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "structure/compliance/reference_body.h"
#include "structure/solid/element_tables.h"

namespace structure {

class GradientProducts {
 public:
  /// Keeps a reference to the body.
  explicit GradientProducts(const ReferenceBody& body);
  GradientProducts(const GradientProducts&) = delete;
  GradientProducts& operator=(const GradientProducts&) = delete;

  /// From here on other elements are asked for: what was not asked for since the last time may be forgotten.
  void begin_patch();
  /// Integrals over an element of dR_A/dX_i dR_B/dX_j of its n functions [length]: row i n + A, column j n +
  /// B. Until the next call.
  const Eigen::MatrixXd& of(const BodyElement& element);
  void forget() {
    remembered_.clear();
    bytes_ = 0;
  }
  int integrated() const { return integrated_; }  ///< how many elements, those anew that were forgotten

 private:
  struct Remembered {
    Eigen::MatrixXd products;
    int patch;  // the last one that asked
  };
  void integrate(const BodyElement& element, Eigen::MatrixXd& products);

  const ReferenceBody& body_;
  std::vector<ElementTabulator> tabulators_;  // of patches
  std::map<BodyElement, Remembered> remembered_;
  std::size_t bytes_ = 0;
  int patch_ = 0, integrated_ = 0;
  Eigen::MatrixXd scratch_, weighted_;
  ElementTables tables_;
  std::vector<int> control_points_;
};

}  // namespace structure
