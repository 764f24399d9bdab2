// SPDX-License-Identifier: GPL-2.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/history.h"
#include "io/series_file.h"

namespace {

using io::Vector3;
using structure::NodalVectors;
namespace fs = std::filesystem;

// A free block falling under gravity: every quantity of the history has a closed form, which the central
// difference scheme meets exactly.
const char* const kFalling = R"(units: mm-g-ms
geometry:
  box: {origin: [0, 0, 0], size: [1, 2, 3], elements: [2, 1, 1], degree: 2}
material: {law: linear_elastic, youngs_modulus: 100, poissons_ratio: 0.3, density: 0.5}
probes:
  top: {face: zeta+, at: [0.5, 0.5]}
loads: {gravity: [0, 0, -2]}
)";
constexpr double kMass = 3.0, kGravity = 2.0, kStep = 0.01;

class HistoryFile : public testing::Test {
 public:
  ~HistoryFile() override { fs::remove_all(folder_); }

 protected:
  // One folder per test: CTest runs them at the same time.
  HistoryFile()
      : folder_(fs::path(testing::TempDir()) /
                (std::string("history_") + testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder_);
  }

  std::string base() const { return (folder_ / "falling").string(); }

  fs::path folder_;
};

// Also one that this process is writing, which has a lock of our own in place of HDF5's.
hid_t open_to_read(const std::string& path) {
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_file_locking(access, false, true);
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access);
  H5Pclose(access);
  return file;
}

