// Closed forms for one strip of a face, and a strip of two edges built from them, against exact references.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "run.h"
#include "unit/quadrature.h"
#include "utd/erfc_ray.h"
#include "utd/strip_kernels.h"

namespace raytube {
namespace {

using testing::measured;
using testing::Table;

FaceIncidence incidence_at(double source_angle) { return {dvec3(0, 0, 1), 0.0, 1.0, source_angle, source_angle < pi}; }

double half_cosine_of(double mu) { return std::sqrt((1 - mu) / 2); }

Reals all_lanes(double x) {
  Reals result;
  for (std::size_t i = 0; i < lanes; ++i) result[i] = x;
  return result;
}

StripKernels kernels_at(const Strip& strip, double length) {
  KernelBatch batch;
  strip.at(std::span(&length, 1), batch);
  return batch[0];
}

TEST(Lanes, PhasorsAgreeWithTheLibraryUpToABillionRadians) {
  double worst = 0.0;
  for (double x = 1e-9; x < 1e9; x *= 1.00037) {
    worst = std::max(worst, std::abs(unit_phasors(all_lanes(-x))[3] - Complex(std::cos(x), -std::sin(x))));
    const double quarter = std::nearbyint(x) * (pi / 2);  // where sine or cosine is all rounding of pi/2
    worst = std::max(worst, std::abs(unit_phasors(all_lanes(quarter))[0] - Complex(std::cos(quarter), std::sin(quarter))));
  }
  measured("largest error of e^{jx}, |x| < 1e9", worst, "");
  EXPECT_LE(worst, 4e-16);  // half a unit in the last place of ours and of the library's, and one in the argument left over
}

TEST(Lanes, OneMinusExponentialKeepsItsRelativeDigits) {
  double worst = 0.0;
  for (double x = 1e-12; x < 1e6; x *= 1.0037)
    worst = std::max(worst, std::abs(one_minus_exp(all_lanes(x))[7] / -std::expm1(-x) - 1));
  EXPECT_LE(worst, 5e-16);  // two units in the last place: ours and the library's roundings
  EXPECT_EQ(one_minus_exp(all_lanes(0.0))[0], 0.0);
}

// W at `step` further on, by its Taylor series: W' = 2jxW - 2 e^{j pi/4} / sqrt(pi), W^(m+1) = 2j (x W^(m) + m W^(m-1)).
using LongComplex = std::complex<long double>;
LongComplex step_on(LongComplex value, long double x, long double step) {
  const LongComplex j2(0, 2), slope = std::sqrt(2 * std::numbers::inv_pi_v<long double>) * LongComplex(1, 1);
  LongComplex before = value, here = j2 * x * value - slope, sum = value;
  long double factor = 1;
  for (int m = 1; m < 20; ++m) {
    factor *= step / m;
    sum += factor * here;
    before = std::exchange(here, j2 * (x * here + static_cast<long double>(m) * before));
  }
  return sum;
}

// Asymptotic series, sum of (-1)^m (2m-1)!! / (2 z^2)^m over sqrt(pi) z: the first term left out is 1e-17 at x = 20.
Complex scaled_erfc_far(double x) {
  const Complex z = std::polar(x, pi / 4);
  Complex term = std::numbers::inv_sqrtpi / z, sum = term;
  for (int m = 1; m < 8; ++m) sum += term *= -(2.0 * m - 1) / (2.0 * z * z);
  return sum;
}

TEST(ErfcRay, AgreesWithItsDifferentialEquationAndItsAsymptoticSeries) {
  double near = 0.0, far = 0.0;
  constexpr double step = 1.0 / 128;
  LongComplex exact = 1.0L;
  for (double x = 0.0; x < 20.0; x += step) {
    near = std::max(near, std::abs(scaled_erfc(x) - Complex(exact)) * std::max(1.0, x));
    exact = step_on(exact, x, step);
  }
  for (double x = 20.0; x < 1e8; x *= 1.0137) far = std::max(far, std::abs(scaled_erfc(x) - scaled_erfc_far(x)) * x);
  measured("largest error of W(x) max(1, x), x < 20", near, "");
  measured("largest error of W(x) max(1, x), x > 20", far, "");
  EXPECT_LE(near, 1e-15);  // 4e-16 of the fit and two or three roundings
  EXPECT_LE(far, 1e-15);
}

TEST(ErfcRay, QuotientsJoinTheirLimits) {
  // erf(z)/x across its switch at 1/2; the divided difference against the mean of the derivative over the same interval.
  for (const double x : {0.5 - 1e-12, 0.5 + 1e-12}) {
    const Complex decay = std::polar(1.0, -x * x), value = scaled_erfc(x);
    Complexes values{}, decays{};
    values.set(0, value);
    decays.set(0, decay);
    EXPECT_LE(std::abs(erf_over(all_lanes(x), values, decays)[0] - (1.0 - decay * value) / x), 1e-14);
  }
  const GaussLegendre rule(12);
  for (const double middle : {0.05, 0.7, 3.0, 20.0})
    for (const double apart : {0.0, 1e-9, 1e-3, 0.09 / (1 + middle), 0.09}) {
      Complex mean = 0.0;
      for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double x = middle + apart * (rule.nodes[i] - 0.5);
        mean += rule.weights[i] * (Complex(0, 2 * x) * scaled_erfc(x) - 2 * std::numbers::inv_sqrtpi * std::polar(1.0, pi / 4));
      }
      const Reals a = all_lanes(middle + apart / 2), b = all_lanes(middle - apart / 2);
      // W' = O(1) is a difference of two terms of size 2x W = O(1): rounding of the mean. As a quotient the difference loses 20
      // times rounding at x = 20.
      EXPECT_LE(std::abs(divided_difference(a, b, scaled_erfc(a), scaled_erfc(b))[0] - mean), 3e-14) << middle << ' ' << apart;
    }
}

/// The kernels of a strip by quadrature over the exact current of the wedge: eigenfunction series minus physical optics.
FringeKernels by_quadrature(double n, double source, double mu, double end) {
  static const GaussLegendre rule(24);
  const int panels = static_cast<int>(end) + 9;
  FringeKernels sum{};
  const auto total = [&](double x) { return wedge_field(n, source, x); };
  const double lit = source < pi ? 1.0 : 0.0;
  for (int panel = 0; panel < panels; ++panel)
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double t = (panel + rule.nodes[i]) / panels, x = end * std::pow(t, 4);  // takes up the edge's x^(1/n - 1)
      const Complex weight = rule.weights[i] / panels * 4 * end * std::pow(t, 3) * std::polar(1.0, mu * x);
      const Complex wave = 2 * lit * std::polar(1.0, x * std::cos(source));
      const WedgeField field = total(x);
      sum.hard += weight * (field.hard - wave) / Complex(0, 2);
      sum.soft -= 0.5 * weight * (field.soft_slope - Complex(0, std::sin(source)) * wave);
    }
  const Complex at_end = total(end).hard - 2 * lit * std::polar(1.0, end * std::cos(source));
  sum.axial = mu * sum.hard + 0.5 * (at_end * std::polar(1.0, end * mu) - (2 / n - 2 * lit));
  return sum;
}

