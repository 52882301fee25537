// Phase gradients from nothing to many turns in every closed form and series that integrates over a footprint, an edge or a
// strip: right everywhere, and nothing jumps where a series takes over from a quotient.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "math/erfc_ray.h"
#include "math/filon.h"
#include "math/triangle_moments.h"
#include "run.h"
#include "sbr/beams/polygon_integral.h"
#include "sbr/curved/curved_integral.h"
#include "stress/fine_quadrature.h"
#include "stress/stability.h"
#include "utd/wedge/edge_currents.h"
#include "utd/wedge/edge_wave_integral.h"

namespace raytube::testing {
namespace {

constexpr double machine = std::numeric_limits<double>::epsilon();

/// 0, powers of ten from 1e-300 to 1e3 of both signs, and places close to where formulas change over: these and their neighbours
/// among the floating-point numbers.
std::vector<double> gradients(const std::vector<double>& switches, int most = 3) {
  std::vector<double> all = {0.0, -0.0};
  for (int power = -300; power <= -20; power += size_of_run(70, 10)) all.push_back(std::pow(10.0, power));
  for (double power = -18; power <= most; power += size_of_run(0.75, 0.05)) all.push_back(std::pow(10.0, power));
  for (const double at : switches)
    for (const double beside : {0.0, 1e-15, 1e-9, 1e-4, 0.03}) {
      all.push_back(at * (1 - beside));
      all.push_back(at * (1 + beside));
    }
  return all;
}

/// The larger of |error| / (1 + 0.1 |x|) over gradients x: closed forms are good to rounding of an angle as it is given.
struct Worst {
  double error = 0.0;
  void note(Complex found, FineComplex wanted, double size = 1.0) {
    const double off = static_cast<double>(std::abs(FineComplex(found) - wanted)) / size;
    error = std::isfinite(off) ? std::max(error, off) : std::numeric_limits<double>::infinity();
  }
};

// Mean over a triangle of e^{jx}: across it in closed form, which loses nothing, along it by quadrature.
FineComplex triangle_mean(Fine x1, Fine x2, Fine x3) {
  const Fine a = x2 - x1, b = x3 - x2;
  return fine_integral(std::abs(a) + std::abs(b), [&](Fine s) {
    const Fine half = s * b / 2, sinc = half == 0 ? Fine(1) : std::sin(half) / half;
    return 2 * s * sinc * std::polar(Fine(1), x1 + s * (a + b / 2));
  });
}

TEST(Gradients, TriangleMean) {
  Worst worst;
  const std::vector<double> all = gradients({0.5, 1.0, 2 * pi});
  for (const double x : all)
    for (const double y : all)
      for (const double sign : {1.0, -1.0}) {
        worst.note(triangle_phase_mean(0.0, x, sign * y), triangle_mean(0.0, x, sign * y));
        worst.note(triangle_phase_mean(sign * y, 0.3, x), triangle_mean(sign * y, 0.3, x));
      }
  expect_stable({"phase gradients 1e-300 ... 1e3, both sides of each switch, against quadrature in long double",
                 "mean of e^{jx} over a triangle", worst.error, 1e-14, "its own bound, some ten roundings"});
}

// Barycentric products over a triangle; l2 and l3 grow from 0 at the first corner.
FineComplex moment(const std::array<double, 3>& x, int i, int j) {
  const Fine a = Fine(x[1]) - x[0], b = Fine(x[2]) - x[1];
  return fine_integral(std::abs(a) + std::abs(b), [&](Fine s) {
    return fine_integral(s * std::abs(b), [&](Fine t) {
      const std::array<Fine, 3> l{1 - s, s * (1 - t), s * t};
      return 2 * s * l[i] * l[j] * std::polar(Fine(1), x[0] + s * (a + t * b));
    });
  });
}

TEST(Gradients, TriangleMoments) {
  Worst worst;
  std::vector<double> all = gradients({0.75, 1.5, 3.0}, 1);
  if (all.size() > 40)
    for (std::size_t i = 0; 2 * i < all.size(); ++i) all[i] = all[2 * i];
  all.resize(std::min<std::size_t>(all.size(), size_of_run(30, 80)));
  const std::pair<int, int> places[] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
  for (const double x : all)
    for (const double y : all)
      for (int m = 0; m < 6; m += size_of_run(2, 1)) {
        const std::array<double, 3> corners{0.0, x, y == x ? -y : y};
        worst.note(triangle_moments(corners)[m], moment(corners, places[m].first, places[m].second));
      }
  expect_stable(
      {"the same, 1e-300 ... 10", "moments of e^{jx} over a triangle (spherical waves)", worst.error, 1e-14, "its own bound"});
}

Footprint flat_footprint(double gradient_u, double gradient_v) {
  Footprint f;
  f.area = 1.0;
  f.phase_u = gradient_u;
  f.phase_v = gradient_v;
  f.outgoing.anchor = dvec2(0.0);
  return f;
}

Fine fine_sinc(Fine x) { return x == 0 ? Fine(1) : std::sin(x) / x; }

TEST(Gradients, RectanglesAndPolygons) {
  // A polygon is a fan of triangles; one that is a rectangle has a product of two sinc in closed form.
  Worst rectangles, polygons, fans;
  ConvexPolygon square, cut;
  set_corners(square, std::vector<dvec2>{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}});
  set_corners(cut, std::vector<dvec2>{{-0.5, -0.5}, {0.1, -0.5}, {0.5, -0.5}, {0.5, 0.2}, {0.5, 0.5}, {-0.5, 0.5}});
  const std::vector<double> all = gradients({0.5, 1.0});
  for (const double u : all)
    for (const double v : all) {
      const Footprint f = flat_footprint(u, v);
      const Fine wanted = fine_sinc(Fine(u) / 2) * fine_sinc(Fine(v) / 2);
      rectangles.note(phase_integral(f, 1.0, dvec2(0.0), 1.0, 1.0), wanted);
      const double angle = 1.0 + std::abs(u) + std::abs(v);  // of the first corner, which a double holds to machine / 2
      polygons.note(phase_integral(f, 1.0, square), wanted, angle);
      fans.note(phase_integral(f, 1.0, cut), wanted, angle);
    }
  expect_stable(
      {"the same, 1e-300 ... 1e3", "phase integral over a cell", rectangles.error, 4 * machine, "two sinc, one phasor"});
  expect_stable({"the same, relative to 1 + the phase across it", "over a polygon of 4 or 6 corners",
                 std::max(polygons.error, fans.error), 1e-14, "means over triangles"});
}

TEST(Gradients, FilonWeights) {
  // j_n by quadrature of Poisson's integral: 2 j^n j_n(x) = integral of P_n(t) e^{jxt} over [-1, 1] (Abramowitz &
  // Stegun 10.1.14). Degrees to 7 are exact above the switch at 0.3; below it the Gauss rule leaves 0.3^10 / (10! ...) of
  // degree 7.
  Worst worst;
  const FilonRule& rule = FilonRule::get();
  for (const double theta : gradients({0.3, 7.999999, 8.0, 2 * pi}))
    for (const double sign : {1.0, -1.0}) {
      const Complexes weights = rule.weights(sign * theta);
      for (unsigned degree = 0; degree < lanes; ++degree) {
        Complex found = 0.0;
        for (std::size_t i = 0; i < lanes; ++i) found += weights[i] * std::legendre(degree, rule.at[i]);
        const FineComplex wanted = fine_integral(2 * Fine(theta), [&](Fine t) {
          return Fine(2) * std::legendre(degree, 2 * t - 1) * std::polar(Fine(1), sign * theta * (2 * t - 1));
        });
        worst.note(found, wanted);
      }
    }
  expect_stable({"the same, 1e-300 ... 1e3", "Filon's rule, polynomials to degree 7", worst.error, 5e-13,
                 "2e-13 of its recurrences, 1e-13 of the phase at 1e3"});
}

TEST(Gradients, RemovableQuotients) {
  // erf(z)/x and (W(a) - W(b)) / (a - b) against quadrature: erf(z) = 2z/sqrt(pi) int_0^1 e^{-z^2 t^2} dt and the mean of W' over
  // [a, b], W' = 2jxW - 2 e^{j pi/4} / sqrt(pi), W by the series of the same integral: e^{jx^2} (1 - erf z).
  const auto erf_ratio = [](Fine x) {
    return std::polar(2 / std::sqrt(std::numbers::pi_v<Fine>), std::numbers::pi_v<Fine> / 4) *
           fine_integral(x * x, [&](Fine t) { return std::polar(Fine(1), -x * x * t * t); });
  };
  const auto w = [&](Fine x) { return std::polar(Fine(1), x * x) * (Fine(1) - x * erf_ratio(x)); };
  const auto slope = [&](Fine x) {
    return FineComplex(0, 2 * x) * w(x) - std::polar(2 / std::sqrt(std::numbers::pi_v<Fine>), std::numbers::pi_v<Fine> / 4);
  };
  Worst quotient, difference;
  for (const double x : gradients({0.5}, 1)) {
    Reals at{};
    at[0] = x;
    Complexes decay{};
    decay.set(0, std::polar(1.0, -x * x));
    quotient.note(erf_over(at, scaled_erfc(at), decay)[0], erf_ratio(x));
  }
  for (const double a : {0.0, 0.05, 0.7, 3.0})
    for (const double step : gradients({0.1 / (1 + a)}, 0)) {
      Reals low{}, high{};
      low[0] = a;
      high[0] = a + step;
      const FineComplex wanted = fine_integral(1, [&](Fine t) { return slope(Fine(low[0]) + t * (Fine(high[0]) - low[0])); });
      difference.note(divided_difference(low, high, scaled_erfc(low), scaled_erfc(high))[0], wanted);
    }
  expect_stable({"arguments 1e-300 ... 10, both sides of the switch", "erf(z)/x of a strip", quotient.error, 1e-14,
                 "1e-15 of W over 0.5, where the series ends"});
  expect_stable({"arguments apart by 1e-300 ... 1, both sides of the switch", "(W(a) - W(b))/(a - b) of a strip",
                 difference.error, 1e-13, "1e-15 of W over 0.1 / (1 + a), where the series ends"});
}

// Michaeli's kernels in long double: c_n(x) = (1/n) cot(x/2n) - cot(x/2), by its Bernoulli series near 0 with two terms more than
// the solver has.
FineComplex fine_cotangent(FineComplex z) { return std::cos(z) / std::sin(z); }

FineComplex fine_difference(Fine n, FineComplex x) {
  if (std::abs(x) > 0.05L) return fine_cotangent(x / (2 * n)) / n - fine_cotangent(x / Fine(2));
  const Fine m2 = 1 / (n * n), m4 = m2 * m2, m6 = m4 * m2;
  const FineComplex x2 = x * x;
  return x * ((1 - m2) / 6 + x2 * ((1 - m4) / 360 + x2 * ((1 - m6) / 15120 +
                                                          x2 * ((1 - m4 * m4) / 604800 + x2 * (1 - m4 * m6) / Fine(23950080)))));
}

struct FineKernels {
  FineComplex soft, hard;
};

FineKernels fine_kernels(double n, double source, bool lit, Fine half_cosine) {
  const FineComplex g = half_cosine > 1 ? FineComplex(0, 2 * std::acosh(half_cosine)) : FineComplex(2 * std::acos(half_cosine));
  const auto term = [&](FineComplex x) { return lit ? fine_difference(n, x) : fine_cotangent(x / Fine(2 * n)) / Fine(n); };
  const FineComplex minus = term(g - Fine(source)), plus = term(g + Fine(source));
  return {(minus - plus) / Fine(2), (minus + plus) / (Fine(2) * std::sin(g))};
}

TEST(Gradients, FringeKernels) {
  // The observer passes the pole g = phi', the ends of the series at |g -+ phi'| = 0.02, and g = 0, behind which g is imaginary.
  // A- and A+ add up to nothing as g -> 0, down to 6e-6 (grazing_ray_at); at phi' = 0.02, where the series ends, they are
  // differences of cotangents of 100, whose roundings 1.4e-14 over 2 sin(6e-6) are 2.4e-9 of G_h.
  Worst worst;
  for (const double n : {1.02, 1.25, 1.5, 1.99, 2.0})
    for (const double source : {1e-6, 0.02, 0.7, 1.57, 2.4, 3.1, 3.3, 5.0}) {
      if (source > n * pi - 0.1) continue;
      FaceIncidence incidence;
      incidence.sin_cone = 1.0;
      incidence.lit = source < pi;
      incidence.source_angle = source;
      for (const double centre : {std::cos(source / 2), std::cos((source + 0.02) / 2), std::cos((source - 0.02) / 2),
                                  std::cos(0.01), 1.0, std::cos(3e-6), 0.5, 1e-3, 3.0})
        for (const double step : {0.0, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 0.3})
          for (const double h : {centre - step, centre + step}) {
            if (h < 1e-4) continue;
            const FringeKernels found = fringe_kernels(n, incidence, grazing_ray_at(h));
            // At g = 0 the quotient of the reference is 0/0; it is even in g, so 1e-5 beside it differs by 1e-10.
            const Fine safe = std::abs(h - 1) < 1e-11 ? 1 - 1e-11L : Fine(h);
            const FineKernels wanted = fine_kernels(n, source, incidence.lit, safe);
            const double size = 1 + static_cast<double>(std::abs(wanted.hard) + std::abs(wanted.soft));
            worst.note(found.soft, wanted.soft, size);
            worst.note(found.hard, wanted.hard, size);
          }
    }
  expect_stable({"observer on and 1e-14 ... 0.3 beside poles and switches, against long double", "kernels of fringe currents",
                 worst.error, 4e-9, "cotangents of 100 that cancel down to g = 6e-6"});
}

TEST(Gradients, RowsOfEdgeWaves) {
  // Lengths and phases that hardly change along a row, or change so that one more rule is taken: what eight points leave, 1e-5 of
  // the row (EdgeWaveIntegral.WithoutEnds), is the most that may jump.
  const double k = 2 * pi;
  const EdgeWaveTerms terms = edge_wave_terms(1.5, 0.6, 3.1);
  const EdgeWaveIntegral integral(terms, 0.3, std::sqrt(1 - 0.09), -1.0, 1.0, {-1.0, 1.0});
  const auto at = [&](double path_rate, double phase_rate) {
    return integral.over({-1.5, 1.5, 3.0, path_rate, 0.2, phase_rate}, k).incident.value;
  };
  double worst = 0.0;
  const auto note = [&](Complex a, Complex b, double allowed) {
    const double off = std::abs(a - b) - allowed;
    worst = worse(worst, std::isfinite(off) ? off / 9.0 : std::numeric_limits<double>::infinity());
  };
  for (const double rate : gradients({}, -2)) {
    // Slopes: paths of 3 m, phases of k rate 1.5.
    note(at(rate, 0.0), at(0.0, 0.0), 60 * rate);
    note(at(-rate, 0.0), at(0.0, 0.0), 60 * rate);
    note(at(0.4, rate), at(0.4, 0.0), 60 * rate);
    note(at(0.4, -rate), at(0.4, 0.0), 60 * rate);
  }
  for (double rate = 0.0; rate < 1.99; rate += size_of_run(0.05, 0.001)) note(at(rate + 1e-7, 0.1), at(rate, 0.1), 6e-6);
  expect_stable(
      {"gradients of path and phase 1e-300 ... 0.01, and all steepnesses to 2: jump beyond slope times step, of the row",
       "integral of an edge's waves over a row of rays", worst, 1e-5, "what its rule leaves"});
}

/// A piece 1 m square, 1 m wavelength, seen from the direction that its launch plane faces.
struct CurvedCell {
  dvec2 tilt;
  double curvature;

