#include "jobs/recorded_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

namespace raytube {

// Values of JSON are those of TOML, but for tables: a section takes the place of the whole section of the file, so that what
// stood there before, looks_csv beside angles say, does not stand in its way. None of these holds a table.
std::vector<std::string> settings_of_run(const Json& run) {
  std::vector<std::string> settings;
  const Json* const resolved = find(run, "case");
  if (!resolved) return settings;
  if (const Json* const target = find(*resolved, "target"))
    for (const char* key : {"mesh", "unit"})
      if (const Json* const value = find(*target, key))
        settings.push_back(fmt::format("target.{}={}", key, text_of_json(*value)));
  for (const char* section : {"frequency", "look", "receive", "tubes", "accuracy", "edges", "surfaces"}) {
    const Json* const keys = find(*resolved, section);
    if (!keys) continue;
    std::vector<std::string> values;
    for (const auto& [key, value] : keys->items()) values.push_back(fmt::format("{} = {}", key, text_of_json(value)));
    settings.push_back(fmt::format("{}={{{}}}", section, fmt::join(values, ", ")));
  }
  return settings;
}

std::vector<std::string> mesh_sha256_of_run(const Json& run) {
  const Json* const mesh = find(run, "mesh");
  const Json* const sha256 = mesh ? find(*mesh, "sha256") : nullptr;
  if (!sha256) return {};
  return sha256->is_string() ? std::vector{sha256->get<std::string>()} : sha256->get<std::vector<std::string>>();
}

}  // namespace raytube
