// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/regular_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <new>

#include "nurbs/memory.h"

namespace geometry_io {
namespace {

using std::filesystem::file_type;

// What stands at a path that is no regular file.
std::string described(file_type type) {
  switch (type) {
    case file_type::directory:
      return std::strerror(EISDIR);
    case file_type::fifo:
      return "Is a named pipe, expected a file";
    case file_type::character:
    case file_type::block:
      return "Is a device, expected a file";
    case file_type::socket:
      return "Is a socket, expected a file";
    case file_type::symlink:
      return "Is a link, expected a file";
    default:
      return "Is no regular file, expected one";
  }
}

// The file that a link names, be it there or not, else the path itself.
std::string target(const std::string& path) {
  constexpr int kMostLinks = 40;  // as the system's
  std::filesystem::path end = path;
  std::error_code error;
  for (int i = 0; i < kMostLinks && std::filesystem::is_symlink(end, error); ++i)
    end = end.parent_path() / std::filesystem::read_symlink(end, error);
  return end.string();
}

std::string last_problem() { return std::strerror(errno != 0 ? errno : EIO); }

}  // namespace

FileContent read_regular_file(const std::string& path) {
  std::error_code error;
  const file_type type = std::filesystem::status(path, error).type();
  if (type == file_type::not_found || type == file_type::none)
    return {{}, std::strerror(type == file_type::not_found ? ENOENT : error.value())};
  if (type != file_type::regular) return {{}, described(type)};

  errno = 0;
  std::ifstream file(path, std::ios::binary);
  const auto size = file ? std::filesystem::file_size(path, error) : 0;
  if (!file || error) return {{}, last_problem()};
  if (size > std::numeric_limits<int>::max()) return {{}, std::strerror(EFBIG)};
  FileContent content;
  try {
    content.bytes.resize(size);
  } catch (const std::bad_alloc&) {
    return {{}, fmt::format("{}: {}", std::strerror(ENOMEM), nurbs::size_text(static_cast<double>(size)))};
  }
  file.read(content.bytes.data(), static_cast<std::streamsize>(size));
  if (file.bad()) return {{}, last_problem()};
  content.bytes.resize(file.gcount());
  return content;
}

std::string problem_as_output(const std::string& path) {
  std::error_code error;
  const auto unusable = [](file_type type) {
    return type != file_type::regular && type != file_type::not_found && type != file_type::none;
  };
  const file_type type = std::filesystem::status(path, error).type();
  if (unusable(type)) return described(type);
  const std::string unfinished = unfinished_name(path);
  const file_type there = std::filesystem::symlink_status(unfinished, error).type();
  return unusable(there) ? fmt::format("{}: {}", unfinished, described(there)) : std::string();
}

std::string problem_as_later_output(const std::string& path) {
  const std::string problem = problem_as_output(path), unfinished = unfinished_name(path);
  if (!problem.empty()) return problem;
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::path(unfinished).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder, error))
    return fmt::format("there is no folder '{}'", folder.string());
  const bool was_there = std::filesystem::exists(unfinished, error);
  errno = 0;
  if (!std::ofstream(unfinished, std::ios::app)) return last_problem();
  if (!was_there) std::filesystem::remove(unfinished, error);
  return {};
}

std::string unfinished_name(const std::string& path) { return target(path) + ".part"; }

std::string finish_file(const std::string& path) {
  std::error_code problem;
  std::filesystem::rename(unfinished_name(path), target(path), problem);
  return problem ? problem.message() : std::string();
}

void discard_file(const std::string& path) {
  std::error_code gone;
  std::filesystem::remove(unfinished_name(path), gone);
}

std::string write_file(const std::string& path, const std::function<void(std::ostream&)>& write) {
  std::string problem = problem_as_output(path);
  if (!problem.empty()) return problem;
  const std::string unfinished = unfinished_name(path);
  errno = 0;
  std::ofstream file(unfinished, std::ios::binary);
  if (!file) return last_problem();
  write(file);
  file.close();
  problem = file ? finish_file(path) : last_problem();
  if (!problem.empty()) discard_file(path);
  return problem;
}

bool same_file(const std::string& a, const std::string& b) {
  std::error_code missing;  // a file that does not exist is no other
  return std::filesystem::equivalent(a, b, missing);
}

}  // namespace geometry_io
