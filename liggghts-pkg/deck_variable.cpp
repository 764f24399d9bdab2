// SPDX-License-Identifier: GPL-2.0-or-later
#include "deck_variable.h"

#include <fmt/format.h>
#include <mpi.h>

#include <stdexcept>

#include "error.h"
#include "input.h"
#include "lammps.h"
#include "modify.h"
#include "update.h"
#include "variable.h"
#include "wall_messages.h"

namespace liggghts_pkg {

namespace {

int index_of(LAMMPS_NS::LAMMPS* lmp, const std::string& name) {
  std::string copy = name;  // LIGGGHTS wants char*
  LAMMPS_NS::Variable* const variables = lmp->input->variable;
  const int index = variables->find(copy.data());
  if (index < 0)
    throw std::invalid_argument(fmt::format(
        "'v_{}' is given, but there is no variable {}, expected an equal-style variable", name, name));
  if (!variables->equalstyle(index))
    throw std::invalid_argument(fmt::format("variable {} is not of equal style, expected one that is", name));
  return index;
}

/// Computes that the variable uses must know in which steps they are asked for.
double evaluate(LAMMPS_NS::LAMMPS* lmp, int index) {
  lmp->modify->clearstep_compute();
  const double value = lmp->input->variable->compute_equal(index);
  lmp->modify->addstep_compute(lmp->update->ntimestep + 1);
  return value;
}

}  // namespace

coupling::Value deck_variable(LAMMPS_NS::LAMMPS* lmp, const std::string& fix_id, const std::string& name) {
  index_of(lmp, name);
  return coupling::Value([=] {
    try {
      return evaluate(lmp, index_of(lmp, name));
    } catch (const std::invalid_argument& problem) {
      lmp->error->all(FLERR, wall_message(fix_id, problem.what()).c_str());
      throw;  // not reached
    }
  });
}

}  // namespace liggghts_pkg
