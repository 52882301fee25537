#include "output/words/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/decimal.h"
#include "core/text.h"
#include "output/tables/csv.h"
#include "scene/tolerance.h"

namespace raytube {

namespace {

// Channels this far below the strongest of their row are reported separately: a small error is large against them.
constexpr int low_db = 20;
constexpr double near_peak = 0.01;  // of the largest amplitude: 40 dB below it

std::string line(const char* name, const std::string& text) { return fmt::format("{:<18} {}\n", name, text); }

double peak_sigma_dbsm(const SweepResult& result) {
  double peak = sigma_dbsm(0.0);
  for (const ScatteringMatrix& s : result.total)
    for (const int channel : {0, 1, 2, 3}) peak = std::max(peak, sigma_dbsm(s.at(channel / 2, channel % 2)));
  return peak;
}

// The largest levels [dB] for each kind of channel; below zero: there is none.
struct LargestErrors {
  double co = -1.0, cross = -1.0, low = -1.0;
};

LargestErrors largest_errors(const SweepResult& result, const std::vector<ChannelErrors>& errors) {
  LargestErrors found;
  for (std::size_t row = 0; row < result.total.size(); ++row) {
    const ScatteringMatrix& s = result.total[row];
    const double largest = largest_amplitude(s);
    if (largest == 0.0 || !std::isfinite(frobenius_norm(s))) continue;  // no level is relative to nothing
    const std::array<double, 4> levels = error_levels_db(s, errors[row]);
    for (const int channel : {0, 1, 2, 3}) {
      const bool low = std::abs(s.at(channel / 2, channel % 2)) < low_channel * largest;
      double& kind = low ? found.low : channel == 0 || channel == 3 ? found.co : found.cross;
      kind = std::max(kind, levels[static_cast<std::size_t>(channel)]);
    }
  }
  return found;
}

// Rows whose numerical error is above the tolerance; the model uncertainty permits some of them.
struct RowsAbove {
  std::size_t permitted = 0, others = 0;
};

RowsAbove rows_above(const SweepResult& result, const TubeOptions& tubes) {
  RowsAbove rows;
  const double tolerance = relative_tolerance(tubes.tolerance_db);
  for (std::size_t row = 0; row < result.total.size(); ++row) {
    const ScatteringMatrix& s = result.total[row];
    if (!std::isfinite(frobenius_norm(s)) || !(excess(s, result.error[row], tolerance) > 1.0)) continue;
    const ChannelErrors model = result.model.empty() ? ChannelErrors{} : result.model[row];
    const bool permitted = !(excess(s, result.error[row], tolerance, scaled(model, tubes.model_share)) > 1.0);
    ++(permitted ? rows.permitted : rows.others);
  }
  return rows;
}

std::string levels_text(const LargestErrors& errors) {
  std::vector<std::string> kinds;
  if (errors.co >= 0.0) kinds.push_back(fmt::format("VV, HH {:.2g} dB", errors.co));
  if (errors.cross >= 0.0) kinds.push_back(fmt::format("VH, HV {:.2g} dB", errors.cross));
  if (errors.low >= 0.0)
    kinds.push_back(fmt::format("{:.2g} dB where {} dB and more below the strongest channel", errors.low, low_db));
  return kinds.empty() ? "0 dB: no return" : "at most " + joined(kinds, "; ");
}

std::string remedy(const SweepResult& result, const RunFacts& facts) {
  const auto times = std::ranges::find(result.statistics.skipped, std::string_view(times_between), &Skipped::what);
  if (times != result.statistics.skipped.end() && times->figure > relative_tolerance(facts.tubes.tolerance_db))
    return "write motion.retrace = \"every\"";
  const std::string text = fmt::format("raise tubes.per_wavelength ({})", number_text(facts.tubes.max_per_wavelength));
  if (!facts.materials || result.statistics.truncated[Truncation::bounces].tubes == 0) return text;
  return text + fmt::format(" or tubes.max_bounces ({})", facts.tubes.max_bounces);
}

std::string error_lines(const SweepResult& result, const RunFacts& facts) {
  std::string text = line("numerical error", numerical_error_text(result));
  if (!facts.tubes.refines()) return text;
  const RowsAbove above = rows_above(result, facts.tubes);
  const std::string tolerance = number_text(facts.tubes.tolerance_db);
  if (above.permitted > 0)
    text += line("within model share",
                 fmt::format("{} of {} rows are above accuracy.tolerance_db = {}, but below {} of the model uncertainty "
                             "(accuracy.model_share)",
                             above.permitted, result.total.size(), tolerance, number_text(facts.tubes.model_share)));
  if (above.others > 0)
    text += line("above tolerance", fmt::format("{} of {} rows (accuracy.tolerance_db = {}): {}", above.others,
                                                result.total.size(), tolerance, remedy(result, facts)));
  return text;
}

double largest_co_polar(const SweepResult& result) {
  double peak = 0.0;
  for (const ScatteringMatrix& s : result.total) peak = std::max({peak, std::abs(s.vv()), std::abs(s.hh())});
  return peak;
}

// The levels [dB] of two channels where they are within 40 dB of the sweep's largest co-polar amplitude.
std::vector<double> levels_near_peak(const SweepResult& result, const std::vector<ChannelErrors>& errors,
                                     const std::array<int, 2>& channels) {
  const double least = near_peak * largest_co_polar(result);
  std::vector<double> levels;
  for (std::size_t row = 0; least > 0.0 && row < result.total.size(); ++row)
    for (const int channel : channels)
      if (std::abs(result.total[row].at(channel / 2, channel % 2)) >= least)
        levels.push_back(error_levels_db(result.total[row], errors[row])[static_cast<std::size_t>(channel)]);
  return levels;
}

std::string median_text(const char* channels, std::vector<double> levels) {
  const auto middle = levels.begin() + static_cast<std::ptrdiff_t>(levels.size() / 2);
  std::ranges::nth_element(levels, middle);
  const double median = *middle;
  return fmt::format("{} median {:.2g} dB, at most {:.2g} dB", channels, median, std::ranges::max(levels));
}

// The beginning of a remedy where no key helps.
constexpr std::string_view no_remedy = "none";

// The model uncertainty, its largest part, and the remedy against that part.
std::string model_lines(const SweepResult& result) {
  if (result.model.empty()) return "";
  const std::string text = line("model uncertainty", model_uncertainty_text(result));
  if (result.model_parts.empty()) return text;
  return text + line("", largest_part_text(result.model_parts.front()));
}

// Whether the power changes any row within 40 dB of the peak by a tenth of the tolerance.
bool matters(double sigma, const SweepResult& result, double tolerance_db) {
  const double weakest = near_peak * largest_co_polar(result), least_share = std::pow(10.0, 0.1 * tolerance_db / 20.0) - 1.0;
  return std::sqrt(sigma / (4.0 * pi)) > least_share * weakest;
}

// For each reason: the number of tubes, the power left in those of a look, the error that includes it, and the remedy.
std::string truncated_lines(const SweepResult& result, const RunFacts& facts) {
  const std::array reasons{fmt::format("after tubes.max_bounces = {}", facts.tubes.max_bounces),
                           std::string("too wide off curved surfaces"), std::string("too many between sheets")};
  constexpr std::array handles{"; raise tubes.max_bounces", "; raise tubes.per_wavelength (no help inside solids)", ""};
  std::string text;
  for (const Truncation reason : truncations) {
    const auto& [tubes, sigma] = result.statistics.truncated[reason];
    const auto i = static_cast<std::size_t>(reason);
    if (tubes == 0) continue;
    const std::string left = sigma > 0.0 ? fmt::format("{:.1f} dBsm", 10.0 * std::log10(sigma)) : "nothing";
    const char* const handle = matters(sigma, result, facts.tubes.tolerance_db) ? handles[i] : "; too little to matter";
    text += line("truncated tubes", fmt::format("{} {}: at most {} left in a look, counted in the {}{}", tubes, reasons[i], left,
                                                facts.materials ? "numerical error" : "model uncertainty", handle));
  }
  return text;
}

std::string work_lines(const SweepResult& result, const RunFacts& facts) {
  const Statistics& s = result.statistics;
  const bool paths = s.paths;
  std::string text = line("rays", fmt::format("{} in {} {}, {:.2f} s on {} thread{}", s.rays, s.tubes, paths ? "paths" : "tubes",
                                              s.solve_s, facts.threads, facts.threads == 1 ? "" : "s"));
  if (s.ray_range > 0.0)
    text += line("range", fmt::format("{:.6g} m: amplitudes are apparent ones (edges.method \"utd\")", s.ray_range));
  if (facts.looks_resumed)
    text += line("resumed", fmt::format("{} looks were computed before, and are not included in that time", facts.looks_resumed));
  text += line("lost rays", fmt::format("{}", s.lost_rays));
  if (paths && s.truncated.tubes())
    text += line("truncated search", fmt::format("in {} looks: too many sequences of mirrors", s.truncated.tubes()));
  return paths ? text : text + truncated_lines(result, facts);
}

std::string beyond_bound_lines(const Statistics& statistics) {
  std::string text;
  for (const BeyondBound& part : statistics.beyond_bound)
    text +=
        line("beyond bound", fmt::format("{} in {} row{}: do not use these", part.part, part.rows, part.rows == 1 ? "" : "s"));
  return text;
}

}  // namespace

std::string numerical_error_text(const SweepResult& result) { return levels_text(largest_errors(result, result.error)); }

std::string model_uncertainty_text(const SweepResult& result) {
  std::vector<std::string> kinds;
  for (const auto& [channels, both] : {std::pair{"VV, HH", std::array{0, 3}}, std::pair{"VH, HV", std::array{1, 2}}})
    if (const std::vector<double> levels = levels_near_peak(result, result.model, both); !levels.empty())
      kinds.push_back(median_text(channels, levels));
  return kinds.empty() ? "0 dB: no return" : "within 40 dB of the peak: " + joined(kinds, "; ");
}

std::string largest_part_text(const ModelPart& largest) {
  // That no setting helps stands in run.json; as the last words of a run it would sound like a failure.
  const std::string handle = largest.remedy.starts_with(no_remedy) ? "" : "; remedy: " + largest.remedy;
  return fmt::format("mostly {} ({:.0f} %){}", largest.what, 100.0 * largest.share, handle);
}

std::string beyond_bound_sentence(const BeyondBound& part) {
  if (std::isinf(part.ratio))
    return fmt::format(
        "{}: {} row{} without a number or beyond its bound, row {} first (rows count from 0); this is a fault of the program "
        "or of the mesh, do not use these rows (docs/theory/bounds.md)",
        part.part, part.rows, part.rows == 1 ? "" : "s", part.worst);
  return fmt::format(
      "{}: {} row{} with more than the size of the target allows, row {} by {:.1f} dB (rows count from 0); this is a fault of "
      "the "
      "program or of the mesh, do not use these rows (docs/theory/bounds.md)",
      part.part, part.rows, part.rows == 1 ? "" : "s", part.worst, 20.0 * std::log10(part.ratio));
}

std::string lost_rays_sentence(const Statistics& statistics, double metres_per_unit, const std::string& unit) {
  std::vector<std::string> places;
  for (const LostRay& ray : statistics.first_lost_rays) {
    const dvec3 at = ray.at / metres_per_unit;
    places.push_back(fmt::format("({:.6g}, {:.6g}, {:.6g}) {} on triangle {} in look {} (theta {}, phi {})", at.x, at.y, at.z,
                                 unit, ray.triangle, ray.look, number_text(decimal_degrees(ray.transmit.theta)),
                                 number_text(decimal_degrees(ray.transmit.phi))));
  }
  const std::uint64_t looks = statistics.looks_with_lost_rays;
  const std::string where =
      places.empty() ? "" : fmt::format(", in {} look{}, first at {}", looks, looks == 1 ? "" : "s", joined(places, "; "));
  return fmt::format(
      "{} of {} rays met a closed body from inside or left a surface without a direction and ended there{}: a part of the body "
      "is "
      "inside out there, or crosses itself; repair it in the CAD program (docs/guide/own_mesh.md)",
      statistics.lost_rays, statistics.rays, where);
}

dvec3 size_of(std::span<const dvec3> points) {
  dvec3 low = points[0], high = points[0];
  for (const dvec3& point : points) low = glm::min(low, point), high = glm::max(high, point);
  return high - low;
}

std::string size_text(const dvec3& size, double frequency) {
  const dvec3 waves = size / wavelength(frequency);
  return fmt::format("{:.4g} x {:.4g} x {:.4g} m; {:.3g} x {:.3g} x {:.3g} wavelengths at {} GHz", size.x, size.y, size.z,
                     waves.x, waves.y, waves.z, number_text(frequency / 1e9));
}

std::string summary_text(const SweepResult& result, const RunFacts& facts) {
  std::string text = facts.size.empty() ? "" : line("size", facts.size);
  text += work_lines(result, facts);
  for (const Skipped& skipped : result.statistics.skipped)
    text += line("skipped", fmt::format("{} ({}): {}", skipped.what, skipped.count, reason_of(skipped)));
  text += line("peak sigma", fmt::format("{:.2f} dBsm", peak_sigma_dbsm(result)));
  if (!result.statistics.paths) text += error_lines(result, facts);
  text += model_lines(result);
  text += beyond_bound_lines(result.statistics);
  if (facts.warnings) text += line("warnings", fmt::format("{}, above and in run.json", facts.warnings));
  return text + line("results", facts.folder);
}

}  // namespace raytube
