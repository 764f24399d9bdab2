// SPDX-License-Identifier: GPL-2.0-or-later
// Files that are none of ours, as the standards of their formats begin them; and texts that only look like
// it.
#include "geometry_io/file_kind.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "geometry_io/input_error.h"
#include "geometry_io/regular_file.h"
#include "geometry_io/yaml_map.h"

namespace geometry_io {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
using testing::ThrowsMessage;

const std::string kStep = "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('a plate'),'2;1');\n";
const std::string kIges =
    std::string("A plate") + std::string(65, ' ') + "S      1\n1H,,1H;" + std::string(65, ' ') + "G      1\n";
const std::string kTextStl = "solid plate\n facet normal 0 0 1\n  outer loop\n";
const std::string kHdf5("\x89HDF\r\n\x1a\n\0\0\0\0", 12);

std::string binary_stl(int triangles) {
  std::string bytes = "solid as some programs write it";
  bytes.resize(80, ' ');
  bytes += {static_cast<char>(triangles), 0, 0, 0};
  return bytes + std::string(50 * triangles, 'x');
}

TEST(FileKind, ByFirstBytes) {
  EXPECT_EQ(kind_of_file("a.yaml", kStep), FileKind::step);
  EXPECT_EQ(kind_of_file("a.yaml", "\xEF\xBB\xBF\r\n" + kStep), FileKind::step);
  EXPECT_EQ(kind_of_file("a.h5", kIges), FileKind::iges);
  EXPECT_EQ(kind_of_file("a", kTextStl), FileKind::stl);
  EXPECT_EQ(kind_of_file("a", "solid \nendsolid \n"), FileKind::stl);
  EXPECT_EQ(kind_of_file("a", "SOLID A\nFacet Normal 0 0 1\n"), FileKind::stl);
  EXPECT_EQ(kind_of_file("a", binary_stl(3)), FileKind::stl);
  EXPECT_EQ(kind_of_file("a.yaml", kHdf5), FileKind::hdf5);
  EXPECT_EQ(kind_of_file("a.yaml", std::string(1024, '\0') + kHdf5), FileKind::hdf5);
  EXPECT_EQ(kind_of_file("a.yaml", "<?xml version='1.0'?><xml/>"), FileKind::xml);
  EXPECT_EQ(kind_of_file("a.yaml", std::string("a: 1\0", 5)), FileKind::binary);
  EXPECT_EQ(kind_of_file("a.yaml",
                         "\x7f"
                         "ELF\x02\x01\x01"),
            FileKind::binary);
}

TEST(FileKind, ByName) {
  for (const char* name : {"a.stp", "A.STEP", "b/a.step", "a.p21"})
    EXPECT_EQ(kind_of_file(name, "units: si\n"), FileKind::step) << name;
  EXPECT_EQ(kind_of_file("a.igs", ""), FileKind::iges);
  EXPECT_EQ(kind_of_file("a.IGES", ""), FileKind::iges);
  EXPECT_EQ(kind_of_file("a.stl", "triangles"), FileKind::stl);
}

TEST(FileKind, TextsThatOnlyLookLikeIt) {
  const std::string utf16("\xFF\xFEu\0:\0", 6);
  for (const std::string& text :
       {std::string(), std::string("units: si\n"), std::string("solid: {facet: 1}\n"),
        std::string("<<: *base\n"), std::string("solid\n"), std::string("# \xC3\xA9\r\n\tform\f\n"),
        std::string(100, ' '), utf16})
    EXPECT_EQ(kind_of_file("step", text), FileKind::text) << text;
}

TEST(FileKind, ARefusalNamesTheWayOut) {
  const auto read = [](const char* file, const std::string& bytes) {
    return [=] { YamlMap::parse(bytes, file); };
  };
  EXPECT_THAT(read("x.step", kStep), ThrowsMessage<InputError>(AllOf(
                                         StartsWith("x.step: is a STEP file, expected another kind of file"),
                                         HasSubstr("geometry: {file: NAME}"))));
  EXPECT_THAT(read("x.yaml", kTextStl), ThrowsMessage<InputError>(HasSubstr("from files called .stl")));
  EXPECT_THAT(read("x.yaml", kHdf5), ThrowsMessage<InputError>(HasSubstr("geometry: {file: NAME}")));
}

// ------------------------------------------------------------------------------------------- what is no file

class RegularFile : public testing::Test {
 protected:
  RegularFile() : folder_(testing::TempDir() + "regular_file." + std::to_string(getpid())) {
    std::filesystem::create_directory(folder_);
  }
  ~RegularFile() override { std::filesystem::remove_all(folder_); }
  std::string path(const char* name) const { return folder_ + "/" + name; }

