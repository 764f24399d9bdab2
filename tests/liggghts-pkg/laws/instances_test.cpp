// SPDX-License-Identifier: GPL-2.0-or-later
// Several LIGGGHTS instances in one process: our fix styles go into each, our contact models once into the
// process.
#include <gtest/gtest.h>
#include <mpi.h>

#include <memory>
#include <string>

#include "contact_laws.h"
#include "force.h"
#include "input.h"
#include "lammps.h"
#include "pair_gran.h"

namespace {

using LAMMPS_NS::LAMMPS;

std::unique_ptr<LAMMPS> new_instance() {
  std::string words[] = {"liggghts", "-screen", "none", "-log", "none"};
  char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), words[3].data(), words[4].data()};
  return std::make_unique<LAMMPS>(5, arguments, MPI_COMM_WORLD);
}

/// The pair style that a deck with this law gets.
std::string normal_model(LAMMPS& lmp, const std::string& law) {
  for (const std::string& command :
       {std::string("atom_style granular"), std::string("boundary f f f"), std::string("newton off"),
        std::string("communicate single vel yes"), std::string("region box block -1 1 -1 1 -1 1 units box"),
        std::string("create_box 1 box"), "pair_style gran model " + law})
    lmp.input->one(command.c_str());
  auto* pair = dynamic_cast<LAMMPS_NS::PairGran*>(lmp.force->pair);
  return pair && pair->contact_match("normal", law) ? law : "another";
}

TEST(Instances, EachKnowsTheContactLaws) {
  testing::internal::CaptureStderr();
  const auto first = new_instance();
  EXPECT_EQ(normal_model(*first, "penalty/linear"), "penalty/linear");
  {
    const auto second = new_instance();
    EXPECT_EQ(normal_model(*second, "penalty/quadratic"), "penalty/quadratic");
  }
  const auto third = new_instance();
  EXPECT_EQ(normal_model(*third, "penalty/hertz"), "penalty/hertz");
  first->input->one("clear");
  EXPECT_EQ(normal_model(*first, "penalty/hertz"), "penalty/hertz");

  // LIGGGHTS' own factories warn of each of its models for each further instance; of ours there must be none
  const std::string warnings = testing::internal::GetCapturedStderr();
  const std::string before_hash = "(gran, ";
  int stock_warnings = 0;
  for (auto at = warnings.find(before_hash); at != std::string::npos;
       at = warnings.find(before_hash, at + 1)) {
    const int normal_id = std::stoi(warnings.substr(at + before_hash.size())) & 63;
    liggghts_pkg::for_each_law([&](auto law) { EXPECT_NE(normal_id, law.id); });
    ++stock_warnings;
  }
  EXPECT_GT(stock_warnings, 0);
}

class MpiEnvironment : public testing::Environment {
  void SetUp() override { MPI_Init(nullptr, nullptr); }
  void TearDown() override { MPI_Finalize(); }
};
const auto* const kMpi = testing::AddGlobalTestEnvironment(new MpiEnvironment);

}  // namespace