  // Found, and by a Gauss rule in panels on the same depth.
  std::pair<Complex, FineComplex> values() const {
    const SphericalBasis basis = spherical_basis({0.7, 0.3});
    LaunchGrid grid;
    grid.u_hat = basis.phi_hat, grid.v_hat = -basis.theta_hat, grid.direction = -basis.radial;
    grid.plane_origin = 10.0 * basis.radial;
    const dvec3 normal = glm::normalize(basis.radial + tilt.x * grid.u_hat + tilt.y * grid.v_hat);
    const CurvedPiece piece(grid, {dvec3(0.0), normal, glm::dmat3(-curvature)});
    const std::vector<double> wavenumbers{2 * pi};
    const Illumination light{grid, basis, basis, {{}, wavenumbers}};
    const ScatteringMatrix s = curved_far_field(light, piece, Bounds{dvec2(-0.5), dvec2(0.5)}).front();
    const FineComplex sum = fine_integral(20, [&](Fine x) {
      return fine_integral(20, [&](Fine y) {
        const dvec2 at(static_cast<double>(x) - 0.5, static_cast<double>(y) - 0.5);
        return std::polar(Fine(1), -4 * std::numbers::pi_v<Fine> * Fine(piece.depth(at).depth));
      });
    });
    return {s.vv(), sum * FineComplex(0, -1)};
  }
};

TEST(Gradients, CurvedCells) {
  Worst worst;
  const std::vector<double> all = gradients({}, -1);
  for (const double tilt : all)
    for (const double curvature : {0.0, 1e-300, 1e-17, 1e-9, 1e-3, 0.1}) {
      const auto [found, wanted] = CurvedCell{{tilt, 0.3 * tilt}, curvature}.values();
      worst.note(found, wanted);
      const auto [bent, exactly] = CurvedCell{{0.2, -0.1}, 0.1 * tilt}.values();
      worst.note(bent, exactly);
    }
  expect_stable({"tilt and curvature 1e-300 ... 0.1, against many more points on the same depth",
                 "curved piece of one wavelength", worst.error, 1e-5,
                 "a few 1e-5 of the strongest cell is what its rule is chosen for"});
}

}  // namespace
}  // namespace raytube::testing
