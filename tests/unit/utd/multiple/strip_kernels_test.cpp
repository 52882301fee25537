// Closed forms for one strip of a face against exact references.
#include "utd/multiple/strip_kernels.h"

#include <gtest/gtest.h>

#include "math/erfc_ray.h"
#include "run.h"
#include "strip_2d.h"
#include "unit/quadrature.h"

namespace raytube {
namespace {

using namespace raytube::testing;

Reals all_lanes(double x) {
  Reals result;
  for (std::size_t i = 0; i < lanes; ++i) result[i] = x;
  return result;
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

/// The exact fringe current of a wedge's face, eigenfunction series minus physical optics, at the points of a quadrature over a
/// strip of length `end` and at its end.
class ExactCurrent {
 public:
  ExactCurrent(double n, double source, double end) : n_(n), lit_(source < pi ? 1.0 : 0.0), end_(end) {
    static const GaussLegendre rule(24);
    const int panels = static_cast<int>(end) + 9;
    for (int panel = 0; panel < panels; ++panel)
      for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double t = (panel + rule.nodes[i]) / panels, x = end * std::pow(t, 4);  // takes up the edge's x^(1/n - 1)
        samples_.push_back({x, rule.weights[i] / panels * 4 * end * std::pow(t, 3), fringe(source, x)});
      }
    at_end_ = fringe(source, end).hard;
  }

  FringeKernels kernels(double mu) const {
    FringeKernels sum{};
    for (const Sample& sample : samples_) {
      const Complex weight = sample.weight * std::polar(1.0, mu * sample.x);
      sum.hard += weight * sample.current.hard / Complex(0, 2);
      sum.soft -= 0.5 * weight * sample.current.soft_slope;
    }
    sum.axial = mu * sum.hard + 0.5 * (at_end_ * std::polar(1.0, end_ * mu) - (2 / n_ - 2 * lit_));
    return sum;
  }

 private:
  struct Sample {
    double x, weight;
    WedgeField current;
  };

  WedgeField fringe(double source, double x) const {
    const Complex wave = 2 * lit_ * std::polar(1.0, x * std::cos(source));
    WedgeField field = wedge_field(n_, source, x);
    field.hard -= wave;
    field.soft_slope -= Complex(0, std::sin(source)) * wave;
    return field;
  }

  double n_, lit_, end_;
  std::vector<Sample> samples_;
  Complex at_end_;
};

struct Largest {
  double hard = 0.0, axial = 0.0, soft = 0.0;

  void add(const FringeKernels& kernels) {
    hard = std::max(hard, std::abs(kernels.hard));
    axial = std::max(axial, std::abs(kernels.axial));
    soft = std::max(soft, std::abs(kernels.soft));
  }
};

/// Largest error of the kernels and largest exact kernels over six sources and four observers.
struct Comparison {
  Largest error, exact;

