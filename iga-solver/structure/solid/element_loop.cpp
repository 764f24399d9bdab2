// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/solid/element_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace structure {

namespace {

constexpr int kMaxElementValues = 3 * padded(nurbs::RationalBasis<3>::kMaxFunctions);

void gather(const std::vector<int>& columns, int padded, const nurbs::NodalVectors& u, double* values) {
  const int n = static_cast<int>(columns.size());
  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < n; ++a) values[i * padded + a] = u(i, columns[a]);
    for (int a = n; a < padded; ++a) values[i * padded + a] = 0.0;
  }
}

}  // namespace

std::vector<int> element_columns(const nurbs::Space<3>& space, const SpanBox& box,
                                 const std::vector<int>& columns, const std::array<int, 3>& span) {
  int first[3], length[3];
  for (int d = 0; d < 3; ++d) {
    const nurbs::KnotVector& knots = space.knots(d);
    first[d] = knots.span_of_element(span[d]) - knots.span_of_element(box.begin[d]);
    length[d] =
        knots.span_of_element(box.end[d] - 1) - knots.span_of_element(box.begin[d]) + knots.degree() + 1;
  }
  std::vector<int> own;
  for (int k = 0; k <= space.degree(2); ++k)
    for (int j = 0; j <= space.degree(1); ++j)
      for (int i = 0; i <= space.degree(0); ++i)
        own.push_back(columns[first[0] + i + length[0] * (first[1] + j + length[1] * (first[2] + k))]);
  return own;
}

ElementLoop::ElementLoop(const nurbs::Space<3>& space, const nurbs::NodalVectors& X,
                         const std::vector<PlacedBox>& boxes, const Material& material, Quadrature quadrature)
    : material_(material), force_kernel_(force_kernel(padded(space.functions_per_element()))) {
  const ElementTabulator tabulate(space, quadrature);
  remembered_ = std::size_t(tabulate.slots()) * material.state_size();
  std::size_t count = 0;
  for (const PlacedBox& box : boxes) count += box.spans.element_count();
  elements_.reserve(count);
  for (const PlacedBox& box : boxes) {
    std::vector<int> local(box.columns.size());
    std::iota(local.begin(), local.end(), 0);
    const std::size_t first = elements_.size();
    for (int k = box.spans.begin[2]; k < box.spans.end[2]; ++k)
      for (int j = box.spans.begin[1]; j < box.spans.end[1]; ++j)
        for (int i = box.spans.begin[0]; i < box.spans.end[0]; ++i) {
          Element& element = elements_.emplace_back();
          element.read = element_columns(space, box.spans, box.read(), {i, j, k});
          element.write = element_columns(space, box.spans, local, {i, j, k});
          tabulate(space.element_index({i, j, k}), {X, element.read}, element.tables);
        }
    boxes_.push_back({first, elements_.size(), box.write()});
    share_.resize(3, std::max<Eigen::Index>(share_.cols(), static_cast<Eigen::Index>(local.size())));
  }
}

ElementMemory ElementLoop::memory_of(std::size_t element, const PointMemory& memory) const {
  const std::size_t first = element * remembered_;
  return {memory.held ? memory.held + first : nullptr, memory.next ? memory.next + first : nullptr,
          memory.dt};
}

template <class ElementForce>
void ElementLoop::add_shares(int first, int end, nurbs::NodalVectors& f, ElementForce element_force) const {
  double f_element[kMaxElementValues];
  for (int b = first; b < end; ++b) {
    share_.setZero();
    for (std::size_t e = boxes_[b].first; e < boxes_[b].end; ++e) {
      const Element& element = elements_[e];
      element_force(e, f_element);
      for (std::size_t a = 0; a < element.write.size(); ++a)
        for (int i = 0; i < 3; ++i) share_(i, element.write[a]) += f_element[i * element.tables.padded + a];
    }
    for (std::size_t a = 0; a < boxes_[b].write.size(); ++a) f.col(boxes_[b].write[a]) += share_.col(a);
  }
}

void ElementLoop::add_forces(int first, int end, const PointMemory& memory, const nurbs::NodalVectors& u,
                             nurbs::NodalVectors& f) const {
  double u_element[kMaxElementValues];
  add_shares(first, end, f, [&](std::size_t e, double* f_element) {
    const Element& element = elements_[e];
    gather(element.read, element.tables.padded, u, u_element);
    force_kernel_(material_, element.tables.geometry(), memory_of(e, memory), u_element, f_element);
  });
}

void ElementLoop::add_force_changes(const PointMemory& memory, const nurbs::NodalVectors& u,
                                    const nurbs::NodalVectors& w, nurbs::NodalVectors& f) const {
  double u_element[kMaxElementValues], w_element[kMaxElementValues];
  add_shares(0, box_count(), f, [&](std::size_t e, double* f_element) {
    const Element& element = elements_[e];
    gather(element.read, element.tables.padded, u, u_element);
    gather(element.read, element.tables.padded, w, w_element);
    element_force_change(material_, element.tables.geometry(), memory_of(e, memory).state, u_element,
                         w_element, f_element);
  });
}

void ElementLoop::add_energies(const PointMemory& memory, const nurbs::NodalVectors& u, ExactSum& sum) const {
  double u_element[kMaxElementValues];
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    gather(elements_[e].read, elements_[e].tables.padded, u, u_element);
    sum.add(element_energy(material_, elements_[e].tables.geometry(), memory_of(e, memory).state, u_element));
  }
}

double ElementLoop::table_bytes() const {
  double bytes = 0.0;
  for (const Element& element : elements_)
    bytes += sizeof(double) * static_cast<double>(element.tables.dR_dX.size() + element.tables.wJ.size());
  return bytes;
}

}  // namespace structure
