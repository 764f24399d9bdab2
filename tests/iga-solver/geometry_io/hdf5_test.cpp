// SPDX-License-Identifier: GPL-2.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "geometry_io/geometry_io.h"
#include "geometry_io/hdf5_file.h"

namespace geometry_io {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

GeometryFile parsed_hdf5(const std::string& bytes) {
  return read_geometry("wall.h5", [&](const std::string&) { return bytes; });
}

// What the schema asks for, piece by piece, so that each can be left out or spoilt.
struct File {
  std::string format = "nurbs-geometry", units = "cgs", group = "/patches/0";
  std::vector<int> version{1}, degrees{2, 1};
  std::vector<double> xi{0, 0, 0, 1, 1, 1}, eta{0, 0, 1, 1}, weights{1, 0.5, 1, 1, 0.5, 1};
  std::vector<double> points{1, 0, 0, 1, 1, 0, 0, 1, 0, 1, 0, 2, 1, 1, 2, 0, 1, 2};
  std::vector<hsize_t> net{2, 3}, points_shape{2, 3, 3};
  std::vector<std::string> wall{"all"};
  bool text_knots = false;
  std::string extra;

  std::string bytes() const {
    Hdf5Output file;
    if (!format.empty()) file.set_text("/", "format", format);
    if (!version.empty()) file.set_integers("/", "version", version);
    if (!units.empty()) file.set_text("/", "units", units);
    file.add_group("/patches");
    if (!group.empty()) write_patch(file);
    if (!wall.empty()) {
      file.add_group("/surfaces");
      file.add_texts("/surfaces/wall", wall);
    }
    return file.bytes();
  }

