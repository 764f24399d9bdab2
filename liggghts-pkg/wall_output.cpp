// SPDX-License-Identifier: GPL-2.0-or-later
#include "wall_output.h"

#include <utility>

#include "coupling/face_fields.h"
#include "coupling/surface_fields.h"
#include "parallel/all_or_none.h"

namespace liggghts_pkg {

using parallel::on_first_rank;

WallOutput::WallOutput(MPI_Comm comm, OutputOptions options, std::unique_ptr<coupling::ContactFields> fields)
    : comm_(comm), options_(std::move(options)), fields_(std::move(fields)), series_(options_.file) {}

void WallOutput::begin_step(bool setup, double time) {
  if (saved_time_) earlier_ = *saved_time_ - time;
  saved_time_.reset();
  setup_ = setup;
  sampling_ = !setup || at_beginning();
  if (!sampling_) return;
  if (!options_.average) fields_->begin_interval();
  fields_->begin_sample();
}

void WallOutput::add(const coupling::SurfaceContact& contact) {
  if (!sampling_) return;
  coupling::SurfaceContact counted = contact;
  if (setup_) counted.worn_volume = 0.0;
  fields_->add(counted);
}

void WallOutput::write(long step, double time, const coupling::NodalVectors& control_points,
                       const coupling::RigidFrame& frame) {
  const coupling::ContactFields::State state = fields_->state(control_points, frame, options_.fields);
  on_first_rank(comm_, [&] {
    std::visit([&](const auto& fields) { series_.write(step, earlier_ + time, fields); }, state);
  });
  fields_->begin_interval();
  written_ = step;
}

std::vector<double> WallOutput::save(double time) const {
  std::vector<double> state = fields_->save();
  state.push_back(saved_time_ ? *saved_time_ : earlier_ + time);
  return state;
}

void WallOutput::load(std::vector<double> state, long step) {
  // Files of older versions hold no time.
  if (state.size() == fields_->state_size() + 1) {
    saved_time_ = state.back();
    state.pop_back();
  }
  fields_->load(state);
  on_first_rank(comm_, [&] { series_.resume(step); });
  written_ = step;
}

std::unique_ptr<coupling::ContactFields> fields_on(MPI_Comm comm, const coupling::ContactSurface& surface,
                                                   const coupling::NodalVectors& control_points) {
  if (surface.faces) return std::make_unique<coupling::FaceFields>(comm, surface.faces);
  return std::make_unique<coupling::SurfaceFields>(comm, surface.topology, control_points);
}

}  // namespace liggghts_pkg
