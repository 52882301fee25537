#include "jobs/shared_work.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "case/resolved_case.h"
#include "core/bytes.h"
#include "core/error.h"
#include "jobs/inputs.h"
#include "output/files/sha256.h"

namespace raytube {

namespace {

constexpr std::size_t longest_value = 60;

std::string looks_text(const Sweep& sweep) {
  ByteWriter writer;
  for (const Look& look : sweep.looks) {  // its own bytes have gaps
    const double none = std::numeric_limits<double>::infinity();
    for (const double value : {look.transmit.theta, look.transmit.phi, look.receive.theta, look.receive.phi, look.transmit_range,
                               look.receive_range, look.turn, look.aim_way.x, look.aim_way.y, look.aim_way.z,
                               look.transmit_mirror.value_or(none), look.receive_mirror.value_or(none)})
      writer(value);
  }
  writer(sweep.frequencies);
  writer(sweep.times);
  return fmt::format("{} {}", sweep.looks.size(), sha256_of(writer.take()));
}

std::string shown(const std::string& value) {
  return value.size() > longest_value ? value.substr(0, longest_value) + "..." : value.empty() ? "nothing" : value;
}

}  // namespace

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

JournalIdentity identity_of_case(const Case& c, const Manifest& manifest) {
  JournalIdentity identity{{"list in look.looks_csv", manifest.looks_csv_sha256},
                           {"pattern in radar.pattern_csv", manifest.pattern_csv_sha256}};
  for (const auto& [name, sha256] : manifest.table_csv_sha256) identity.emplace_back("table " + name, sha256);
  std::ranges::copy(numerical_keys(c), std::back_inserter(identity));
  return identity;
}

JournalIdentity identity_of_run(const Json& run) {
  JournalIdentity identity{{mesh_item, fmt::format("{}", fmt::join(mesh_sha256_of_run(run), " "))},
                           {"list in look.looks_csv", text_at(run, "looks_csv_sha256")},
                           {"pattern in radar.pattern_csv", text_at(run, "pattern_csv_sha256")}};
  if (const Json* tables = find(run, "table_csv_sha256"))
    for (const auto& [name, sha256] : tables->items()) identity.emplace_back("table " + name, sha256.get<std::string>());
  std::ranges::copy(numerical_keys(run["case"]), std::back_inserter(identity));
  return identity;
}

JournalIdentity shared_work(const Case& c, const JournalIdentity& asked) {
  JournalIdentity work = asked;
  work.emplace_back("looks and frequencies", looks_text(c.sweep));
  std::ranges::copy(identity_of_case(c, described_inputs(c, {}, {})), std::back_inserter(work));
  return work;
}

void require_same_work(const JournalIdentity& of_leader, const JournalIdentity& own) {
  const std::vector<JournalDifference> found = differences(of_leader, own);
  if (found.empty()) return;
  const auto& [name, leader, here] = found.back();  // keys of the case stand last, and say most
  throw InputError(fmt::format(
      "was given {} = {} where rank 0 has {}: all ranks of a job solve one case; to solve one case on each set RAYTUBE_MPI=off",
      name, shown(here), shown(leader)));
}

std::string text_of_work(const JournalIdentity& work) {
  std::vector<std::string> words;
  for (const auto& [name, value] : work) words.push_back(name), words.push_back(value);
  ByteWriter writer;
  writer(words);
  return writer.take();
}

JournalIdentity work_of_text(std::string_view text) {
  std::vector<std::string> words;
  ByteReader reader(text);
  reader(words);
  JournalIdentity work;
  for (std::size_t i = 0; i + 1 < words.size(); i += 2) work.emplace_back(words[i], words[i + 1]);
  return work;
}

}  // namespace raytube
