#include "jobs/recorded_run.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace raytube {

// A value of JSON is one of TOML, too, but for tables: none of these sections holds one.
std::vector<std::string> settings_of_run(const Json& run) {
  std::vector<std::string> settings;
  const Json* const resolved = find(run, "case");
  if (!resolved) return settings;
  const auto add = [&](const char* section, const std::string& key, const Json& value) {
    settings.push_back(fmt::format("{}.{}={}", section, key, text_of_json(value)));
  };
  if (const Json* const target = find(*resolved, "target"))
    for (const char* key : {"mesh", "unit"})
      if (const Json* const value = find(*target, key)) add("target", key, *value);
  for (const char* section : {"frequency", "look", "tubes", "accuracy", "edges", "surfaces"})
    if (const Json* const keys = find(*resolved, section))
      for (const auto& [key, value] : keys->items()) add(section, key, value);
  return settings;
}

std::vector<std::string> mesh_sha256_of_run(const Json& run) {
  const Json* const mesh = find(run, "mesh");
  const Json* const sha256 = mesh ? find(*mesh, "sha256") : nullptr;
  if (!sha256) return {};
  return sha256->is_string() ? std::vector{sha256->get<std::string>()} : sha256->get<std::vector<std::string>>();
}

}  // namespace raytube
