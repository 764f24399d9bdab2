// SPDX-License-Identifier: GPL-2.0-or-later
// What each writer writes, its reader reads: every number to the last bit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "geometry_io/geometry_io.h"
#include "nurbs/primitives.h"
#include "nurbs/shapes.h"

namespace geometry_io {
namespace {

using nurbs::Face;
using nurbs::Surface;
using nurbs::Volume;

constexpr Format kFormats[] = {format::yaml, format::hdf5, format::xml};

const char* file_of(Format format) {
  return format == format::yaml ? "wall.yaml" : format == format::hdf5 ? "wall.h5" : "wall.xml";
}

GeometryFile again(const GeometryFile& geometry, Format format) {
  const std::string bytes = write_geometry(geometry, format);
  return read_geometry(file_of(format), [&](const std::string&) { return bytes; });
}

template <class Numbers>
bool same_bits(const Numbers& a, const Numbers& b) {
  const auto same = [](double x, double y) { return std::memcmp(&x, &y, sizeof x) == 0; };
  return std::equal(a.data(), a.data() + a.size(), b.data(), b.data() + b.size(), same);
}

template <int Dim>
void expect_same(const nurbs::Patch<Dim>& a, const nurbs::Patch<Dim>& b) {
  for (int d = 0; d < Dim; ++d) {
    EXPECT_EQ(a.space.degree(d), b.space.degree(d));
    EXPECT_TRUE(same_bits(a.space.knots(d).knots(), b.space.knots(d).knots())) << "knots " << d;
  }
  EXPECT_TRUE(same_bits(a.space.weights(), b.space.weights()));
  EXPECT_TRUE(same_bits(a.control_points, b.control_points));
}

void expect_same(const GeometryFile& a, const GeometryFile& b) {
  EXPECT_EQ(a.units, b.units);
  ASSERT_EQ(a.patches.size(), b.patches.size());
  for (size_t p = 0; p < a.patches.size(); ++p) {
    ASSERT_EQ(a.patches[p].index(), b.patches[p].index());
    if (const auto* surface = std::get_if<Surface>(&a.patches[p]))
      expect_same(*surface, std::get<Surface>(b.patches[p]));
    else
      expect_same(std::get<Volume>(a.patches[p]), std::get<Volume>(b.patches[p]));
  }
  EXPECT_EQ(a.surfaces, b.surfaces);
}

GeometryFile random_geometry(int seed, bool surfaces, bool volumes) {
  nurbs::shapes::Random random(seed);
  GeometryFile geometry{Units::cgs, {}, {}};
  for (const bool rational : {true, false, true}) {
    if (surfaces) geometry.patches.push_back(nurbs::shapes::random_patch<2>(random, 5, 4, rational));
    if (volumes) geometry.patches.push_back(nurbs::shapes::random_patch<3>(random, 3, 3, rational));
  }
  return geometry;
}

TEST(RoundTrip, RandomSurfaces) {
  for (int seed = 0; seed < 20; ++seed) {
    GeometryFile geometry = random_geometry(seed, true, false);
    geometry.surfaces = {{"wall", {{0, {}}, {1, {}}, {2, {}}}}, {"two lids: <\"'&/>", {{2, {}}, {0, {}}}}};
    for (const Format format : kFormats) {
      if (format == format::hdf5) {
        geometry.surfaces.erase("two lids: <\"'&/>");  // '/' makes groups
        geometry.surfaces["lids \xc3\xa4"] = {{1, {}}};
      }
      SCOPED_TRACE(file_of(format));
      expect_same(geometry, again(geometry, format));
    }
  }
}

TEST(RoundTrip, RandomVolumesWithNamedFaces) {
  for (int seed = 0; seed < 10; ++seed) {
    GeometryFile geometry = random_geometry(seed, false, true);
    geometry.surfaces = {{"bore", {{2, Face::zeta_minus}, {0, Face::eta_plus}}},
                         {"end", {{1, Face::xi_plus}}}};
    for (const Format format : kFormats) {
      SCOPED_TRACE(file_of(format));
      expect_same(geometry, again(geometry, format));
    }
  }
}

TEST(RoundTrip, SurfacesBesideVolumes) {
  GeometryFile geometry = random_geometry(1, true, true);
  geometry.surfaces = {{"wall", {{1, Face::xi_minus}, {4, {}}}}};
  for (const Format format : {format::yaml, format::hdf5}) expect_same(geometry, again(geometry, format));
  EXPECT_THAT([&] { write_geometry(geometry, format::xml); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("surfaces and volumes")));
}

TEST(RoundTrip, NumbersAtTheLimits) {
  GeometryFile geometry = random_geometry(3, true, false);
  Surface& surface = std::get<Surface>(geometry.patches[0]);
  using Limits = std::numeric_limits<double>;
  const double hard[] = {-0.0,      Limits::denorm_min(),     Limits::min(),      1e100, -1e100, 0.1 + 0.2,
                         1.0 / 3.0, std::nextafter(1.0, 2.0), 9007199254740993.0, 1e23};
  std::copy(std::begin(hard), std::end(hard), surface.control_points.data());
  geometry.surfaces = {{"wall", {{0, {}}}}};
  for (const Format format : kFormats) {
    SCOPED_TRACE(file_of(format));
    expect_same(geometry, again(geometry, format));
  }
}

// Of one control point, weight, or knot, whatever the format.
TEST(RoundTrip, NumbersBeyondTheLimitsAreRefused) {
  const GeometryFile good = random_geometry(3, true, false);
  const nurbs::Space<2>& space = std::get<Surface>(good.patches[0]).space;
  for (const Format format : kFormats) {
    const auto refused = [&](const std::string& bytes, const char* words) {
      EXPECT_THAT([&] { read_geometry(file_of(format), [&](const std::string&) { return bytes; }); },
                  testing::ThrowsMessage<InputError>(
                      testing::AllOf(testing::HasSubstr(file_of(format)), testing::HasSubstr(words))));
    };
    GeometryFile geometry = good;
    for (const double beyond : {1.1e100, -1e300}) {
      std::get<Surface>(geometry.patches[0]).control_points(1, 2) = beyond;
      refused(write_geometry(geometry, format), "at most 1e+100");
    }
  }
  std::vector<double> weights(space.control_point_count(), 1.0);
  weights[1] = 1.1e100;
  EXPECT_THROW(nurbs::Space<2>(space.knots(), weights), std::invalid_argument);
  EXPECT_THROW(nurbs::KnotVector(1, {0, 0, 1.1e100, 1.1e100}), std::invalid_argument);
}

TEST(RoundTrip, ExactRoundShapesStayClosedToTheLastBit) {
  const nurbs::Frame place = nurbs::frame({0.1, -0.2, 0.3}, {1, 2, 3});
  GeometryFile geometry{
      Units::si, {nurbs::sphere(place, 0.7, nurbs::arc(0, 360), nurbs::arc(-90, 90))}, {{"all", {{0, {}}}}}};
  for (const Format format : kFormats) expect_same(geometry, again(geometry, format));
}

// The chain through every format ends where it began.
TEST(RoundTrip, FromFormatToFormat) {
  GeometryFile geometry = random_geometry(7, true, false);
  geometry.surfaces = {{"wall", {{1, {}}, {0, {}}}}};
  expect_same(geometry, again(again(again(geometry, format::xml), format::hdf5), format::yaml));
}

// Two names that differ in broken bytes alone would be one.
TEST(RoundTrip, YamlNamesAreUtf8) {
  GeometryFile geometry = random_geometry(1, true, false);
  geometry.surfaces = {{"Gr\xf6\xdf", {{0, {}}}}};
  EXPECT_THAT([&] { write_geometry(geometry, format::yaml); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("not UTF-8")));
}

TEST(RoundTrip, HDF5NamesHaveNoSlash) {
  GeometryFile geometry = random_geometry(1, true, false);
  geometry.surfaces = {{"a/b", {{0, {}}}}};
  EXPECT_THAT([&] { write_geometry(geometry, format::hdf5); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("a/b")));
}

}  // namespace
}  // namespace geometry_io