struct Worst {
  double soft = 0.0, hard = 0.0, axial = 0.0;
};

Worst worst_error(double n, double end) {
  Worst worst;
  for (const double source : {0.0, 0.6, 1.7, 2.9, 3.6, n * pi})
    for (const double mu : {-0.8, -0.2, 0.5, 0.95}) {
      if (source > n * pi) continue;
      const FringeKernels exact = by_quadrature(n, source, mu, end);
      const FringeKernels found = kernels_at(Strip(n, incidence_at(source), half_cosine_of(mu)), end).current;
      worst.hard = std::max(worst.hard, std::abs(found.hard - exact.hard));
      worst.axial = std::max(worst.axial, std::abs(found.axial - exact.axial));
      if (source > 0.0 && source < n * pi) worst.soft = std::max(worst.soft, std::abs(found.soft - exact.soft));
    }
  return worst;
}

TEST(StripKernels, AgreeWithQuadratureOfTheExactCurrent) {
  struct Row {
    double n, end;
    Worst error;
  };
  // n = 2: the closed forms are exact; rounding of kernels of size 6, in the series' sum of 50 terms. Others: the error of the
  // uniform wave close to the edge, as established by an independent implementation and printed there to two digits, hence 3 %.
  const Row rows[] = {
      {2.0, 2, {5e-14, 5e-14, 5e-14}},          {2.0, 20, {5e-14, 5e-14, 5e-14}},    {11.0 / 6, 2, {1.3e-2, 2.0e-2, 2.1e-2}},
      {11.0 / 6, 20, {8.1e-4, 8.6e-3, 8.7e-3}}, {1.75, 6, {4.4e-3, 1.6e-2, 1.7e-2}}, {1.5, 2, {2.7e-2, 2.3e-2, 3.3e-2}},
      {1.5, 6, {8.3e-3, 1.7e-2, 1.8e-2}},       {1.5, 20, {2.1e-3, 8.5e-3, 8.6e-3}}, {1.5, 60, {5.6e-4, 3.4e-3, 3.4e-3}}};
  for (const Row& row : rows) {
    const Worst found = worst_error(row.n, row.end);
    std::printf("measured: n = %.4g, X = %g: error of Gh %.1e, Gx %.1e, Gs %.1e\n", row.n, row.end, found.hard, found.axial,
                found.soft);
    EXPECT_LE(found.hard, 1.03 * row.error.hard) << row.n << ' ' << row.end;
    EXPECT_LE(found.axial, 1.03 * row.error.axial) << row.n << ' ' << row.end;
    EXPECT_LE(found.soft, 1.03 * row.error.soft) << row.n << ' ' << row.end;
  }
}

