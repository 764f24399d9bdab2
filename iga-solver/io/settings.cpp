// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace io {

namespace {

std::string text_of(const structure::Material& material) {
  std::string text = fmt::format("{}, E = {:.10g}, nu = {:.10g}", material.law(), material.youngs_modulus(),
                                 material.poissons_ratio());
  for (const double constant : material.further_constants()) text += fmt::format(", {:.10g}", constant);
  return text;
}

const std::string* find(const Settings& settings, const std::string& name) {
  const auto found = std::find_if(settings.begin(), settings.end(),
                                  [&](const Setting& setting) { return setting.name == name; });
  return found == settings.end() ? nullptr : &found->text;
}

/// From a little before `at` on.
std::string excerpt(const std::string& text, std::size_t at) {
  constexpr std::size_t kBefore = 20, kLongest = 60;
  if (text.size() <= kLongest) return text;
  const std::size_t begin = at > kBefore ? at - kBefore : 0;
  return (begin > 0 ? "..." : "") + geometry_io::shown(text.substr(begin));
}

std::string change(const std::string* then, const std::string* now) {
  if (!then) return fmt::format("none then, {} now", excerpt(*now, 0));
  if (!now) return fmt::format("{} then, none now", excerpt(*then, 0));
  const auto at = std::mismatch(then->begin(), then->end(), now->begin(), now->end()).first - then->begin();
  return fmt::format("{} then, {} now", excerpt(*then, at), excerpt(*now, at));
}

}  // namespace

Settings settings_of(const geometry_io::YamlMap& document,
                     const std::vector<std::shared_ptr<const structure::Material>>& materials) {
  Settings settings;
  for (std::size_t p = 0; p < materials.size(); ++p) {
    const std::string of_patch = materials.size() == 1 ? "" : fmt::format(" of patch {}", p);
    settings.push_back({"density" + of_patch, fmt::format("{:.10g}", materials[p]->density())});
    settings.push_back({"material" + of_patch, text_of(*materials[p])});
  }
  for (const char* const key : {"integration", "damping", "boundary"})
    if (document.has(key)) settings.push_back({key, document.text_of(key)});
  if (document.has("loads") && document.is_map("loads")) {
    const geometry_io::YamlMap loads = document.map("loads");
    for (const std::string& key : loads.keys()) settings.push_back({"loads." + key, loads.text_of(key)});
  }
  return settings;
}

std::vector<std::string> to_texts(const Settings& settings) {
  std::vector<std::string> texts;
  for (const Setting& setting : settings) texts.insert(texts.end(), {setting.name, setting.text});
  return texts;
}

Settings settings_from(const std::vector<std::string>& texts) {
  Settings settings;
  for (std::size_t i = 0; i + 1 < texts.size(); i += 2) settings.push_back({texts[i], texts[i + 1]});
  return settings;
}

std::string difference(const Settings& then, const Settings& now, const std::string& kind) {
  std::vector<std::string> names;  // in the order of the model, then what it no longer has
  for (const Settings* all : {&now, &then})
    for (const Setting& setting : *all)
      if (setting.name.compare(0, kind.size(), kind) == 0 && (all == &now || !find(now, setting.name)))
        names.push_back(setting.name);
  std::vector<std::pair<std::string, std::vector<std::string>>> changes;  // many patches may have one
  std::map<std::string, std::size_t> known;
  for (const std::string& name : names) {
    const std::string *before = find(then, name), *after = find(now, name);
    if (before && after && *before == *after) continue;
    const std::string text = change(before, after);
    const auto [place, is_new] = known.emplace(text, changes.size());
    if (is_new) changes.push_back({text, {}});
    changes[place->second].second.push_back(name);
  }
  std::string differs;
  for (const auto& [text, of] : changes)
    differs += fmt::format("{}{}{}: {}", differs.empty() ? "" : "; ", of.front(),
                           of.size() > 1 ? fmt::format(" and {} more", of.size() - 1) : "", text);
  return differs;
}

}  // namespace io
