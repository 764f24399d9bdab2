// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact_fields.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "nurbs/assert.h"

namespace coupling {

ContactFields::ContactFields(MPI_Comm comm, int places, int cells)
    : comm_(comm),
      forces_(Eigen::MatrixXd::Zero(kRows, places)),
      contacts_(Eigen::MatrixXd::Zero(1, cells)),
      is_loaded_(places, false) {
  loaded_.reserve(places);
  counted_.reserve(cells);
}

void ContactFields::note_load(int place) {
  if (!is_loaded_[place]) loaded_.push_back(place);
  is_loaded_[place] = true;
}

Eigen::Matrix<double, ContactFields::kRows, 1> ContactFields::rows_of(const SurfaceContact& contact) {
  NURBS_ASSERT(std::abs(contact.normal.squaredNorm() - 1.0) < 1e-6, contact.normal.norm());
  const double normal_force = contact.force.dot(contact.normal);
  Eigen::Matrix<double, kRows, 1> rows;
  rows << -normal_force, contact.force - normal_force * contact.normal, contact.worn_volume;
  return rows;
}

void ContactFields::add_at(int place, const Eigen::Matrix<double, kRows, 1>& rows) {
  forces_.col(place) += rows;
  note_load(place);
}

void ContactFields::count_in(int cell) {
  if (contacts_(cell) == 0.0) counted_.push_back(cell);
  contacts_(cell) += 1.0;
}

Eigen::MatrixXd ContactFields::sum_over_ranks(const Eigen::MatrixXd& local) const {
  Eigen::MatrixXd sum = local;
  constexpr Eigen::Index kPiece = 1 << 30;  // MPI counts in int
  for (Eigen::Index first = 0; first < local.size(); first += kPiece)
    MPI_Reduce(local.data() + first, sum.data() + first,
               static_cast<int>(std::min(kPiece, local.size() - first)), MPI_DOUBLE, MPI_SUM, 0, comm_);
  return sum;
}

std::vector<vtk::Field> ContactFields::fields_of_places(const Eigen::MatrixXd& per_area,
                                                        const RigidFrame& frame,
                                                        const Selection& selection) const {
  std::vector<vtk::Field> fields;
  if (selection.pressure) fields.push_back({"pressure", mean() * per_area.row(kNormal)});
  if (selection.shear) fields.push_back({"shear", mean() * frame.rotation * per_area.middleRows(kShear, 3)});
  if (selection.wear) fields.push_back({"wear", per_area.row(kWear)});
  return fields;
}

std::vector<vtk::Field> ContactFields::fields_of_cells(const Eigen::MatrixXd& contacts,
                                                       const Selection& selection) const {
  if (!selection.contact_count) return {};
  return {{"contact_count", mean() * contacts}};
}

void ContactFields::begin_interval() {
  samples_ = 0.0;
  for (const int place : loaded_) {
    forces_.col(place).head<kWear>().setZero();
    is_loaded_[place] = false;
  }
  loaded_.clear();
  for (const int cell : counted_) contacts_(cell) = 0.0;
  counted_.clear();
}

std::vector<double> ContactFields::save() const {
  const Eigen::MatrixXd forces = all_forces(), contacts = all_contacts();
  std::vector<double> state{samples_};
  state.insert(state.end(), forces.data(), forces.data() + forces.size());
  state.insert(state.end(), contacts.data(), contacts.data() + contacts.size());
  return state;
}

void ContactFields::load(const std::vector<double>& state) {
  if (state.size() != state_size())
    throw std::invalid_argument("the restart file holds " + std::to_string(state.size()) +
                                " numbers of surface fields, expected " + std::to_string(state_size()) +
                                " for this geometry");
  samples_ = state[0];
  int rank = 0;
  MPI_Comm_rank(comm_, &rank);
  const double share = rank == 0 ? 1.0 : 0.0;  // the sums of all ranks stand on one
  const double* next = state.data() + 1;
  forces_ = share * Eigen::Map<const Eigen::MatrixXd>(next, kRows, forces_.cols());
  contacts_ = share * Eigen::Map<const Eigen::MatrixXd>(next + forces_.size(), 1, contacts_.cols());
  for (int place = 0; place < forces_.cols(); ++place) note_load(place);
  counted_.resize(contacts_.cols());
  std::iota(counted_.begin(), counted_.end(), 0);
}

}  // namespace coupling