TEST(StripKernels, EndlessStripsAreTheFirstOrderKernels) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  // 1e-12 of the kernels' size: they are the same functions, added up in another order.
  for (const double n : {2.0, 1.75, 1.5, 1.25})
    for (const double source : {0.4, 2.9, 3.3, 0.9 * n * pi})
      for (const double h : {0.05, 0.3, 0.9, 1.5, 10.0}) {
        if (source > n * pi) continue;
        const FringeKernels found = kernels_at(Strip(n, incidence_at(source), h), infinity).current;
        const FringeKernels exact = fringe_kernels(n, incidence_at(source), glance_at(h));
        const double scale = 1 + std::abs(exact.hard);
        EXPECT_LE(std::abs(found.hard - exact.hard), 1e-12 * scale) << n << ' ' << source << ' ' << h;
        EXPECT_LE(std::abs(found.soft - exact.soft), 1e-12 * scale) << n << ' ' << source << ' ' << h;
        EXPECT_LE(std::abs(found.axial - exact.axial), 1e-12 * scale * (1 + h * h)) << n << ' ' << source << ' ' << h;
      }
}

TEST(StripKernels, BoundedWhereSourceAndObserverGrazeTheFaceForwards) {
  // The endless strip's pole. A strip of length X holds a current of at most 2 in magnitude: |G_h| <= X.
  for (const double n : {2.0, 1.5})
    for (const double source : {pi - 1e-6, pi - 1e-3, pi - 1e-7, pi + 1e-7, pi + 1e-6})
      for (const double h : {0.0, 1e-9, 1e-6, 1e-3}) {
        const StripKernels kernels = kernels_at(Strip(n, incidence_at(source), h), 20.0);
        EXPECT_LE(std::abs(kernels.current.hard), 20.0) << source << ' ' << h;
      }
}

bool same_bits(Complex a, Complex b) { return a.real() == b.real() && a.imag() == b.imag(); }

TEST(StripKernels, AKernelDoesNotDependOnItsPlaceInTheBatch) {
  // Lengths from each branch, among them one whose divided difference is a series (source and observer on the same term) and an
  // endless strip; every length alone, and in every place of batches of every size.
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<double> lengths = {1e-6, 0.02, 0.7, 3.0, infinity, 20.0, 60.0, 1e3, 5e5, 12.0, 0.3};
  for (const double n : {2.0, 1.5}) {
    const Strip strip(n, incidence_at(0.8), std::cos(0.4) + 1e-4);
    for (std::size_t shift = 0; shift < lengths.size(); ++shift)
      for (std::size_t count = 1; count <= lengths.size(); ++count) {
        std::vector<double> some;
        for (std::size_t i = 0; i < count; ++i) some.push_back(lengths[(shift + i) % lengths.size()]);
        KernelBatch batch;
        strip.at(some, batch);
        for (std::size_t i = 0; i < count; ++i) {
          const StripKernels here = batch[i], alone = kernels_at(strip, some[i]);
          EXPECT_TRUE(same_bits(here.current.soft, alone.current.soft) && same_bits(here.current.hard, alone.current.hard) &&
                      same_bits(here.current.axial, alone.current.axial) && same_bits(here.end, alone.end))
              << some[i];
        }
      }
  }
}

TEST(StripKernels, WeightedSumsTakeTheRightElements) {
  ComplexColumn column;
  column.resize(20);
  for (std::size_t i = 0; i < 20; ++i) column.set(i, Complex(1.0 + static_cast<double>(i), 0.5));
  const std::vector<Complex> weights(11, Complex(2, 1));
  // Whole numbers and halves: no rounding. Sum of (2 + j)(1 + i + j/2) over i = 5..15.
  EXPECT_EQ(weighted_sum(column, 5, weights), Complex(2, 1) * Complex(121, 5.5));
  EXPECT_EQ(weighted_sum(column, 5, {}), Complex(0.0));
}