  void write_patch(Hdf5Output& file) const {
    file.add_group(group);
    if (!degrees.empty()) file.set_integers(group, "degrees", degrees);
    if (text_knots)
      file.add_texts(group + "/knots_xi", {"0", "0", "1", "1"});
    else
      file.add_numbers(group + "/knots_xi", {xi.size()}, xi.data());
    file.add_numbers(group + "/knots_eta", {eta.size()}, eta.data());
    if (!weights.empty()) file.add_numbers(group + "/weights", net, weights.data());
    if (!points.empty()) file.add_numbers(group + "/control_points", points_shape, points.data());
    if (!extra.empty()) file.add_numbers(group + "/" + extra, net, weights.data());
  }
};

TEST(Hdf5, ReadsWhatTheSchemaSays) {
  const GeometryFile file = parsed_hdf5(File().bytes());
  EXPECT_EQ(file.units, Units::cgs);
  const auto& surface = std::get<nurbs::Surface>(file.patches.at(0));
  EXPECT_EQ(surface.space.weight(1), 0.5);
  EXPECT_EQ(surface.control_points.col(4), nurbs::Vector3(1, 1, 2));
  EXPECT_EQ(file.surfaces.at("wall"), (std::vector<SurfacePiece>{{0, std::nullopt}}));
}

TEST(Hdf5, WeightsAndSurfacesMayBeLeftOut) {
  File some;
  some.weights.clear();
  some.wall.clear();
  const GeometryFile file = parsed_hdf5(some.bytes());
  EXPECT_FALSE(std::get<nurbs::Surface>(file.patches.at(0)).space.rational());
  EXPECT_TRUE(file.surfaces.empty());
}

struct BadHdf5 {
  const char* name;
  std::function<void(File&)> spoil;
  std::string message;
};

TEST(Hdf5, SaysWhatWasGivenAndWhatWasExpected) {
  const BadHdf5 table[] = {
      {"no format", [](File& f) { f.format = ""; }, "/: attribute 'format' is missing"},
      {"other format", [](File& f) { f.format = "mesh"; },
       "/: attribute 'format' is 'mesh', expected 'nurbs-geometry'"},
      {"no version", [](File& f) { f.version.clear(); }, "/: attribute 'version' is missing"},
      {"later version", [](File& f) { f.version = {3}; }, "/: attribute 'version' is 3, expected 1 or 2"},
      {"no units", [](File& f) { f.units = ""; }, "/: attribute 'units' is missing"},
      {"other units", [](File& f) { f.units = "inch"; },
       "/: units is 'inch', expected one of: si, cgs, mm-g-ms, mm-t-s"},
      {"no patch", [](File& f) { f.group = ""; }, "/patches: is empty, expected the groups 0, 1, ..."},
      {"patch 1 alone", [](File& f) { f.group = "/patches/1"; }, "/patches/0: is missing"},
      {"no degrees", [](File& f) { f.degrees.clear(); }, "/patches/0: attribute 'degrees' is missing"},
      {"one degree", [](File& f) { f.degrees = {2}; },
       "'degrees' has 1 numbers, expected 2 (a surface) or 3 (a volume)"},
      {"degree 0",
       [](File& f) {
         f.degrees = {0, 1};
       },
       "/patches/0/knots_xi: degree is 0, expected 1 to 16"},
      {"volume without zeta",
       [](File& f) {
         f.degrees = {2, 1, 1};
       },
       "/patches/0/knots_zeta: is missing"},
      {"knots not open", [](File& f) { f.xi[2] = 0.5; }, "/patches/0/knots_xi: knot vector is not open"},
      {"knots decrease", [](File& f) { f.eta[3] = 0.5; }, "/patches/0/knots_eta: knot 4 is 0.5 after 1"},
      {"knots as text", [](File& f) { f.text_knots = true; },
       "/patches/0/knots_xi: holds text, expected numbers"},
      {"weights of another shape",
       [](File& f) {
         f.net = {3, 2};
       },
       "/patches/0/weights: shape is [3][2], expected [2][3] by the knots and degrees"},
      {"negative weight", [](File& f) { f.weights[1] = -0.5; },
       "/patches/0/weights: weight 2 is -0.5, expected a number > 0"},
      {"no points", [](File& f) { f.points.clear(); }, "/patches/0/control_points: is missing"},
      {"flat list of points",
       [](File& f) {
         f.points_shape = {6, 3};
       },
       "/patches/0/control_points: shape is [6][3], expected [2][3][3] by the knots and degrees"},
      {"points not finite", [](File& f) { f.points[4] = 1.0 / 0.0; },
       "/patches/0/control_points: control point 2 is not finite"},
      {"misspelt weights", [](File& f) { f.extra = "weight"; },
       "/patches/0: unknown data set 'weight' of a patch, expected knots_xi, knots_eta, control_points and "
       "weights"},
      {"trimming", [](File& f) { f.extra = "trimming_curves"; },
       "/patches/0: unknown data set 'trimming_curves'"},
      {"unknown face", [](File& f) { f.wall = {"top"}; },
       "/surfaces/wall: unknown face 'top' of a surface patch, expected all"},
      {"no such patch", [](File& f) { f.wall = {"1"}; },
       "/surfaces/wall: patch is '1', expected a number from 0 to 0"},
  };
  for (const BadHdf5& bad : table) {
    SCOPED_TRACE(bad.name);
    File file;
    bad.spoil(file);
    try {
      parsed_hdf5(file.bytes());
      ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), StartsWith("wall.h5: "));
      EXPECT_THAT(error.what(), HasSubstr(bad.message));
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
}

TEST(Hdf5, FilesThatAreNoneOrBroken) {
  const std::string good = File().bytes();
  struct Broken {
    std::string bytes, message;
  };
  for (const Broken& broken : {
           Broken{"", "wall.h5: is no HDF5 file"},
           Broken{"units: si\n", "wall.h5: is no HDF5 file"},
           Broken{good.substr(0, 8), "wall.h5: changed since it was written"},
           Broken{good.substr(0, good.size() / 2), "wall.h5: changed since it was written"},
           Broken{good.substr(0, good.size() - 1), "wall.h5: changed since it was written"},
       })
    EXPECT_THAT([&] { parsed_hdf5(broken.bytes); },
                testing::ThrowsMessage<InputError>(HasSubstr(broken.message)))
        << broken.bytes.size();
}

}  // namespace
}  // namespace geometry_io