std::vector<double> read_series(const std::string& path, const std::string& name) {
  const hid_t file = open_to_read(path);
  const hid_t data_set = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
  const hid_t space = H5Dget_space(data_set);
  std::vector<double> values(H5Sget_simple_extent_npoints(space));
  EXPECT_GE(H5Dread(data_set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  H5Sclose(space), H5Dclose(data_set), H5Fclose(file);
  return values;
}

std::string read_attribute(const std::string& path, const std::string& object, const std::string& name) {
  const hid_t file = open_to_read(path);
  const hid_t attribute = H5Aopen_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
  const hid_t type = H5Aget_type(attribute);
  std::string value(H5Tget_size(type), '\0');
  EXPECT_GE(H5Aread(attribute, type, value.data()), 0);
  H5Tclose(type), H5Aclose(attribute), H5Fclose(file);
  return value.c_str();
}

structure::ExplicitSolver falling_block(io::ModelFile model) {
  structure::ExplicitSolver solver = io::build_solver(model);
  solver.set_time_step(kStep);
  solver.initialise_forces(structure::NodalVectors::Zero(3, solver.body().node_count()));
  return solver;
}

void run(structure::ExplicitSolver& solver, io::History& history, int steps) {
  const structure::NodalVectors F = structure::NodalVectors::Zero(3, solver.body().node_count());
  history.record_if_due(solver);
  for (int n = 0; n < steps; ++n) {
    solver.begin_step();
    solver.end_step(F);
    history.record_if_due(solver);
  }
}

TEST_F(HistoryFile, HoldsTheClosedFormOfAFallingBlockAtEveryOutputTime) {
  const io::ModelFile model = io::parse_model_file(kFalling, "falling.yaml");
  structure::ExplicitSolver solver = falling_block(model);
  const double every = 2.5 * kStep;  // no multiple of the step: the nearest steps are recorded
  io::History history({every, base()}, model.geometry.units, model.probes);
  EXPECT_EQ(history.path(), base() + ".h5");
  run(solver, history, 100);

  const std::vector<double> time = read_series(history.path(), "time");
  ASSERT_EQ(time.size(), 41u);
  const auto column = [&](const char* name) { return read_series(history.path(), name); };
  const auto kinetic = column("kinetic_energy"), strain = column("strain_energy"), work = column("load_work");
  const auto linear = column("linear_momentum"), angular = column("angular_momentum");
  const auto largest = column("largest_displacement"), top = column("probes/top");
  ASSERT_EQ(linear.size(), 3 * time.size());
  ASSERT_EQ(angular.size(), 3 * time.size());
  ASSERT_EQ(top.size(), 3 * time.size());
  for (std::size_t row = 0; row < time.size(); ++row) {
    const double t = time[row], v = -kGravity * t, w = -0.5 * kGravity * t * t;
    EXPECT_LE(std::abs(t - row * every), 0.5 * kStep + 1e-12);
    EXPECT_NEAR(kinetic[row], 0.5 * kMass * v * v, 1e-11);
    EXPECT_NEAR(strain[row], 0.0, 1e-11);
    EXPECT_NEAR(work[row], kinetic[row], 1e-11);
    EXPECT_NEAR(linear[3 * row + 2], kMass * v, 1e-11);
    EXPECT_NEAR(angular[3 * row], 1.0 * kMass * v, 1e-11);  // centre of mass at (0.5, 1, z): L = r x m v
    EXPECT_NEAR(angular[3 * row + 1], -0.5 * kMass * v, 1e-11);
    EXPECT_NEAR(largest[row], -w, 1e-11);
    EXPECT_NEAR(top[3 * row + 2], w, 1e-11);
  }
}

// A history that begins late: one row at once, then those of its own times, none in between.
TEST_F(HistoryFile, BeginsAtAnyTime) {
  const io::ModelFile model = io::parse_model_file(kFalling, "falling.yaml");
  structure::ExplicitSolver solver = falling_block(model);
  const NodalVectors F = NodalVectors::Zero(3, solver.body().node_count());
  for (int n = 0; n < 105; ++n) solver.begin_step(), solver.end_step(F);
  io::History history({10 * kStep, base()}, model.geometry.units, model.probes);
  run(solver, history, 20);
  const std::vector<double> time = read_series(history.path(), "time");
  ASSERT_EQ(time.size(), 3u);
  EXPECT_NEAR(time[0], 105 * kStep, 1e-12);
  EXPECT_NEAR(time[1], 110 * kStep, 1e-12);
  EXPECT_NEAR(time[2], 120 * kStep, 1e-12);
}

// A next run that begins with a longer step asks for the row again that is there.
TEST_F(HistoryFile, HasNoRowTwiceWhereTheStepGrows) {
  const io::ModelFile model = io::parse_model_file(kFalling, "falling.yaml");
  structure::ExplicitSolver solver = falling_block(model);
  io::History history({kStep, base()}, model.geometry.units, model.probes);
  run(solver, history, 5);
  solver.set_time_step(3 * kStep);
  run(solver, history, 2);
  const std::vector<double> time = read_series(history.path(), "time");
  ASSERT_EQ(time.size(), 8u);
  for (std::size_t row = 1; row < time.size(); ++row) EXPECT_GT(time[row], time[row - 1]);
}

// An erg is 1 g cm^2/s^2; 1 g mm^2/ms^2 = 1e-3 kg (1e-3 m)^2 / (1e-3 s)^2 = 1 mJ = 1 t mm^2/s^2.
TEST_F(HistoryFile, CarriesUnits) {
  struct Names {
    geometry_io::Units units;
    const char *system, *time, *length, *energy, *momentum, *angular_momentum;
  };
  const io::ModelFile model = io::parse_model_file(kFalling, "falling.yaml");
  for (const Names& expected :
       {Names{geometry_io::Units::si, "si", "s", "m", "J", "kg m/s", "kg m^2/s"},
        Names{geometry_io::Units::cgs, "cgs", "s", "cm", "erg", "g cm/s", "g cm^2/s"},
        Names{geometry_io::Units::mm_g_ms, "mm-g-ms", "ms", "mm", "mJ", "g mm/ms", "g mm^2/ms"},
        Names{geometry_io::Units::mm_t_s, "mm-t-s", "s", "mm", "mJ", "t mm/s", "t mm^2/s"}}) {
    io::History history({1.0, base()}, expected.units, model.probes);
    history.record(io::measure(falling_block(model), model.probes));
    const auto unit = [&](const char* series) { return read_attribute(history.path(), series, "unit"); };
    EXPECT_EQ(read_attribute(history.path(), "/", "units"), expected.system);
    EXPECT_EQ(unit("time"), expected.time);
    for (const char* series : {"kinetic_energy", "strain_energy", "load_work"})
      EXPECT_EQ(unit(series), expected.energy) << series;
    EXPECT_EQ(unit("linear_momentum"), expected.momentum);
    EXPECT_EQ(unit("angular_momentum"), expected.angular_momentum);
    for (const char* series : {"largest_displacement", "probes/top"})
      EXPECT_EQ(unit(series), expected.length) << series;
  }
}

TEST_F(HistoryFile, IsCompleteOnDiskAfterEveryRecord) {
  const io::ModelFile model = io::parse_model_file(kFalling, "falling.yaml");
  structure::ExplicitSolver solver = falling_block(model);
  io::History history({kStep, base()}, model.geometry.units, model.probes);
  for (int block = 1; block <= 3; ++block) {
    run(solver, history, 200);
    // What a run killed now would leave.
    const std::string copy = base() + "_copy.h5";
    fs::copy_file(history.path(), copy, fs::copy_options::overwrite_existing);
    const std::vector<double> time = read_series(copy, "time");
    ASSERT_EQ(time.size(), 200u * block + 1);
    EXPECT_EQ(time.back(), solver.time());
    EXPECT_EQ(read_series(copy, "probes/top").size(), 3 * time.size());
  }
}

// A run that goes on from a state of step 40: what comes after it is written anew, not twice.
TEST_F(HistoryFile, GoesOnFromASavedState) {
  const io::ModelFile model = io::parse_model_file(kFalling, "falling.yaml");
  const io::HistoryOutput output{2.5 * kStep, base()};
  structure::ExplicitSolver first = falling_block(model);
  std::vector<double> state, whole;
  {
    io::History history(output, model.geometry.units, model.probes);
    run(first, history, 40);
    state = first.save();
    run(first, history, 60);  // lost with the run
    whole = read_series(history.path(), "probes/top");
  }
  structure::ExplicitSolver second = falling_block(model);
  second.load(state);
  {
    io::History history = io::History::resume(output, model.geometry.units, model.probes, second.time());
    EXPECT_EQ(history.last_time(), second.time()) << "step 40 is an output time";
    EXPECT_EQ(read_series(history.path(), "time").size(), 17u);
    run(second, history, 60);
    EXPECT_EQ(read_series(history.path(), "time").size(), 41u);
    EXPECT_EQ(read_series(history.path(), "probes/top"), whole);
  }
  fs::remove(base() + ".h5");
  second.load(state);
  const io::History anew = io::History::resume(output, model.geometry.units, model.probes, second.time());
  EXPECT_FALSE(anew.last_time());
}

// The rows that are there lie on other output times, or on none.
TEST_F(HistoryFile, GoesOnWithAnotherInterval) {
  const io::ModelFile model = io::parse_model_file(kFalling, "falling.yaml");
  structure::ExplicitSolver solver = falling_block(model);
  {
    io::History history({kStep, base()}, model.geometry.units, model.probes);
    run(solver, history, 37);
  }
  const auto go_on = [&](double every, int steps) {
    io::History history =
        io::History::resume({every, base()}, model.geometry.units, model.probes, solver.time());
    run(solver, history, steps);
    return read_series(history.path(), "time");
  };
  std::vector<double> time = go_on(10 * kStep, 26);  // from 37 to 63
  ASSERT_EQ(time.size(), 38u + 3u);
  EXPECT_NEAR(time[38], 40 * kStep, 1e-12);
  EXPECT_NEAR(time[40], 60 * kStep, 1e-12);
  time = go_on(8 * kStep, 15);  // to 78
  ASSERT_EQ(time.size(), 41u + 2u);
  EXPECT_NEAR(time[41], 64 * kStep, 1e-12);
}

TEST_F(HistoryFile, OfSomethingElseIsLeftAsItIs) {
  const io::ModelFile model = io::parse_model_file(kFalling, "falling.yaml");
  const io::HistoryOutput output{kStep, base()};
  structure::ExplicitSolver solver = falling_block(model);
  {
    io::History history(output, model.geometry.units, {});
    run(solver, history, 5);
  }
  const auto resume = [&](geometry_io::Units units, std::vector<structure::Probe> probes) {
    io::History::resume(output, units, std::move(probes), 0.0);
  };
  EXPECT_THAT([&] { resume(model.geometry.units, model.probes); },
              testing::ThrowsMessage<std::runtime_error>(
                  testing::AllOf(testing::HasSubstr("falling.h5"), testing::HasSubstr("probes/top"),
                                 testing::HasSubstr("move the file away"))));
  EXPECT_THAT([&] { resume(geometry_io::Units::cgs, {}); },
              testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("'mm-g-ms', expected 'cgs'")));
  EXPECT_EQ(read_series(base() + ".h5", "time").size(), 6u);
}

// What a damaged file says of sizes is not believed: neither an attribute of many texts nor rows that no
// file holds.
TEST_F(HistoryFile, OfDamagedSizesIsRefused) {
  const io::ModelFile model = io::parse_model_file(kFalling, "falling.yaml");
  const io::HistoryOutput output{kStep, base()};
  const std::string path = base() + ".h5";
  const auto write_good = [&] {
    structure::ExplicitSolver solver = falling_block(model);
    io::History history(output, model.geometry.units, {});
    run(solver, history, 5);
  };
  const auto expect_refused = [&](const char* why) {
    EXPECT_THAT([&] { io::History::resume(output, model.geometry.units, {}, 0.0); },
                testing::ThrowsMessage<std::runtime_error>(
                    testing::AllOf(testing::HasSubstr("falling.h5"), testing::HasSubstr(why))));
  };
  write_good();
  hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  H5Adelete(file, "units");
  const std::vector<char> texts(8000, 'm');
  const hsize_t count = texts.size() / 8;
  const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate_simple(1, &count, nullptr);
  H5Tset_size(type, 8);
  const hid_t attribute = H5Acreate2(file, "units", type, space, H5P_DEFAULT, H5P_DEFAULT);
  EXPECT_GE(H5Awrite(attribute, type, texts.data()), 0);
  H5Aclose(attribute), H5Sclose(space), H5Tclose(type), H5Fclose(file);
  expect_refused("units are '', expected");

  write_good();
  file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  for (const char* name : {"time", "load_work"}) {
    const hsize_t rows = hsize_t{1} << 40;
    const hid_t data_set = H5Dopen2(file, name, H5P_DEFAULT);
    EXPECT_GE(H5Dset_extent(data_set, &rows), 0);
    H5Dclose(data_set);
  }
  H5Fclose(file);
  expect_refused("1099511627776 rows in 8192 bytes of the file");

  fs::resize_file(path, 0);
  expect_refused("cannot open this file to go on with it");
  EXPECT_EQ(fs::file_size(path), 0U) << "HDF5 would begin a new one in it";
}

// The model reads a geometry file that its own output would replace: under the same name, another spelling, a
// link; so would the model file itself.
TEST_F(HistoryFile, NeverReplacesWhatTheModelIsReadFrom) {
  const std::string name = (folder_ / "block").string(), text_of_others = "not to be lost";
  std::ofstream(name + ".h5") << text_of_others;
  fs::create_symlink(name + ".h5", folder_ / "link.h5");
  fs::create_hard_link(name + ".h5", folder_ / "twin.h5");
  for (const std::string& output : {name, (folder_ / "." / ".." / folder_.filename() / "block").string(),
                                    (folder_ / "link").string(), (folder_ / "twin").string()}) {
    SCOPED_TRACE(output);
    io::HistoryOutput asked{1.0, output, "plate.yaml:7", {"plate.yaml", name + ".h5"}};
    EXPECT_THAT([&] { io::History(asked, geometry_io::Units::si, {}); },
                testing::ThrowsMessage<geometry_io::InputError>(
                    testing::AllOf(testing::StartsWith("plate.yaml:7: output.file is"),
                                   testing::HasSubstr("would be overwritten"))));
  }
  std::ostringstream kept;
  kept << std::ifstream(name + ".h5").rdbuf();
  EXPECT_EQ(kept.str(), text_of_others);
  // nor is it what the history is until it has a row
  io::HistoryOutput unfinished{1.0, base(), "plate.yaml:7", {base() + ".h5.part"}};
  std::ofstream(unfinished.inputs[0]) << text_of_others;
  EXPECT_THAT([&] { io::History(unfinished, geometry_io::Units::si, {}); },
              testing::ThrowsMessage<geometry_io::InputError>(testing::HasSubstr("would be overwritten")));
  io::History({1.0, base(), "plate.yaml:7", {name + ".h5"}}, geometry_io::Units::si,
              {});  // another file may be written
}

// Of two that write one file one would be lost.
TEST_F(HistoryFile, IsThatOfOneSolid) {
  const io::HistoryOutput one{1.0, base()},
      two{1.0, (folder_ / "." / "falling").string(), "plate.yaml:7", {}};
  const auto refused = testing::ThrowsMessage<geometry_io::InputError>(testing::AllOf(
      testing::StartsWith("plate.yaml:7: output.file is"),
      testing::EndsWith("falling.h5 is being written by another solid or run, expected another name")));
  {
    io::History history(one, geometry_io::Units::si, {});
    EXPECT_THAT([&] { io::History(two, geometry_io::Units::si, {}); }, refused);
    history.record(
        io::measure(falling_block(io::parse_model_file(kFalling, "falling.yaml")), {}));  // has its name now
    EXPECT_THAT([&] { io::History(two, geometry_io::Units::si, {}); }, refused);
    EXPECT_THAT([&] { io::History::resume(two, geometry_io::Units::si, {}, 0.0); }, refused);
  }
  io::History(two, geometry_io::Units::si, {});  // the other is closed
}

TEST_F(HistoryFile, NamesTheFileItCannotCreate) {
  EXPECT_THAT(([&] {
                io::History({1.0, base() + "_missing/history"}, geometry_io::Units::si, {});
              }),
              testing::ThrowsMessage<std::runtime_error>(
                  testing::HasSubstr("_missing/history.h5: HDF5 cannot create this file")));
}

TEST_F(HistoryFile, LeavesNothingUnfinished) {
  EXPECT_THAT(
      [&] {
        io::SeriesFile file(base() + ".h5");
        file.add_series("time", 1, "s");
        EXPECT_FALSE(fs::is_empty(folder_));
        file.add_series("time", 1, "s");
      },
      testing::ThrowsMessage<std::runtime_error>(
          testing::EndsWith("falling.h5: HDF5 cannot create the data set 'time'")));
  EXPECT_TRUE(fs::is_empty(folder_));
}

}  // namespace
