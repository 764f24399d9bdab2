// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/plugin/plugin_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <utility>

namespace coupling {

namespace {

std::string what_dlopen_says() {
  const char* const words = dlerror();
  return words ? words : "unknown error";
}

std::string found(const std::string& path) {
  const bool is_here = path.find('/') == std::string::npos && std::filesystem::exists(path);
  return is_here ? "./" + path : path;
}

/// The first function of the table that is missing, or null; set_gravity may be.
const char* missing_function(const StructurePlugin& table) {
  const std::pair<bool, const char*> functions[] = {
      {table.open, "open"},
      {table.close, "close"},
      {table.last_error, "last_error"},
      {table.describe, "describe"},
      {table.stable_step, "stable_step"},
      {table.set_time_step, "set_time_step"},
      {table.initialise, "initialise"},
      {table.begin_step, "begin_step"},
      {table.end_step, "end_step"},
      {table.motion, "motion"},
      {table.totals, "totals"},
      {table.save, "save"},
      {table.load, "load"},
  };
  for (const auto& [is_there, name] : functions)
    if (!is_there) return name;
  return nullptr;
}

void check_table(const std::string& path, const StructurePlugin* table) {
  if (!table)
    throw std::invalid_argument(fmt::format(
        "{}: {}({}) gives nothing, expected a table of version {}: another version of the library", path,
        STRUCTURE_PLUGIN_ENTRY, STRUCTURE_PLUGIN_VERSION, STRUCTURE_PLUGIN_VERSION));
  if (table->version != STRUCTURE_PLUGIN_VERSION || table->size < sizeof(StructurePlugin))
    throw std::invalid_argument(
        fmt::format("{}: is of version {} of structure_plugin.h with a table of {} bytes, expected version "
                    "{} and {} bytes: compile it with the header of this program",
                    path, table->version, table->size, STRUCTURE_PLUGIN_VERSION, sizeof(StructurePlugin)));
  if (const char* const missing = missing_function(*table))
    throw std::invalid_argument(
        fmt::format("{}: its table has no function '{}', expected one", path, missing));
}

std::string complaint_of(const std::string& library, const char* function, int code, const char* words) {
  return fmt::format("{}: {} failed with code {}: {}", library, function, code,
                     words && *words ? words : "no message");
}

}  // namespace

void PluginLibrary::Close::operator()(void* handle) const { dlclose(handle); }

PluginLibrary::PluginLibrary(const std::string& path)
    : handle_(dlopen(found(path).c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (!handle_)
    throw std::invalid_argument(
        fmt::format("cannot load '{}': {}; expected a shared library by its path, or by a name that "
                    "LD_LIBRARY_PATH finds",
                    path, what_dlopen_says()));
  void* const symbol = dlsym(handle_.get(), STRUCTURE_PLUGIN_ENTRY);
  if (!symbol)
    throw std::invalid_argument(fmt::format(
        "{}: exports no function '{}', expected that of structure_plugin.h", path, STRUCTURE_PLUGIN_ENTRY));
  StructurePluginEntry entry;
  static_assert(sizeof(entry) == sizeof(symbol));
  std::memcpy(&entry, &symbol, sizeof(entry));
  functions_ = entry(STRUCTURE_PLUGIN_VERSION);
  check_table(path, functions_);
  name_ = fmt::format("{} ({})", path, functions_->name ? functions_->name : "without a name");
}

PluginBody::PluginBody(PluginLibrary library, const StructurePluginSetup& setup)
    : library_(std::move(library)) {
  const int code = functions().open(&setup, &body_);
  if (code != 0 || !body_)
    throw std::invalid_argument(complaint_of(name(), "open", code, functions().last_error(nullptr)));
}

PluginBody::~PluginBody() { functions().close(body_); }

void PluginBody::fail(const char* function, const std::string& what) const {
  throw FailedOnThisRank(fmt::format("{}: {} {}", name(), function, what));
}

std::string PluginBody::complaint(const char* function, int code) const {
  return complaint_of(name(), function, code, functions().last_error(body_));
}

}  // namespace coupling
