// SPDX-License-Identifier: GPL-2.0-or-later
// Series, errors and the order of points; what VTK reads from the files is in test_vtk_reader.py.
#include "vtk/vtu_file.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "nurbs/primitives.h"

namespace {

using nurbs::KnotVector;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

vtk::PatchFields<2> square() {
  const std::array<KnotVector, 2> knots{KnotVector::uniform(2, 3), KnotVector::uniform(2, 2)};
  return {nurbs::plane({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, knots), {}, {}};
}

/// An empty folder for one test.
class Folder : public testing::Test {
 protected:
  void SetUp() override {
    path_ = std::filesystem::temp_directory_path() /
            ("vtu_file_test_" + std::to_string(::getpid()) +
             testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(path_);
  }
  void TearDown() override { std::filesystem::remove_all(path_); }
  std::string operator()(const std::string& name) const { return (path_ / name).string(); }
  std::string text(const std::string& name) const {
    std::ifstream file(path_ / name);
    std::ostringstream all;
    all << file.rdbuf();
    return all.str();
  }
  int count() const {
    return static_cast<int>(std::distance(std::filesystem::directory_iterator(path_), {}));
  }

 private:
  std::filesystem::path path_;
};
using VtkSeries = Folder;
using VtuFile = Folder;

TEST(PointOrder, IsCornersThenEdgesThenInside) {
  EXPECT_THAT(vtk::point_order<2>({2, 3}), ElementsAre(0, 2, 11, 9, 1, 5, 8, 10, 3, 6, 4, 7));
}

TEST(PointOrder, NamesEveryPointOfAHexahedronOnce) {
  std::vector<int> order = vtk::point_order<3>({2, 3, 4});
  std::sort(order.begin(), order.end());
  ASSERT_EQ(order.size(), 60u);
  for (int k = 0; k < 60; ++k) EXPECT_EQ(order[k], k);
}

TEST_F(VtkSeries, HoldsEveryStateAfterEachWrite) {
  vtk::Series series((*this)("wall"));
  EXPECT_TRUE(series.empty());
  series.write(0, 0.0, std::vector{square()});
  EXPECT_THAT(text("wall.pvd"), HasSubstr("wall_0.vtu"));
  series.write(50, 0.5, std::vector{square()});
  EXPECT_THAT(text("wall.pvd"), HasSubstr("timestep=\"0.5\" file=\"wall_50.vtu\""));
  EXPECT_THAT(text("wall.pvd"), HasSubstr("wall_0.vtu"));
  EXPECT_EQ(count(), 3) << "no unfinished file is left";
}

TEST_F(VtkSeries, IsNotWrittenIntoAPipe) {
  ASSERT_EQ(mkfifo((*this)("wall_0.vtu").c_str(), 0600), 0);
  EXPECT_THAT([&] { vtk::Series((*this)("wall")).write(0, 0.0, std::vector{square()}); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr("wall_0.vtu': Is a named pipe")));
}

TEST_F(VtkSeries, GoesOnAfterARestart) {
  vtk::Series before((*this)("wall"));
  for (long step : {0L, 10L, 20L}) before.write(step, 0.1 * step, std::vector{square()});
  vtk::Series after((*this)("wall"));
  after.resume(10);
  after.write(15, 1.5, std::vector{square()});
  const std::string index = text("wall.pvd");
  EXPECT_THAT(index, HasSubstr("wall_10.vtu"));
  EXPECT_THAT(index, HasSubstr("wall_15.vtu"));
  EXPECT_THAT(index, Not(HasSubstr("wall_20.vtu"))) << "of a future that is computed again";
}

TEST_F(VtkSeries, GoesOnAtATime) {
  vtk::Series before((*this)("wall"));
  EXPECT_EQ(vtk::Series((*this)("wall")).resume_at(1.0), std::nullopt);
  for (long n : {0L, 1L, 2L}) before.write(n, 0.5 * n, std::vector{square()});
  vtk::Series after((*this)("wall"));
  EXPECT_EQ(after.resume_at(0.5), 0.5);
  EXPECT_EQ(after.count(), 2);
  after.write(2, 0.75, std::vector{square()});
  EXPECT_THAT(text("wall.pvd"), HasSubstr("timestep=\"0.75\" file=\"wall_2.vtu\""));
  EXPECT_THAT(text("wall.pvd"), Not(HasSubstr("timestep=\"1\"")));
}

// All digits, also through a restart, which writes what it has read.
TEST_F(VtkSeries, TimesReadBackToTheLastBit) {
  const double time = 1.0 / 3.0 + 1e-15;
  vtk::Series((*this)("wall")).write(7, time, std::vector{square()});
  vtk::Series after((*this)("wall"));
  after.resume(7);
  after.write(8, 2.0 * time, std::vector{square()});
  const std::string index = text("wall.pvd"), key = "timestep=\"";
  std::vector<double> times;
  for (std::size_t at = index.find(key); at != std::string::npos; at = index.find(key, at + 1))
    times.push_back(std::strtod(index.c_str() + at + key.size(), nullptr));
  EXPECT_THAT(times, ElementsAre(time, 2.0 * time));
}

// Whoever looks while a state is written sees the former one: the new one takes its place in one moment.
TEST_F(VtkSeries, TheFormerIndexIsNotTouched) {
  vtk::Series series((*this)("wall"));
  series.write(0, 0.0, std::vector{square()});
  std::filesystem::create_hard_link((*this)("wall.pvd"), (*this)("seen.pvd"));
  const std::string former = text("wall.pvd");
  series.write(1, 0.1, std::vector{square()});
  EXPECT_EQ(text("seen.pvd"), former);
  EXPECT_NE(text("wall.pvd"), former);
}

TEST_F(VtkSeries, DoesNotContinueAnotherFile) {
  std::ofstream((*this)("wall.pvd")) << "not a series";
  vtk::Series series((*this)("wall"));
  EXPECT_THAT([&] { series.resume(1); }, testing::ThrowsMessage<std::runtime_error>(HasSubstr("wall.pvd")));
}

TEST_F(VtuFile, NamesTheFileThatCannotBeWritten) {
  const std::string path = (*this)("no/such/wall.vtu");
  EXPECT_THAT([&] { vtk::write_vtu<2>(path, std::vector{square()}); },
              testing::ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr(path), HasSubstr("No such file or directory"))));
}

TEST_F(VtuFile, RefusesFieldsThatDoNotFit) {
  const auto expect = [&](std::vector<vtk::PatchFields<2>> patches, const std::string& message) {
    EXPECT_THAT([&] { vtk::write_vtu((*this)("wall.vtu"), patches); },
                testing::ThrowsMessage<std::invalid_argument>(HasSubstr(message)));
  };
  vtk::PatchFields<2> few = square(), hot = square(), broken = square();
  few.control_points = {{"p", Eigen::MatrixXd::Zero(1, 19)}};
  expect({few}, "field 'p' has 19 values per control point, expected 20");
  hot.elements = {{"heat", Eigen::MatrixXd::Zero(1, 6)}};
  expect({square(), hot}, "1 fields per element, expected 0");
  broken.elements = {{"heat", Eigen::MatrixXd::Constant(1, 6, std::numeric_limits<double>::quiet_NaN())}};
  expect({broken}, "field 'heat' is not finite");
  vtk::PatchFields<2> cold = hot;
  cold.elements[0].name = "cold";
  expect({hot, cold}, "field 'cold' with 1 components, expected 'heat' with 1");
}

}  // namespace
