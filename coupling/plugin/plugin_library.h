// SPDX-License-Identifier: GPL-2.0-or-later
// A shared library that exports what structure_plugin.h asks for, and a body that it has opened.
#pragma once

#include <memory>
#include <string>

#include "coupling/plugin/structure_plugin.h"
#include "coupling/structure_solver.h"

namespace coupling {

class PluginLibrary {
 public:
  /// `path` as dlopen takes it; a name without a slash is that of the current directory, if it is there.
  /// Throws std::invalid_argument: why it does not load, what it lacks, which version it has.
  explicit PluginLibrary(const std::string& path);

  const StructurePlugin& functions() const { return *functions_; }
  /// "libnet.so (spring net)", for messages.
  const std::string& name() const { return name_; }

 private:
  struct Close {
    void operator()(void* handle) const;
  };
  std::unique_ptr<void, Close> handle_;
  const StructurePlugin* functions_ = nullptr;
  std::string name_;
};

/// Every call throws if the library returns an error: FailedOnThisRank with library, function, code and what
/// the library says of it.
class PluginBody {
 public:
  /// Throws std::invalid_argument with the same words.
  PluginBody(PluginLibrary library, const StructurePluginSetup& setup);
  ~PluginBody();
  PluginBody(const PluginBody&) = delete;
  PluginBody& operator=(const PluginBody&) = delete;

  const StructurePlugin& functions() const { return library_.functions(); }
  const std::string& name() const { return library_.name(); }

  /// call("save", functions().save, bytes, &size)
  template <class... Parameters, class... Arguments>
  void call(const char* function, int (*pointer)(StructurePluginBody*, Parameters...),
            Arguments... arguments) const {
    if (const int code = pointer(body_, arguments...); code != 0)
      throw FailedOnThisRank(complaint(function, code));
  }
  /// Throws FailedOnThisRank: what a function has given is wrong.
  [[noreturn]] void fail(const char* function, const std::string& what) const;

 private:
  std::string complaint(const char* function, int code) const;

  PluginLibrary library_;
  StructurePluginBody* body_ = nullptr;
};

}  // namespace coupling
