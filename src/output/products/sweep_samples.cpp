#include "output/products/sweep_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "output/tables/csv.h"
#include "output/tables/stored.h"

namespace raytube {

namespace {

// rcs.csv: level = 20 log10(1 + error / max(|S|, S_max / 100)).
ChannelErrors errors_of_levels(const ScatteringMatrix& s, const ChannelErrors& levels_db) {
  ChannelErrors errors{};
  for (std::size_t p = 0; p < 2; ++p)
    for (std::size_t q = 0; q < 2; ++q)
      if (!std::isinf(levels_db[p][q]))  // of nothing at all no error is told
        errors[p][q] =
            (std::pow(10.0, levels_db[p][q] / 20.0) - 1.0) * std::max(std::abs(s.s[p][q]), 0.01 * largest_amplitude(s));
  return errors;
}

std::vector<ChannelErrors> errors_of(const StoredResult& result, const std::vector<ChannelErrors>& metres,
                                     const std::vector<ChannelErrors>& levels_db) {
  if (!metres.empty()) return metres;
  std::vector<ChannelErrors> errors(result.rows());
  for (std::size_t row = 0; row < levels_db.size(); ++row) errors[row] = errors_of_levels(result.s[row], levels_db[row]);
  return errors;
}

bool is_finite(Complex value) { return std::isfinite(value.real()) && std::isfinite(value.imag()); }

// A channel may be missing as a whole, as in results of other programs.
void require_finite(const std::vector<ScatteringMatrix>& s, const std::string& name) {
  for (const int channel : {0, 1, 2, 3}) {
    const auto lacks = [channel](const ScatteringMatrix& row) { return !is_finite(row.at(channel / 2, channel % 2)); };
    const auto first = std::ranges::find_if(s, lacks);
    if (first == s.end() || std::ranges::all_of(s, lacks)) continue;
    throw InputError(fmt::format("{}: row {} has no finite S_{}; compute it again", name, first - s.begin() + 1,
                                 channel_names[static_cast<std::size_t>(channel)]));
  }
}

// An antenna on a circle about the origin is swept over angles.
std::optional<AngleGrid> scan_of_looks(const StoredResult& result) {
  const auto range = &StoredLook::range_m;
  if (result.looks.front().far() ||
      std::ranges::adjacent_find(result.looks, std::ranges::not_equal_to{}, range) == result.looks.end())
    return {};
  std::vector<dvec3> places;
  for (const StoredLook& look : result.looks) places.push_back(look.range_m * direction_of(look.theta_deg, look.phi_deg));
  return scan_grid(places);
}

const std::vector<ScatteringMatrix>& part_of(const StoredResult& result, const std::string& name, const std::string& mechanism) {
  const auto part = std::ranges::find(result.parts, mechanism, &StoredPart::name);
  if (part != result.parts.end()) return part->s;
  std::string names;
  for (const StoredPart& each : result.parts) names += (names.empty() ? "" : ", ") + each.name;
  throw InputError(fmt::format("{}: holds no mechanism {}; {}", name, mechanism,
                               names.empty() ? "give a result (.nc) of raytube run --parts" : "choose among " + names));
}

}  // namespace

std::vector<ChannelErrors> errors_in_metres(const StoredResult& result) {
  return errors_of(result, result.error_m, result.err_db);
}

std::vector<ChannelErrors> model_in_metres(const StoredResult& result) {
  return errors_of(result, result.model_m, result.model_db);
}

SweepSamples samples_of(const StoredResult& result, const std::string& name, const std::string& mechanism) {
  SweepSamples samples{.frequency = even_axis(result.frequency_hz, name + ": frequencies", "Hz")};
  for (const StoredLook& look : result.looks)
    samples.looks.push_back({direction_of(look.theta_deg, look.phi_deg), direction_of(look.rx_theta_deg, look.rx_phi_deg),
                             look.range_m, look.rx_range_m});
  samples.times = sweep_of(result).times;
  samples.s = mechanism.empty() ? result.s : part_of(result, name, mechanism);
  require_finite(samples.s, name);
  samples.error = errors_in_metres(result);
  samples.model = model_in_metres(result);
  return samples;
}

AngleGrid grid_of_looks(const StoredResult& result, const std::string& name) {
  std::vector<std::array<double, 2>> angles;
  for (const StoredLook& look : result.looks) {
    if (look.theta_deg != look.rx_theta_deg || look.phi_deg != look.rx_phi_deg || look.range_m != look.rx_range_m)
      throw InputError(fmt::format("{}: its looks are bistatic; images need monostatic ones, without [receive]", name));
    angles.push_back({look.theta_deg, look.phi_deg});
  }
  if (std::optional<AngleGrid> scan = scan_of_looks(result)) return *std::move(scan);
  if (std::ranges::adjacent_find(result.looks, std::ranges::not_equal_to{}, &StoredLook::time_s) != result.looks.end())
    throw InputError(name +
                     ": its looks are of several times; images need a scene that stands, or antennas that move along a line; "
                     "raytube doppler makes maps over range and velocity");
  return angle_grid(angles, name + ": look");
}

}  // namespace raytube
