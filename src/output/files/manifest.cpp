#include "output/files/manifest.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "core/decimal.h"
#include "core/ordered_json.h"
#include "output/files/files.h"

namespace raytube {

namespace {

// As truncations stand.
constexpr std::array truncated_names{"at_max_bounces", "by_width", "by_number"};

Json lost_ray_json(const LostRay& ray) {
  return {{"look", ray.look},
          {"theta_deg", decimal_degrees(ray.transmit.theta)},
          {"phi_deg", decimal_degrees(ray.transmit.phi)},
          {"triangle", static_cast<std::uint64_t>(ray.triangle)},
          {"at_m", Json::array({ray.at.x, ray.at.y, ray.at.z})}};
}

Json mechanisms_json(const std::vector<MechanismUse>& mechanisms) {
  Json json = Json::array();
  for (const MechanismUse& use : mechanisms)
    json.push_back({{"name", use.name},
                    {"label", use.label},
                    {"key", use.key},
                    {"on", use.on},
                    {"why_not", use.why_not},
                    {"looks", use.looks},
                    {"looks_without", use.looks_without},
                    {"most_db_without", use.most_db}});
  return json;
}

Json counts_json(const Statistics& statistics) {
  Json json;
  json["rays"] = statistics.rays;
  json["tubes"] = statistics.tubes;
  json["hits_per_bounce"] = statistics.hits;
  json["lost_rays"] = statistics.lost_rays;
  json["looks_with_lost_rays"] = statistics.looks_with_lost_rays;
  json["first_lost_rays"] = Json::array();
  for (const LostRay& ray : statistics.first_lost_rays) json["first_lost_rays"].push_back(lost_ray_json(ray));
  for (const Truncation reason : truncations) {
    const char* const name = truncated_names[static_cast<std::size_t>(reason)];
    json[fmt::format("tubes_cut_{}", name)] = statistics.truncated[reason].tubes;
    json["tubes_cut_sigma_m2"][name] = statistics.truncated[reason].sigma;
  }
  json["sliver_area_m2"] = statistics.sliver_area;
  json["wedges"] = statistics.wedges;
  for (const Count& count : statistics.counts) json[count.what] = count.count;
  json["thin_plate_edges"] = {{"lowest_frequency", statistics.thin_plate_edges_lowest},
                              {"highest_frequency", statistics.thin_plate_edges_highest}};
  if (statistics.ray_range > 0.0) json["utd_range_m"] = statistics.ray_range;
  json["beyond_bound"] = Json::array();
  for (const BeyondBound& part : statistics.beyond_bound)
    json["beyond_bound"].push_back(
        {{"mechanism", part.part}, {"rows", part.rows}, {"worst_row", part.worst}, {"ratio", part.ratio}});
  json["mechanisms"] = mechanisms_json(statistics.mechanisms);
  json["skipped"] = Json::array();
  for (const Skipped& skipped : statistics.skipped)
    json["skipped"].push_back({{"what", skipped.what}, {"why", reason_of(skipped)}, {"count", skipped.count}});
  return json;
}

Json model_json(const std::vector<ModelPart>& parts) {
  Json json = Json::array();
  for (const ModelPart& part : parts)
    json.push_back({{"part", part.name},
                    {"what", part.what},
                    {"remedy", part.remedy},
                    {"rms_m", part.rms},
                    {"share", part.share},
                    {"rows_largest", part.rows_largest}});
  return json;
}

Json mesh_json(const Manifest& manifest) {
  const std::vector<std::string>& hashes = manifest.mesh_sha256;
  Json json = {{"sha256", hashes.size() == 1 ? Json(hashes.front()) : Json(hashes)}};
  for (const auto& [name, value] : manifest.mesh_report) json[name] = count_or_length(value);
  json["notes"] = Json::array();
  for (const auto& [what, count] : manifest.mesh_notes)
    json["notes"].push_back({{"what", what}, {"count", count_or_length(count)}});
  return json;
}

Json time_json(const Timing& time, double solve_s, std::uint64_t looks_resumed) {
  Json json = {{"read_s", time.read_s}, {"build_s", time.build_s}, {"solve_s", solve_s}, {"total_s", time.total_s}};
  if (looks_resumed > 0) json["looks_resumed"] = looks_resumed;
  return json;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> attributes_of(const Manifest& manifest) {
  const std::vector<std::string>& hashes = manifest.mesh_sha256;
  return {{"title", text_at(json_of(manifest.case_json), "title")},
          {"source", "raytube " + manifest.program_version},
          {"raytube_version", manifest.program_version},
          {"case", manifest.case_json},
          {"mesh_sha256", hashes.size() == 1 ? hashes.front() : text_of_json(hashes)},
          {"rcs_csv_sha256", manifest.rcs_csv_sha256},
          {"warnings", text_of_json(manifest.warnings)},
          {"counts", text_of_json(counts_json(manifest.statistics))},
          {"model_uncertainty", text_of_json(model_json(manifest.model_parts))}};
}

void write_manifest(const std::filesystem::path& file, const Manifest& manifest) {
  Json json;
  json["program"] = "raytube";
  json["version"] = manifest.program_version;
  json["case_file"] = manifest.case_file;
  json["case"] = json_of(manifest.case_json);
  if (!manifest.looks_csv_sha256.empty()) json["looks_csv_sha256"] = manifest.looks_csv_sha256;
  if (!manifest.pattern_csv_sha256.empty()) json["pattern_csv_sha256"] = manifest.pattern_csv_sha256;
  for (const auto& [name, sha256] : manifest.table_csv_sha256) json["table_csv_sha256"][name] = sha256;
  json["mesh"] = mesh_json(manifest);
  json["instruction_sets"] = {{"embree", manifest.embree_instruction_set}, {"raytube", manifest.own_instruction_set}};
  json["threads"] = manifest.threads;
  json["warnings"] = manifest.warnings;
  json["counts"] = counts_json(manifest.statistics);
  json["model_uncertainty"] = model_json(manifest.model_parts);
  json["time"] = time_json(manifest.time, manifest.statistics.solve_s, manifest.looks_resumed);
  json["peak_rss_bytes"] = manifest.peak_rss_bytes;
  json["rcs_csv_sha256"] = manifest.rcs_csv_sha256;
  OutputFile out(file);
  out.write(text_of_json(json, 2) + '\n');
  out.commit();
}

}  // namespace raytube
