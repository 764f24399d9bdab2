// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/cross_shift.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <stdexcept>
#include <utility>

namespace coupling {

void CrossShift::Forces::clear() {
  for (const int node : nodes) values.col(node).setZero();
  nodes.clear();
}

void CrossShift::Forces::find_nodes() {
  nodes.clear();
  for (Eigen::Index node = 0; node < values.cols(); ++node)
    if (!values.col(node).isZero(0.0)) nodes.push_back(static_cast<int>(node));
}

CrossShift::CrossShift(const SurfaceMap& map, const std::vector<LocalCompliance::Link>& links) {
  std::map<NodeId, int> nodes;
  const std::vector<NodeId> selected = map.selected_nodes();
  for (std::size_t c = 0; c < selected.size(); ++c) {
    const auto [node, is_new] = nodes.emplace(selected[c], static_cast<int>(nodes.size()));
    if (is_new) point_of_.push_back(static_cast<int>(c));
    node_of_.push_back(node->second);
  }
  links_of_.resize(nodes.size());
  for (const auto& [first, second, give] : links) {
    const int a = nodes.at(first), b = nodes.at(second);
    links_of_[a].push_back({b, give});
    links_of_[b].push_back({a, give});
  }
  const auto count = static_cast<Eigen::Index>(nodes.size());
  for (NodalVectors* const values : {&expected_.values, &last_.values, &before_.values, &shift_})
    values->setZero(3, count);
  is_there_.resize(nodes.size(), false);
}

void CrossShift::begin_step() {
  for (const int node : expected_.nodes) {
    shift_.col(node).setZero();
    for (const Link& link : links_of_[node]) shift_.col(link.node).setZero();
  }
  expected_.clear();
  std::set_union(last_.nodes.begin(), last_.nodes.end(), before_.nodes.begin(), before_.nodes.end(),
                 std::back_inserter(expected_.nodes));
  for (const int node : expected_.nodes)
    expected_.values.col(node) = 2.0 * last_.values.col(node) - before_.values.col(node);
  shift();
}

// In the order of nodes, so that sums are the same on all ranks.
void CrossShift::shift() {
  for (const int node : expected_.nodes) {
    const Vector3 f = expected_.values.col(node);
    for (const Link& link : links_of_[node]) {
      shift_.col(node) -= link.give * f;
      shift_.col(link.node) += link.give * f;
    }
  }
}

// The largest over all waves from node to node of S times the stiffness to an element, over 0.45/(E' h): of
// dense contacts on equal elements, as quadratic functions filter forces and displacements.
double CrossShift::feedback(int control_point, double stiffness) const {
  constexpr double kLargest = 0.46 / 0.45;
  double give = 0.0;
  for (const Link& link : links_of_[node_of_[control_point]]) give = std::max(give, link.give);
  return kLargest * give * stiffness;
}

void CrossShift::remember(const std::vector<int>& control_points, const NodalVectors& forces) {
  before_.clear();
  std::swap(last_, before_);
  for (const int c : control_points) {
    const int node = node_of_[c];
    last_.values.col(node) += forces.col(c);
    if (!is_there_[node]) last_.nodes.push_back(node);
    is_there_[node] = true;
  }
  for (const int node : last_.nodes) is_there_[node] = false;
  std::sort(last_.nodes.begin(), last_.nodes.end());
}

std::vector<double> CrossShift::save(const std::vector<int>& own) const {
  std::vector<double> state(state_size(), 0.0);
  double* next = state.data();
  for (const Forces* const forces : {&expected_, &last_, &before_}) {
    for (const int c : own)
      for (int d = 0; d < 3; ++d) next[3 * node_of_[c] + d] = forces->values(d, node_of_[c]);
    next += forces->values.size();
  }
  return state;
}

void CrossShift::load(const std::vector<double>& state) {
  if (state.size() != state_size())
    throw std::invalid_argument(fmt::format(
        "the state has {} numbers of forces between contacts, expected {}", state.size(), state_size()));
  const double* next = state.data();
  for (Forces* const forces : {&expected_, &last_, &before_}) {
    std::copy_n(next, forces->values.size(), forces->values.data());
    next += forces->values.size();
    forces->find_nodes();
  }
  shift_.setZero();
  shift();
}

}  // namespace coupling