  Comparison(double n, double end) {
    for (const double source : {0.0, 0.6, 1.7, 2.9, 3.6, n * pi}) {
      if (source > n * pi) continue;
      const ExactCurrent current(n, source, end);
      for (const double mu : {-0.8, -0.2, 0.5, 0.95}) {
        const FringeKernels wanted = current.kernels(mu);
        const FringeKernels found = kernels_at(Strip(n, incidence_at(source), half_cosine_of(mu)), end).current;
        exact.add(wanted);
        error.add({found.soft - wanted.soft, found.hard - wanted.hard, found.axial - wanted.axial});
      }
    }
  }
};

TEST(StripKernels, OfAHalfPlaneAreExact) {
  // The series' Bessel functions carry some end * 1e-15. The sizes are those an independent implementation prints.
  const std::pair<double, std::string> rows[] = {{2, "0.88"}, {6, "2.39"}, {20, "6.31"}, {60, "9.21"}};
  for (const auto& [end, size] : rows) {
    const Comparison found(2.0, end);
    std::printf("measured: n = 2, X = %g: error of Gh %.1e, Gx %.1e, Gs %.1e\n", end, found.error.hard, found.error.axial,
                found.error.soft);
    EXPECT_LE(std::max({found.error.hard, found.error.axial, found.error.soft}), 5e-15 * end) << end;
    expect_printed(found.exact.hard, size, "n = 2, largest Gh");
  }
}

TEST(StripKernels, OfAWedgeHaveTheErrorOfTheUniformWave) {
  struct Row {
    double n, end;
    const char *hard, *axial, *soft;
  };
  // The uniform wave is not exact close to the edge. Errors as an independent implementation prints them, to half a unit of the
  // last digit: the kernels are the same functions.
  const Row rows[] = {{11.0 / 6, 2, "2.0e-2", "2.1e-2", "1.3e-2"},  {11.0 / 6, 6, "1.7e-2", "1.8e-2", "3.5e-3"},
                      {11.0 / 6, 20, "8.6e-3", "8.7e-3", "8.1e-4"}, {11.0 / 6, 60, "3.3e-3", "3.4e-3", "3.2e-4"},
                      {1.75, 2, "2.0e-2", "2.0e-2", "1.8e-2"},      {1.75, 6, "1.6e-2", "1.7e-2", "4.4e-3"},
                      {1.75, 20, "8.4e-3", "8.5e-3", "1.2e-3"},     {1.75, 60, "3.3e-3", "3.3e-3", "3.2e-4"},
                      {1.5, 2, "2.3e-2", "3.3e-2", "2.7e-2"},       {1.5, 6, "1.7e-2", "1.8e-2", "8.3e-3"},
                      {1.5, 20, "8.5e-3", "8.6e-3", "2.1e-3"},      {1.5, 60, "3.4e-3", "3.5e-3", "5.6e-4"}};
  for (const Row& row : rows) {
    const Largest found = Comparison(row.n, row.end).error;
    char what[64];
    std::snprintf(what, sizeof what, "kernel n = %.4g, X = %g, error of ", row.n, row.end);
    expect_printed(found.hard, row.hard, what + std::string("Gh"));
    expect_printed(found.axial, row.axial, what + std::string("Gx"));
    expect_printed(found.soft, row.soft, what + std::string("Gs"));
  }
}

TEST(StripKernels, OfACurrentThatACornerMirroredAreExact) {
  // The part from the corner on: as for whole strips, the series' Bessel functions carry some end * 1e-15.
  for (const auto& [begin, end] : {std::pair(2.0, 4.0), {6.0, 7.5}, {20.0, 60.0}})
    for (const double source : {0.0, 0.6, 2.9, 3.6, 2 * pi}) {
      const ExactCurrent to_begin(2.0, source, begin), to_end(2.0, source, end);
      for (const double mu : {-0.8, 0.5, 0.95}) {
        const FringeKernels shorter = to_begin.kernels(mu), longer = to_end.kernels(mu);
        const FringeKernels found = piece_of(Strip(2.0, incidence_at(source), half_cosine_of(mu)), begin, end).current;
        EXPECT_LE(std::abs(found.hard - (longer.hard - shorter.hard)), 1e-14 * end) << source << ' ' << mu;
        EXPECT_LE(std::abs(found.soft - (longer.soft - shorter.soft)), 1e-14 * end) << source << ' ' << mu;
        EXPECT_LE(std::abs(found.axial - (longer.axial - shorter.axial)), 1e-14 * end) << source << ' ' << mu;
      }
    }
}

TEST(StripKernels, OfAMirroredCurrentVanishWithItsLength) {
  // The hard current is 2 at most, the kernel half its integral; rounding is that of the two strips of length 20.
  for (const double n : {2.0, 1.5})
    for (const double source : {0.0, 0.8, n * pi})
      for (const double length : {1.0, 1e-3, 1e-6, 0.0}) {
        const StripKernels part = piece_of(Strip(n, incidence_at(source), 0.6), 20.0, 20.0 + length);
        EXPECT_LE(std::abs(part.current.hard), length + 1e-13) << n << ' ' << source;
        EXPECT_LE(std::abs(part.current.soft), length + 1e-13) << n << ' ' << source;
      }
}

TEST(StripKernels, UntruncatedStripsAreTheFirstOrderKernels) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  // 1e-12 of the kernels' size: they are the same functions, added up in another order.
  for (const double n : {2.0, 1.75, 1.5, 1.25})
    for (const double source : {0.4, 2.9, 3.3, 0.9 * n * pi})
      for (const double h : {0.05, 0.3, 0.9, 1.5, 10.0}) {
        if (source > n * pi) continue;
        const FringeKernels found = kernels_at(Strip(n, incidence_at(source), h), infinity).current;
        const FringeKernels exact = fringe_kernels(n, incidence_at(source), grazing_ray_at(h));
        const double scale = 1 + std::abs(exact.hard);
        EXPECT_LE(std::abs(found.hard - exact.hard), 1e-12 * scale) << n << ' ' << source << ' ' << h;
        EXPECT_LE(std::abs(found.soft - exact.soft), 1e-12 * scale) << n << ' ' << source << ' ' << h;
        EXPECT_LE(std::abs(found.axial - exact.axial), 1e-12 * scale * (1 + h * h)) << n << ' ' << source << ' ' << h;
      }
}

TEST(StripKernels, BoundedWhereSourceAndObserverGrazeTheFaceForwards) {
  // The untruncated strip's pole. A strip of length X holds a current of at most 2 in magnitude: |G_h| <= X.
  for (const double n : {2.0, 1.5})
    for (const double source : {pi - 1e-6, pi - 1e-3, pi - 1e-7, pi + 1e-7, pi + 1e-6})
      for (const double h : {0.0, 1e-9, 1e-6, 1e-3}) {
        const StripKernels kernels = kernels_at(Strip(n, incidence_at(source), h), 20.0);
        EXPECT_LE(std::abs(kernels.current.hard), 20.0) << source << ' ' << h;
      }
}

bool same_bits(Complex a, Complex b) { return a.real() == b.real() && a.imag() == b.imag(); }

TEST(StripKernels, AKernelDoesNotDependOnItsIndexInTheBatch) {
  // Lengths from each branch, among them one whose divided difference is a series (source and observer on the same term) and an
  // untruncated strip; every length alone, and at every index of batches of every size.
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

TEST(StripKernels, SumsOverColumnsTakeTheRightElements) {
  ComplexColumn column, weights;
  column.make_room(20);
  weights.make_room(20);
  for (std::size_t i = 0; i < 20; ++i) {
    column.set(i, Complex(1.0 + static_cast<double>(i), 0.5));
    weights.set(i, Complex(2, 1));
  }
  // Whole numbers and halves: no rounding. Sum of 1 + i + j/2 over i = 5..15.
  EXPECT_EQ(sum({column, 5}, 11), Complex(121, 5.5));
  EXPECT_EQ(sum_of_products({weights, 3}, {column, 5}, 11), Complex(2, 1) * Complex(121, 5.5));
  EXPECT_EQ(sum_of_products({weights, 0}, {column, 5}, 0), Complex(0.0));
}

}  // namespace
}  // namespace raytube
