#include "utd/rounded/rounded_wedge.h"

#include <cmath>

namespace raytube {

namespace {

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
