// Integrals of edge waves over rows of rays against many Gauss points.
#include <gtest/gtest.h>

#include "math/erfc_ray.h"
#include "math/gauss.h"
#include "run.h"
#include "utd/wedge/edge_wave_integral.h"

namespace raytube {
namespace {

using testing::measured;

constexpr double k = 2 * pi;  // wavelength 1 m
constexpr double none = std::numeric_limits<double>::infinity();

/// An edge's lit piece, its cone and the row of rays that is met.
struct Example {
  double cos_cone;
  RayRow row;
  double from = -1e3, to = 1e3;
  std::array<double, 2> corners = {-none, none};

  double sin_cone() const { return std::sqrt(1 - cos_cone * cos_cone); }
};

/// Value and slopes of one wave with distance and azimuth, by the formulas of edge_wave.h and W' = 2jxW - 2 e^{j pi/4}/sqrt(pi).
struct Wave {
  Complex value, outwards, around;
};

Wave wave(const EdgeWaveTerm& term, double path, double sin_cone) {
  const double root = sin_cone * std::sqrt(k * path), x = term.rate * root;
  const Complex w = scaled_erfc(x), slope = Complex(0, 2 * x) * w - 2.0 / std::sqrt(pi) * std::polar(1.0, pi / 4);
  return {term.strength * w, term.strength * slope * x / 2.0,
          term.strength * term.rate_slope * root * slope + term.strength_slope * w};
}

/// What is left of a wave beside the ends of its edge: per end a step plus Fresnel's diffraction of it times a share.
double detour(const Example& example, double z, double corner, double path) {
  const double beyond = z - corner;
  const double via = std::hypot(beyond + path * example.cos_cone, path * example.sin_cone());
  return k * std::max(via - path - example.cos_cone * beyond, 0.0);
}

// Of the wave's value with its share of the corner's, of its slopes with the square of that.
Complex factor(const Example& example, double z, double path, double z2, int power) {
  const bool inside = example.from < z && z < example.to;
  Complex sum = inside ? 1.0 : 0.0;
  for (int end = 0; end < 2; ++end) {
    const double corner = example.corners[end];
    if (std::isinf(corner)) continue;
    const double x2 = detour(example, z, corner, path);
    const bool within = end == 0 ? z > corner : z < corner;
    const Complex step =
        std::polar(0.5, -x2) * scaled_erfc(std::sqrt(x2)) * std::pow(z2 + x2 > 0.0 ? z2 / (z2 + x2) : 1.0, power);
    sum += within ? -step : step;
  }
  return sum;
}

WaveSums by_points(const Example& example, const std::array<EdgeWaveTerm, 2>& terms, int each) {
  const RayRow& row = example.row;
  std::vector<double> cuts = {row.from, row.to};
  for (const double end : {example.from, example.to})
    if (end > row.from && end < row.to) cuts.push_back(end);
  std::ranges::sort(cuts);
  WaveSums sum;
  for (std::size_t c = 1; c < cuts.size(); ++c) {
    // Panels that shrink towards both ends: there waves change with the root of the distance, and corners with theirs.
    std::vector<double> panels = {0.5};
    for (double width = 0.5; width > 1e-7; width /= 2) panels.push_back(width / 2);
    panels.push_back(0.0);
    for (std::size_t i = 1; i < panels.size(); ++i)
      for (const bool mirrored : {false, true})
        for (int part = 0; part < 8; ++part)
          for (const GaussPoint& point : gauss_rule(24)) {
            const double width = (panels[i - 1] - panels[i]) / 8, u = panels[i] + width * (part + point.node);
            const double length = cuts[c] - cuts[c - 1], z = mirrored ? cuts[c] - u * length : cuts[c - 1] + u * length;
            const double path = row.path + row.path_rate * z;
            const Complex phase = std::polar(point.weight * width * length, k * (row.phase + row.phase_rate * z));
            for (int t = 0; t < each; ++t) {
              const double x = terms[t].rate * example.sin_cone() * std::sqrt(k * path);
              const Wave here = wave(terms[t], path, example.sin_cone());
              const Complex weight = phase * factor(example, z, path, x * x, 2);
              sum.value += path * phase * factor(example, z, path, x * x, 1) * here.value;
              sum.outwards += weight * here.outwards / example.sin_cone();
              sum.around += weight * here.around / example.sin_cone();
            }
          }
  }
  return sum;
}

/// The largest difference of the two, relative to the row's length times its waves.
double error(const Example& example, double n, double source, double azimuth) {
  const EdgeWaveTerms terms = edge_wave_terms(n, source, azimuth);
  const EdgeWaveIntegral integral(terms, example.cos_cone, example.sin_cone(), example.from, example.to, example.corners);
  const WaveIntegrals found = integral.over(example.row, k);
  const RayRow& row = example.row;
  const double longest = std::max(row.path + row.path_rate * row.from, row.path + row.path_rate * row.to);
  const double size = (row.to - row.from) * std::max(longest, 1.0);
  double worst = 0.0;
  for (const auto& [set, sums] : {std::pair{&terms.incident, &found.incident}, std::pair{&terms.reflected, &found.reflected}}) {
    const WaveSums wanted = by_points(example, *set, terms.each), off = *sums - wanted;
    worst = std::max({worst, std::abs(off.value), std::abs(off.outwards), std::abs(off.around)});
  }
  return worst / size;
}

struct Angles {
  double n, source, azimuth;
};
const Angles angles[] = {{2, 0.8, 1.9},   {2, 0.8, 0.8 + pi - 1e-3}, {2, 2.2, 5.0},
                         {1.5, 0.6, 3.1}, {1.5, 2.0, 1.2},           {1.25, 1.0, 2.14}};

TEST(EdgeWaveIntegral, WithoutEnds) {
  // Eight points take in distances up to a ratio of eight: Legendre series of roots that end with some 1e-6.
  const Example examples[] = {{0.0, {-1, 2, 3, 0, 0.2, 0.0}},       // side by side, at one distance
                              {0.3, {-1, 2, 3, 0.8, 0.2, 1.7}},     // slanting
                              {-0.4, {0, 2.5, 0, 1.2, 0.0, -0.6}},  // from the edge itself
                              {0.1, {0, 3, 1e-6, 2.0, 0.0, 40.0}},  // from close to it, fast
                              {0.2, {-2, 2, 30, -9, 1.0, 0.7}}};    // far
  double worst = 0.0;
  for (const Example& example : examples)
    for (const auto& [n, source, azimuth] : angles) {
      const double off = error(example, n, source, azimuth);
      worst = std::max(worst, off);
      EXPECT_LE(off, 1e-5) << n << ' ' << source << ' ' << azimuth << ", path " << example.row.path;
    }
  measured("integral of an edge wave, no ends", worst, "of the row");
}

TEST(EdgeWaveIntegral, BesideTheEnds) {
  double worst = 0.0;
  // Rows within sqrt(k detour) < 2 of the end, where waves have not begun to be let fade (at 4 they are nothing).
  for (const double cone : {0.0, 0.35, -0.5})
    for (const RayRow& row :
         {RayRow{0.4, 1.6, 3, 0, 0.2, 0.3}, RayRow{0.5, 1.5, 2, 0.9, 0.2, -1.1}, RayRow{1.02, 1.6, 2, 0.4, 0.1, 0.5}})
      for (const bool last : {false, true})
        for (const auto& [n, source, azimuth] : angles) {
          Example example{cone, row};
          (last ? example.to : example.from) = 1.0;
          example.corners[last] = 1.0;
          double farthest = 0.0;
          for (const double z : {row.from, row.to})
            farthest = std::max(farthest, detour(example, z, 1.0, row.path + row.path_rate * z));
          ASSERT_LE(std::sqrt(farthest), 2.0);
          const double off = error(example, n, source, azimuth);
          worst = std::max(worst, off);
          EXPECT_LE(off, 2e-3) << cone << ' ' << row.path << ' ' << last << ' ' << n << ' ' << azimuth;
        }
  measured("integral of an edge wave beside an end", worst, "of the row");
}

TEST(EdgeWaveIntegral, OfARowIsThatOfItsParts) {
  // So that it does not show into how many faces a surface is cut; far beyond the end too, where waves are let fade.
  double worst = 0.0;
  for (const double cone : {0.0, 0.35, -0.5})
    for (const RayRow& row : {RayRow{-4, 6, 3, 0, 0.2, 0.3}, RayRow{-2, 5, 2, 0.9, 0.2, -1.1}, RayRow{0.2, 6, 4, -0.3, 0.1, 0.9}})
      for (const auto& [n, source, azimuth] : angles) {
        const EdgeWaveTerms terms = edge_wave_terms(n, source, azimuth);
        const EdgeWaveIntegral integral(terms, cone, std::sqrt(1 - cone * cone), 1.0, 3.5, {1.0, 3.5});
        const WaveIntegrals whole = integral.over(row, k);
        WaveIntegrals sum;
        const int parts = 7;
        for (int i = 0; i < parts; ++i) {
          RayRow part = row;
          part.from = row.from + (row.to - row.from) * i / parts;
          part.to = row.from + (row.to - row.from) * (i + 1) / parts;
          const WaveIntegrals here = integral.over(part, k);
          sum.incident += here.incident;
          sum.reflected += here.reflected;
        }
        const double size =
            (row.to - row.from) * std::max(row.path + row.path_rate * row.from, row.path + row.path_rate * row.to);
        worst = std::max({worst, std::abs(whole.incident.value - sum.incident.value) / size,
                          std::abs(whole.reflected.value - sum.reflected.value) / size});
      }
  measured("integral of an edge wave, whole against parts", worst, "of the row");
  EXPECT_LE(worst, 3e-3);  // eight points for all that fades beside an end, over a detour of sixteen radians
}

TEST(EdgeWaveIntegral, DoesNotJumpAtAnEnd) {
  // A row of 1e-5 wavelengths before the end, across it, and behind it: the same share per length, but for Fresnel's slope, some
  // sqrt(k / path) per wavelength.
  const double width = 1e-5;
  for (const auto& [n, source, azimuth] : angles) {
    const EdgeWaveTerms terms = edge_wave_terms(n, source, azimuth);
    const EdgeWaveIntegral integral(terms, 0.3, std::sqrt(1 - 0.09), 1.0, 5.0, {1.0, none});
    const auto at = [&](double from) {
      return integral.over({from, from + width, 3.0, 0.4, 0.1, 0.6}, k).incident.value / width;
    };
    const Complex behind = at(1.0 - 2 * width), across = at(1.0 - width / 2), before = at(1.0 + width);
    const Complex whole = EdgeWaveIntegral(terms, 0.3, std::sqrt(1 - 0.09), 0.0, 5.0, {-none, none})
                              .over({1.0, 1.0 + width, 3.0, 0.4, 0.1, 0.6}, k)
                              .incident.value /
                          width;
    EXPECT_NEAR(std::abs(before - across), 0.0, 1e-3 * std::abs(whole));
    EXPECT_NEAR(std::abs(behind - across), 0.0, 1e-3 * std::abs(whole));
    EXPECT_NEAR(std::abs(across - 0.5 * whole), 0.0, 1e-3 * std::abs(whole));  // half of it on the end
  }
}

}  // namespace
}  // namespace raytube