  std::string folder_;
};

TEST_F(RegularFile, IsReadWholeAlsoThroughALink) {
  const std::string bytes("a\0b\r\n", 5);
  std::ofstream(path("file"), std::ios::binary) << bytes;
  std::filesystem::create_symlink("file", path("link"));
  EXPECT_EQ(read_regular_file(path("link")).bytes, bytes);
  EXPECT_EQ(read_regular_file(path("link")).problem, "");
  EXPECT_EQ(problem_as_output(path("link")), "");
  EXPECT_EQ(problem_as_output(path("new")), "");
}

TEST_F(RegularFile, OthersAreRefusedBeforeTheyAreOpened) {
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink("/dev/zero", path("link"));
  std::filesystem::create_symlink("nowhere", path("dangling"));
  const std::vector<std::pair<std::string, const char*>> table = {{path("pipe"), "named pipe"},
                                                                  {"/dev/zero", "device"},
                                                                  {path("link"), "device"},
                                                                  {folder_, "directory"},
                                                                  {path("dangling"), "No such file"}};
  for (const auto& [name, problem] : table)
    EXPECT_THAT(read_regular_file(name).problem, HasSubstr(problem)) << name;
  EXPECT_THAT(problem_as_output(path("pipe")), HasSubstr("named pipe"));
  EXPECT_THAT(problem_as_output("/dev/full"), HasSubstr("device"));
}

// What stands where the unfinished file would be is neither written into nor waited for.
TEST_F(RegularFile, OthersAreRefusedAsUnfinishedFilesToo) {
  ASSERT_EQ(mkfifo(path("a.part").c_str(), 0600), 0);
  std::ofstream(path("file")) << "of somebody";
  std::filesystem::create_symlink("file", path("b.part"));
  EXPECT_THAT(problem_as_output(path("a")), AllOf(HasSubstr("a.part: "), HasSubstr("named pipe")));
  EXPECT_THAT(write_file(path("b"), [](std::ostream& file) { file << "new"; }),
              HasSubstr("b.part: Is a link"));
  EXPECT_EQ(read_regular_file(path("file")).bytes, "of somebody");
}

TEST_F(RegularFile, IsNotLeftUnfinished) {
  std::filesystem::create_directory(path("folder"));
  EXPECT_THAT(write_file(path("folder/none/file"), [](std::ostream&) {}), HasSubstr("No such file"));
  EXPECT_THAT(write_file(path("folder/file"), [](std::ostream& file) { file.setstate(std::ios::badbit); }),
              HasSubstr("error"));
  EXPECT_TRUE(std::filesystem::is_empty(path("folder")));
  EXPECT_EQ(write_file(path("folder/file"), [](std::ostream& file) { file << "whole"; }), "");
  EXPECT_EQ(read_regular_file(path("folder/file")).bytes, "whole");
}

TEST_F(RegularFile, TakesThePlaceThatADanglingLinkNames) {
  std::filesystem::create_directory(path("elsewhere"));
  std::filesystem::create_symlink("elsewhere/link", path("link"));
  std::filesystem::create_symlink("target", path("elsewhere/link"));
  std::filesystem::create_symlink("loop", path("loop"));
  EXPECT_EQ(write_file(path("link"), [](std::ostream& file) { file << "new"; }), "");
  EXPECT_TRUE(std::filesystem::is_symlink(path("link")));
  EXPECT_TRUE(std::filesystem::is_symlink(path("elsewhere/link")));
  EXPECT_EQ(read_regular_file(path("elsewhere/target")).bytes, "new");
  EXPECT_FALSE(unfinished_name(path("loop")).empty()) << "comes to an end";
}

TEST_F(RegularFile, IsWrittenBesideTheOlderOneAndReplacesItWhenComplete) {
  std::ofstream(path("file")) << "older";
  std::filesystem::create_directory(path("elsewhere"));
  std::filesystem::create_symlink("elsewhere/target", path("link"));
  std::ofstream(path("elsewhere/target")) << "older";
  for (const char* name : {"file", "link", "new"}) {
    std::ofstream(unfinished_name(path(name))) << "newer";
    EXPECT_EQ(read_regular_file(path(name)).bytes, std::string(name) == "new" ? "" : "older");
    EXPECT_EQ(finish_file(path(name)), "");
    EXPECT_EQ(read_regular_file(path(name)).bytes, "newer");
    EXPECT_THAT(finish_file(path(name)), HasSubstr("No such file")) << "nothing unfinished is left";
  }
  EXPECT_TRUE(std::filesystem::is_symlink(path("link")));
  EXPECT_TRUE(same_file(path("link"), path("elsewhere/target")));
  EXPECT_FALSE(same_file(path("link"), path("file")));
  EXPECT_FALSE(same_file(path("none"), path("none")));
}

TEST_F(RegularFile, OfMoreThanTwoGibibytesIsRefusedBeforeItIsRead) {
  std::ofstream(path("sparse")).put('a');
  std::filesystem::resize_file(path("sparse"), std::uintmax_t{1} << 40);
  EXPECT_THAT(read_regular_file(path("sparse")).problem, HasSubstr("too large"));
}

}  // namespace
}  // namespace geometry_io