// --- a strip of two parallel edges, per unit length: 2-D scattering, orders as in the edge pass ---

constexpr double k = 2 * pi;

struct Arrival {
  Complex radiated;  // of both sides of the sheet
  Complex onwards;   // the current on the far edge, with the phase of what radiates from there
};

/// Both sides of the sheet from one edge: the two faces of a half plane, whose currents add with opposite normals.
Arrival both_sides(double source_lit, double source_dark, bool hard, double mu, double length) {
  const StripKernels lit = kernels_at(Strip(2.0, incidence_at(source_lit), half_cosine_of(mu)), length);
  const StripKernels dark = kernels_at(Strip(2.0, incidence_at(source_dark), half_cosine_of(mu)), length);
  if (!hard) return {lit.current.soft + dark.current.soft, 0.0};
  return {lit.current.hard - dark.current.hard, 2.0 * (lit.end - dark.end)};
}

/// Amplitude P of a strip of width w [wavelengths]; order 1 stops at the far edge.
Complex strip_amplitude(double w, double source, double observer, int order, bool hard) {
  const double x = k * w, spread = std::cos(source) + std::cos(observer);
  Complex p = 2 * w * sinc(x * spread / 2) * (hard ? 1.0 : std::sin(source));
  for (const int edge : {0, 1}) {
    double mu = edge == 0 ? std::cos(observer) : -std::cos(observer);
    const double angle = edge == 0 ? source : pi - source;
    Complex phase = std::polar(1.0, (edge == 0 ? -0.5 : 0.5) * x * spread);
    Arrival arrival = both_sides(angle, 2 * pi - angle, hard, mu, x);
    p += Complex(0, 2 / k) * arrival.radiated * phase;
    Complex wave = hard ? arrival.onwards : 0.0;
    for (int step = 2; step <= order && hard; ++step) {
      mu = -mu;
      arrival = both_sides(0.0, 2 * pi, true, mu, x);
      p += Complex(0, 2 / k) * arrival.radiated * 0.5 * wave * phase;
      wave *= 0.5 * arrival.onwards;
    }
  }
  return k / 4 * (hard ? std::sin(observer) : -1.0) * p;
}

struct StripError {
  double db[3] = {0, 0, 0};  // rms, elevations 5-20, 20-60, 60-85 deg
  double relative = 0.0;     // of P over all elevations
};

/// Against the spectral solution of a strip of 5 wavelengths, monostatic.
StripError strip_error(bool hard, int order) {
  std::ifstream file(std::string(RAYTUBE_SOURCE_DIR) + "/tests/data/strip_5_wavelengths_" + (hard ? "hard.csv" : "soft.csv"));
  StripError error;
  int count[3] = {0, 0, 0};
  for (std::string line; std::getline(file, line);) {
    double elevation = 0.0, exact_db = 0.0;
    if (std::sscanf(line.c_str(), "%lf,%lf", &elevation, &exact_db) != 2 || elevation < 5 || elevation > 85) continue;
    const double found = 20 * std::log10(std::abs(strip_amplitude(5, elevation * degree, elevation * degree, order, hard)));
    const int band = elevation < 20 ? 0 : elevation < 60 ? 1 : 2;
    error.db[band] += (found - exact_db) * (found - exact_db);
    ++count[band];
  }
  for (int band = 0; band < 3; ++band) error.db[band] = std::sqrt(error.db[band] / count[band]);
  return error;
}

TEST(StripKernels, StripOfFiveWavelengthsAgreesWithTheTwoDimensionalSolution) {
  struct Row {
    bool hard;
    int order;
    double limit_db[3];
  };
  // What an independent implementation finds (first order without the far edge: 6.9, 2.8, 1.0 dB hard), rounded up by a digit.
  const Row rows[] = {{true, 1, {3.4, 1.15, 0.33}},
                      {true, 2, {0.04, 0.03, 0.03}},
                      {true, 3, {0.04, 0.01, 0.01}},
                      {true, 4, {0.02, 0.01, 0.01}},
                      {false, 1, {0.15, 0.04, 0.01}}};
  for (const Row& row : rows) {
    const StripError error = strip_error(row.hard, row.order);
    std::printf("measured: strip 5 wavelengths, %s, order %d: %.3f / %.3f / %.3f dB rms\n", row.hard ? "hard" : "soft", row.order,
                error.db[0], error.db[1], error.db[2]);
    for (int band = 0; band < 3; ++band) EXPECT_LE(error.db[band], row.limit_db[band]) << row.hard << row.order << band;
  }
}

}  // namespace
}  // namespace raytube
