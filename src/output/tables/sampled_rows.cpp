#include "output/tables/sampled_rows.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scene/sampling.h"

namespace raytube {

namespace {

using Quantity = RowCoordinates::Quantity;

constexpr std::size_t least_values = 4, most_sweeps = 100, most_steps = 1000;
constexpr std::size_t most_looks = 100000;  // the first ones tell what is swept, and sorting them takes memory

double turn_between(const Sweep& sweep, std::span<const dvec3> outermost, std::size_t a, std::size_t b) {
  const std::size_t count = sweep.frequencies.size();
  return phase_turn(outermost, scattering_vector(sweep.looks[a / count], sweep.frequencies[a % count]),
                    scattering_vector(sweep.looks[b / count], sweep.frequencies[b % count]));
}

// The widest steps of one quantity so far, by the phase they turn.
class Widest {
 public:
  Widest(const Sweep& sweep, std::span<const dvec3> outermost, Quantity quantity)
      : sweep_(sweep),
        outermost_(outermost),
        found_{quantity, 0.0, 0.0},
        most_(quantity == RowCoordinates::frequency ? most_turn_of_profile : most_turn) {}

  void add(std::span<const std::size_t> rows, std::span<const double> x) {
    if (x.size() < least_values || !in_even_steps(x)) return;
    for (const std::size_t i : spread_choice(rows.size() - 1, most_steps)) {
      const double turn = turn_between(sweep_, outermost_, rows[i], rows[i + 1]), step = x[i + 1] - x[i];
      if (turn > turn_) turn_ = turn, found_.step = step, found_.limit = step * most_ / turn;
    }
  }

  void tell(std::vector<CoarseSteps>& all) const {
    if (!resolved(turn_, most_)) all.push_back(found_);
  }

 private:
  const Sweep& sweep_;
  std::span<const dvec3> outermost_;
  CoarseSteps found_;
  double most_;
  double turn_ = 0.0;
};

std::vector<double> values_of(const RowCoordinates& coordinates, Quantity quantity, std::span<const std::size_t> rows) {
  std::vector<double> values;
  for (const std::size_t row : rows) values.push_back(coordinates.rows[row][quantity]);
  return values;
}

// Lobes are narrowest at the highest frequency.
void add_angles(const Sweep& sweep, std::span<const dvec3> outermost, std::vector<CoarseSteps>& all) {
  Sweep looks{{std::ranges::max(sweep.frequencies)}, {}, sweep.bistatic};
  const auto count = static_cast<std::ptrdiff_t>(std::min(sweep.looks.size(), most_looks));
  looks.looks.assign(sweep.looks.begin(), sweep.looks.begin() + count);
  if (looks.looks.size() < least_values) return;
  const RowCoordinates coordinates = coordinates_of_rows(looks);
  for (const Quantity quantity : {RowCoordinates::phi, RowCoordinates::theta, RowCoordinates::rx_phi, RowCoordinates::rx_theta}) {
    if (!coordinates.told[quantity]) continue;
    const auto groups = rows_along(quantity, coordinates);
    Widest widest(looks, outermost, quantity);
    for (const std::size_t i : spread_choice(groups.size(), most_sweeps))
      widest.add(groups[i], values_of(coordinates, quantity, groups[i]));
    widest.tell(all);
  }
}

void add_frequencies(const Sweep& sweep, std::span<const dvec3> outermost, std::vector<CoarseSteps>& all) {
  std::vector<std::size_t> order(sweep.frequencies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t f) { return sweep.frequencies[f]; });
  std::vector<double> gigahertz;
  for (const std::size_t f : order) gigahertz.push_back(sweep.frequencies[f] / 1e9);
  Widest widest(sweep, outermost, RowCoordinates::frequency);
  for (const std::size_t look : spread_choice(sweep.looks.size(), most_sweeps)) {
    std::vector<std::size_t> rows;
    for (const std::size_t f : order) rows.push_back(sweep.row(look, f));
    widest.add(rows, gigahertz);
  }
  widest.tell(all);
}

}  // namespace

bool in_even_steps(std::span<const double> x) {
  const double step = (x.back() - x.front()) / static_cast<double>(x.size() - 1);
  for (std::size_t i = 1; i < x.size(); ++i)
    if (!(std::abs(x[i] - x[i - 1] - step) < 1e-3 * step)) return false;
  return true;
}

std::vector<CoarseSteps> coarse_steps(const Sweep& sweep, std::span<const dvec3> outermost) {
  std::vector<CoarseSteps> all;
  add_angles(sweep, outermost, all);
  add_frequencies(sweep, outermost, all);
  return all;
}

bool can_be_joined(const Sweep& sweep, std::span<const dvec3> outermost, std::span<const std::size_t> rows) {
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (!resolved(turn_between(sweep, outermost, rows[i - 1], rows[i]))) return false;
  return true;
}

}  // namespace raytube
