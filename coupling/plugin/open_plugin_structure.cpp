// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "coupling/open_structure.h"
#include "coupling/plugin/plugin_structure.h"
#include "parallel/all_or_none.h"

namespace coupling {

namespace {

geometry_io::Units units_of(const StructurePluginDescription& description) {
  if (!description.units)
    throw std::invalid_argument("units is missing, expected si, cgs, mm-g-ms or mm-t-s");
  return geometry_io::units_from_name(description.units);
}

/// What the description says, checked.
struct Described {
  StructurePluginDescription description;
  geometry_io::Units units;
  PluginSkin skin;
};

Described describe(const PluginBody& body) {
  StructurePluginDescription description{};
  description.size = sizeof(description);
  body.call("describe", body.functions().describe, &description);
  try {
    return {description, units_of(description), read_skin(description)};
  } catch (const std::invalid_argument& problem) {
    throw std::invalid_argument(fmt::format("{}: describe: {}", body.name(), problem.what()));
  }
}

}  // namespace

// Each stage on all ranks or none: in the next one those of the plug-in may talk to each other.
OpenedStructure open_plugin_structure(MPI_Comm comm, const std::string& library, const std::string& model,
                                      const std::string& surface) {
  const auto on_all = [&](auto action) { return parallel::on_every_rank(comm, model, action); };
  PluginLibrary loaded = on_all([&] { return PluginLibrary(library); });
  const StructurePluginSetup setup{sizeof(setup), MPI_Comm_c2f(comm), model.c_str(), surface.c_str()};
  auto body = on_all([&] { return std::make_unique<PluginBody>(std::move(loaded), setup); });
  Described is = on_all([&] { return describe(*body); });
  auto solver = on_all([&] {
    return std::make_unique<PluginStructure>(comm, std::move(body), is.description, std::move(is.skin),
                                             surface);
  });
  return {std::move(solver), is.units};
}

}  // namespace coupling
