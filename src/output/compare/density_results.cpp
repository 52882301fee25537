#include "output/compare/density_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/decimal.h"
#include "core/error.h"
#include "core/ordered_json.h"

namespace raytube {

namespace {

[[noreturn]] void refuse_file(const ResultFile& file, const std::string& problem) {
  throw InputError(file.file.string() + ": " + problem);
}

Json case_of(const ResultFile& file) {
  Json resolved = json_of(attribute_of(file.result, "case"));
  if (!find(resolved, "tubes"))
    refuse_file(file, "holds no case, so that its density is unknown; use a file that raytube run has written");
  return resolved;
}

double density_of(const ResultFile& file) {
  const Json resolved = case_of(file);
  const Json& tubes = resolved["tubes"];
  const Json* density = find(tubes, "per_wavelength");
  if (!density || !density->is_number())
    refuse_file(file, "its case has no tubes.per_wavelength; use a file that raytube run has written");
  if (text_at(tubes, "mode") != "uniform")
    refuse_file(file, "its tubes are adaptive, without a density to study; run the case with --set tubes.mode=uniform");
  return density->get<double>();
}

// The case without what may differ.
std::string comparable_case(const ResultFile& file) {
  Json resolved = case_of(file);
  resolved["tubes"].erase("per_wavelength");
  resolved["target"].erase("mesh");  // its hash decides
  for (const char* words : {"title", "output"}) resolved.erase(words);
  return text_of_json(resolved);
}

std::uint64_t count_of(const ResultFile& file, const char* name) {
  const Json counts = json_of(attribute_of(file.result, "counts"));
  const Json* count = find(counts, name);
  return count && count->is_number() ? count->get<std::uint64_t>() : 0;
}

void require_alike(const ResultFile& first, const ResultFile& other) {
  const auto differs = [&](const char* what) {
    refuse_file(other, fmt::format("differs from {} in {}; take results of one case that differ in tubes.per_wavelength alone",
                                   first.file.string(), what));
  };
  if (other.result.frequency_hz != first.result.frequency_hz) differs("its frequencies");
  if (other.result.looks != first.result.looks) differs("its looks");
  if (attribute_of(other.result, "mesh_sha256") != attribute_of(first.result, "mesh_sha256")) differs("its mesh");
  if (comparable_case(other) != comparable_case(first)) differs("its case");
}

}  // namespace

std::string attribute_of(const StoredResult& result, const std::string& name) {
  for (const auto& [key, text] : result.attributes)
    if (key == name) return text;
  return {};
}

std::vector<DensityResult> density_results(const std::vector<ResultFile>& files) {
  std::vector<DensityResult> results;
  for (const ResultFile& file : files) {
    const double density = density_of(file);
    require_alike(files.front(), file);
    if (std::ranges::find(results, density, &DensityResult::per_wavelength) != results.end())
      refuse_file(file, fmt::format("has {} tubes per wavelength, as another one has; leave one out", number_text(density)));
    results.push_back(
        {density, count_of(file, "tubes"), count_of(file, "rays"), std::numeric_limits<double>::quiet_NaN(), file.result.s});
  }
  if (results.size() < 3) refuse_file(files.back(), "an order needs results at three densities or more; give more files");
  std::ranges::sort(results, {}, &DensityResult::per_wavelength);
  return results;
}

}  // namespace raytube
