#include "output/tables/sampled_rows.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "scene/sampling.h"

namespace raytube {

namespace {

using Quantity = RowCoordinates::Quantity;

constexpr std::size_t least_values = 4, most_groups = 100, most_steps = 1000;

double turn_between(const Sweep& sweep, std::span<const dvec3> outermost, std::size_t a, std::size_t b) {
  const std::size_t count = sweep.frequencies.size();
  return phase_turn(outermost, scattering_vector(sweep.looks[a / count], sweep.frequencies[a % count]),
                    scattering_vector(sweep.looks[b / count], sweep.frequencies[b % count]));
}

bool in_even_steps(std::span<const double> x) {
  const double step = (x.back() - x.front()) / static_cast<double>(x.size() - 1);
  for (std::size_t i = 1; i < x.size(); ++i)
    if (!(std::abs(x[i] - x[i - 1] - step) < 1e-3 * step)) return false;  // a list may be written with few digits
  return true;
}

std::optional<CoarseSteps> coarse_steps(const Sweep& sweep, std::span<const dvec3> outermost, Quantity quantity,
                                        const std::vector<CutRows>& cuts) {
  CoarseSteps worst{quantity, 0.0, 0.0};
  double most = 0.0;
  for (const std::size_t chosen : spread_choice(cuts.size(), most_groups)) {
    const auto& [fixed, rows, x] = cuts[chosen];
    if (x.size() < least_values || !in_even_steps(x)) continue;
    for (const std::size_t i : spread_choice(rows.size() - 1, most_steps)) {
      const double turn = turn_between(sweep, outermost, rows[i], rows[i + 1]), step = x[i + 1] - x[i];
      if (turn > most) most = turn, worst.step = step, worst.limit = step * most_turn / turn;
    }
  }
  if (resolved(most)) return {};
  return worst;
}

}  // namespace

std::vector<CoarseSteps> coarse_steps(const Sweep& sweep, std::span<const dvec3> outermost) {
  const RowCoordinates coordinates = coordinates_of_rows(sweep);
  std::vector<CoarseSteps> all;
  for (const Quantity quantity :
       {RowCoordinates::phi, RowCoordinates::theta, RowCoordinates::rx_phi, RowCoordinates::rx_theta, RowCoordinates::frequency})
    if (const auto found = coarse_steps(sweep, outermost, quantity, cuts_along(quantity, coordinates))) all.push_back(*found);
  return all;
}

bool can_be_joined(const Sweep& sweep, std::span<const dvec3> outermost, std::span<const std::size_t> rows) {
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (!resolved(turn_between(sweep, outermost, rows[i - 1], rows[i]))) return false;
  return true;
}

}  // namespace raytube
