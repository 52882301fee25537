#include "imaging/window.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <utility>

#include "core/field.h"
#include "math/special/elementary.h"

namespace raytube {

namespace {

constexpr std::array<std::pair<WindowKind, const char*>, 5> names = {{{WindowKind::rectangular, "rectangular"},
                                                                      {WindowKind::hann, "hann"},
                                                                      {WindowKind::hamming, "hamming"},
                                                                      {WindowKind::taylor, "taylor"},
                                                                      {WindowKind::kaiser, "kaiser"}}};

double square(double x) { return x * x; }

// Taylor (1955): zeros of the ideal pattern of equal side lobes up to the n-th, of the sinc beyond.
class TaylorSeries {
 public:
  explicit TaylorSeries(double sidelobe_db) : a_(inverse_cosh(std::pow(10.0, sidelobe_db / 20.0)) / pi) {
    n_ = static_cast<int>(std::floor(2.0 * a_ * a_ + 0.5)) + 1;  // the least n whose zeros move outwards with it
    stretch_ = square(n_) / (a_ * a_ + square(n_ - 0.5));
    for (int m = 1; m < n_; ++m) terms_.push_back(term(m));
  }

  // -1/2 ... 1/2
  double at(double x) const {
    double sum = 1.0;
    for (std::size_t m = 0; m < terms_.size(); ++m) sum += 2.0 * terms_[m] * std::cos(2.0 * pi * static_cast<double>(m + 1) * x);
    return sum;
  }

 private:
  double term(int m) const {
    double product = m % 2 == 1 ? 0.5 : -0.5;
    for (int i = 1; i < n_; ++i) {
      product *= 1.0 - square(m) / (stretch_ * (a_ * a_ + square(i - 0.5)));
      if (i != m) product /= 1.0 - square(m) / square(i);
    }
    return product;
  }

  double a_, stretch_ = 1.0;
  int n_ = 1;
  std::vector<double> terms_;
};

// Kaiser & Schafer (1980), eq. 4b: I_0's argument for side lobes of the spectrum this far down.
double kaiser_argument(double sidelobe_db) {
  if (sidelobe_db < 13.26) return 0.0;
  if (sidelobe_db < 60.0) return 0.76609 * std::pow(sidelobe_db - 13.26, 0.4) + 0.09834 * (sidelobe_db - 13.26);
  return 0.12438 * (sidelobe_db + 6.3);
}

double kaiser(double x, double argument) {
  return std::cyl_bessel_i(0.0, argument * std::sqrt(std::max(0.0, 1.0 - 4.0 * x * x))) / std::cyl_bessel_i(0.0, argument);
}

// The weight at -1/2 < x < 1/2.
double weight(const Window& window, const TaylorSeries& taylor, double x) {
  switch (window.kind) {
    case WindowKind::hann:
      return square(std::cos(pi * x));
    case WindowKind::hamming:
      return 0.54 + 0.46 * std::cos(2.0 * pi * x);
    case WindowKind::taylor:
      return taylor.at(x);
    case WindowKind::kaiser:
      return kaiser(x, kaiser_argument(window.sidelobe_db));
    case WindowKind::rectangular:
      break;
  }
  return 1.0;
}

// |sum of w e^{2 pi i m u / n}| beside the sum of w.
double response(const std::vector<double>& weights, double u) {
  std::complex<double> sum = 0.0;
  double all = 0.0;
  const auto count = static_cast<double>(weights.size());
  for (std::size_t m = 0; m < weights.size(); ++m) {
    sum += std::polar(weights[m], 2.0 * pi * static_cast<double>(m) * u / count);
    all += weights[m];
  }
  return std::abs(sum) / all;
}

}  // namespace

std::optional<WindowKind> window_of_name(const std::string& name) {
  for (const auto& [kind, text] : names)
    if (name == text) return kind;
  return {};
}

std::string name_of(const Window& window) {
  return std::ranges::find(names, window.kind, &std::pair<WindowKind, const char*>::first)->second;
}

std::string description_of(const Window& window) {
  const bool chosen = window.kind == WindowKind::taylor || window.kind == WindowKind::kaiser;
  return chosen ? fmt::format("{}, {:g} dB", name_of(window), window.sidelobe_db) : name_of(window);
}

std::vector<double> weights(const Window& window, std::size_t count) {
  const TaylorSeries taylor(window.sidelobe_db);
  std::vector<double> result;
  for (std::size_t m = 0; m < count; ++m)
    result.push_back(weight(window, taylor, (static_cast<double>(m) + 0.5) / static_cast<double>(count) - 0.5));
  const double largest = std::ranges::max(result);
  for (double& each : result) each /= largest;
  return result;
}

double peak_width(const std::vector<double>& weights) {
  if (weights.size() < 2) return static_cast<double>(weights.size());
  double low = 0.0, high = 0.5 * static_cast<double>(weights.size());
  // The main lobe falls from 1 to its first null; side lobes are lower than 3 dB down.
  for (double u = 0.05; u < high; u += 0.05)
    if (response(weights, u) < std::sqrt(0.5)) high = u;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (response(weights, middle) > std::sqrt(0.5) ? low : high) = middle;
  }
  return 2.0 * low;
}

}  // namespace raytube
