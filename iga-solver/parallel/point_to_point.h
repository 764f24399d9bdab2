// SPDX-License-Identifier: GPL-2.0-or-later
// Columns of nodal arrays that go from rank to rank, the same in every step: what goes where is settled once.
#pragma once

#include <mpi.h>

#include <vector>

#include "nurbs/types.h"

namespace parallel {

/// What travels between this rank and another: columns of an array, in an order that both know.
struct Route {
  int rank;
  std::vector<int> send, receive;
};

class PointToPoint {
 public:
  /// Collective in pairs: what one sends, the other receives, equally many.  Two exchanges of one
  /// communicator that are under way at once need different tags.
  PointToPoint(MPI_Comm comm, int tag, std::vector<Route> routes);
  ~PointToPoint();
  PointToPoint(const PointToPoint&) = delete;
  PointToPoint& operator=(const PointToPoint&) = delete;

  /// Sends columns of `values` (3 x n), which may change as soon as this returns.
  void begin(const nurbs::NodalVectors& values);
  /// Waits, and sets the columns that are received.
  void finish(nurbs::NodalVectors& values);

 private:
  struct Message {
    std::vector<int> columns;
    std::vector<double> numbers;
  };
  std::vector<Message> out_, in_;
  std::vector<MPI_Request> requests_;  // persistent, of in_ and then of out_
};

}  // namespace parallel
