#include "utd/rounded/rounded_wedge.h"

#include <algorithm>
#include <cmath>

#include "utd/rounded/k_table.h"

namespace raytube {

namespace {

// Between two nodes of the table; below the first its value, whose limit is nearly reached there.
struct Place {
  std::size_t below;
  double share;  // of the next node
};

template <std::size_t count>
Place place_of(const std::array<double, count>& nodes, double value) {
  const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, value);
  const double low = above[-1], high = above[0];
  return {static_cast<std::size_t>(above - nodes.begin()) - 1, std::clamp((value - low) / (high - low), 0.0, 1.0)};
}

// Linear in alpha and ln(kt).
struct TablePlace {
  Place angle, distance;

  TablePlace(double interior_angle, double tangent_distance)
      : angle(place_of(k_table::angles, interior_angle / degree)), distance(place_of(k_table::distances, tangent_distance)) {
    const double low = k_table::distances[distance.below], high = k_table::distances[distance.below + 1];
    const double inside = std::clamp(tangent_distance, low, high);
    distance.share = std::log(inside / low) / std::log(high / low);
  }

  double at(const k_table::Blocks& blocks, std::size_t pair) const {
    const auto along = [&](std::size_t a) {
      const auto& row = blocks[a];
      return std::lerp(row[distance.below][pair], row[distance.below + 1][pair], distance.share);
    };
    return std::lerp(along(angle.below), along(angle.below + 1), angle.share);
  }
};

// T = -jK / (1 + jK) = -(K^2 + jK) / (1 + K^2), all factors commute.
ModeMatrix tabulated_modes(bool hard, double interior_angle, double tangent_distance) {
  const std::array<glm::dmat3, 2> blocks = rounded_k_matrix(hard, interior_angle, tangent_distance);
  ModeMatrix result(6);
  for (std::size_t parity = 0; parity < 2; ++parity) {
    const glm::dmat3& k = blocks[parity];
    const glm::dmat3 damped = k * glm::inverse(glm::dmat3(1.0) + k * k), real = k * damped;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) result.at(parity + 2 * i, parity + 2 * j) = -Complex(real[i][j], damped[i][j]);
  }
  return result;
}

SoftHardModes modes_of_arc(double interior_angle, double tangent_distance) {
  if (tangent_distance > most_tabulated_distance)
    return section_modes(arc_section(interior_angle, tangent_distance), interior_angle, tangent_distance);
  return {tabulated_modes(false, interior_angle, tangent_distance), tabulated_modes(true, interior_angle, tangent_distance)};
}

// T_mq times e_m e_q j^(nu_m + nu_q); e_0 = 1, else root 2.
void weigh(ModeMatrix& modes, double n) {
  const auto factor = [&](std::size_t m) {
    return std::polar(m == 0 ? 1.0 : std::numbers::sqrt2, pi * static_cast<double>(m) / (2 * n));
  };
  for (std::size_t m = 0; m < modes.size; ++m)
    for (std::size_t q = 0; q < modes.size; ++q) modes.at(m, q) *= factor(m) * factor(q);
}

// cos(m a) or sin(m a) one after the other.
std::vector<double> angular(bool hard, double a, std::size_t count) {
  std::vector<double> values{hard ? 1.0 : 0.0, hard ? std::cos(a) : std::sin(a)};
  const double twice = 2 * std::cos(a);
  while (values.size() < count) values.push_back(twice * values.back() - values.end()[-2]);
  return values;
}

}  // namespace

std::array<glm::dmat3, 2> rounded_k_matrix(bool hard, double interior_angle, double tangent_distance) {
  const TablePlace place(interior_angle, tangent_distance);
  const double n = 2.0 - interior_angle / pi;
  std::array<glm::dmat3, 2> result;
  std::size_t pair = 0;
  for (int parity = 0; parity < 2; ++parity)
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) {
        const int orders = 2 * (parity + i + j);
        const double power = orders == 0 ? 2.0 : orders / n;
        result[parity][i][j] = result[parity][j][i] =
            place.at(hard ? k_table::hard : k_table::soft, pair++) * std::pow(tangent_distance, power);
      }
  return result;
}

RoundedWedge::RoundedWedge(double interior_angle, double tangent_distance)
    : RoundedWedge(interior_angle, modes_of_arc(interior_angle, tangent_distance)) {}

RoundedWedge::RoundedWedge(double interior_angle, SoftHardModes modes) : n_(2.0 - interior_angle / pi), modes_(std::move(modes)) {
  weigh(modes_.soft, n_);
  weigh(modes_.hard, n_);
}

// dP = sqrt(2 / pi k) e^{j pi/4} (2/n) SUM j^nu_m C(nu_m phi) T_mq eps_q j^nu_q C(nu_q phi').
Complex RoundedWedge::strength(const ModeMatrix& modes, bool hard, double observation_angle, double source_angle) const {
  const std::vector<double> to = angular(hard, observation_angle / n_, modes.size);
  const std::vector<double> from = angular(hard, source_angle / n_, modes.size);
  Complex sum = 0.0;
  for (std::size_t m = 0; m < modes.size; ++m) {
    Complex outgoing = 0.0;
    for (std::size_t q = 0; q < modes.size; ++q) outgoing += modes.at(m, q) * from[q];
    sum += to[m] * outgoing;
  }
  return Complex(0.0, 2.0 / (n_ * pi)) * sum;
}

}  // namespace raytube
