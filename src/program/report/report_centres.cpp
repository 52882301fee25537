#include "program/report/report_centres.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "core/error.h"
#include "output/report/centres_json.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

constexpr const char* how_to = "raytube centres CASE.toml --look I, with -o and the folder of the result, makes it";

struct LookAndFrequency {
  std::size_t look, frequency;
};

bool same(double a, double b) { return std::abs(a - b) <= 1e-9 * (1.0 + std::abs(b)); }

std::optional<LookAndFrequency> row_of(const StoredCentres& found, const StoredResult& result) {
  for (std::size_t look = 0; look < result.looks.size(); ++look)
    if (same(found.theta_deg, result.looks[look].theta_deg) && same(found.phi_deg, result.looks[look].phi_deg))
      for (std::size_t i = 0; i < result.frequency_hz.size(); ++i)
        if (same(found.frequency, result.frequency_hz[i])) return LookAndFrequency{look, i};
  return {};
}

// Pieces add up to S of the look but for what refined tubes change of it, 2 % on the haul truck. Empty if there is none.
std::string doubt_of(const StoredCentres& found, const ScatteringMatrix& s) {
  constexpr double doubtful = 0.25;
  if (frobenius_norm(found.s - s) <= doubtful * frobenius_norm(s)) return {};
  const int p = std::abs(s.hh()) > std::abs(s.vv()) ? 1 : 0;
  return fmt::format(
      "With the rest they add up to {:.2f} dBsm {}, but the result has {:.2f} dBsm: centres.csv may be of other settings, or of "
      "another target.",
      sigma_dbsm(found.s.at(p, p)), p == 0 ? "VV" : "HH", sigma_dbsm(s.at(p, p)));
}

}  // namespace

JsonValue report_centres(ReportSource& source) {
  const StoredResult& result = source.product.result;
  const std::filesystem::path file = std::filesystem::absolute(source.file).parent_path() / "centres.csv";
  if (result.bistatic) return {};
  if (!std::filesystem::exists(file)) {
    source.notes.push_back(fmt::format("Scattering centres: there is no centres.csv; {}.", how_to));
    return {};
  }
  StoredCentres found;
  try {
    found = read_centres_csv(file);
  } catch (const InputError& error) {
    source.notes.push_back(fmt::format("Scattering centres: {}.", error.what()));
    return {};
  }
  const std::optional<LookAndFrequency> row = row_of(found, result);
  if (row) {
    JsonValue json = centres_json(found, row->look);
    json["doubt"] = doubt_of(found, result.s[row->look * result.frequency_hz.size() + row->frequency]);
    return json;
  }
  source.notes.push_back(fmt::format(
      "Scattering centres: centres.csv is of \u03b8 = {:g}\u00b0, \u03c6 = {:g}\u00b0 at {:g} GHz, which the result does "
      "not have; {}.",
      found.theta_deg, found.phi_deg, found.frequency / 1e9, how_to));
  return {};
}

}  // namespace raytube
