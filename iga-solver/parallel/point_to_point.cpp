// SPDX-License-Identifier: GPL-2.0-or-later
#include "parallel/point_to_point.h"

#include <utility>

namespace parallel {

PointToPoint::PointToPoint(MPI_Comm comm, int tag, std::vector<Route> routes) {
  std::vector<int> to, from;
  for (Route& route : routes) {
    if (!route.send.empty()) {
      out_.push_back({std::move(route.send), {}});
      to.push_back(route.rank);
    }
    if (!route.receive.empty()) {
      in_.push_back({std::move(route.receive), {}});
      from.push_back(route.rank);
    }
  }
  requests_.resize(in_.size() + out_.size());
  MPI_Request* request = requests_.data();
  for (std::size_t i = 0; i < in_.size(); ++i) {
    in_[i].numbers.resize(3 * in_[i].columns.size());
    MPI_Recv_init(in_[i].numbers.data(), static_cast<int>(in_[i].numbers.size()), MPI_DOUBLE, from[i], tag,
                  comm, request++);
  }
  for (std::size_t i = 0; i < out_.size(); ++i) {
    out_[i].numbers.resize(3 * out_[i].columns.size());
    MPI_Send_init(out_[i].numbers.data(), static_cast<int>(out_[i].numbers.size()), MPI_DOUBLE, to[i], tag,
                  comm, request++);
  }
}

PointToPoint::~PointToPoint() {
  int finished = 0;
  MPI_Finalized(&finished);
  if (finished) return;
  for (MPI_Request& request : requests_) MPI_Request_free(&request);
}

void PointToPoint::begin(const nurbs::NodalVectors& values) {
  for (Message& message : out_)
    for (std::size_t i = 0; i < message.columns.size(); ++i)
      nurbs::Vector3::Map(&message.numbers[3 * i]) = values.col(message.columns[i]);
  if (!requests_.empty()) MPI_Startall(static_cast<int>(requests_.size()), requests_.data());
}

void PointToPoint::finish(nurbs::NodalVectors& values) {
  if (requests_.empty()) return;
  MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
  for (const Message& message : in_)
    for (std::size_t i = 0; i < message.columns.size(); ++i)
      values.col(message.columns[i]) = nurbs::Vector3::Map(&message.numbers[3 * i]);
}

}  // namespace parallel
