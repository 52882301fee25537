// Reflection and transmission by plane layers against closed forms. Unless a line says otherwise the limit is 1e-12: rounding of
// phases of up to a thousand radians.
#include "scene/layers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "scene/material.h"

namespace raytube {
namespace {

using Fine = std::complex<long double>;
constexpr Fine j_fine(0.0L, 1.0L);
constexpr double limit = 1e-12, k = 200.0;

std::vector<double> cosines() {
  std::vector<double> all;
  for (const double angle : {0.0, 10.0, 25.0, 40.0, 53.0, 60.0, 70.0, 80.0, 87.0, 89.0, 89.9})
    all.push_back(std::cos(angle * degree));
  return all;
}

const std::vector<Medium> lossy_media = {{{4.0, -0.1}, 1.0},           {{60.0, -40.0}, 1.0},         {{1.0, -50.0}, 1.0},
                                         {{1.0, -2.0}, {1.0, -2.0}},   {{2.5, -0.3}, {1.8, -0.9}},   {{-3.0, -0.2}, 1.0},
                                         {{-1.5, -0.1}, {-1.2, -0.1}}, {{0.3, -0.001}, {1.0, -0.01}}};
const std::vector<Medium> lossless_media = {{2.25, 1.0}, {80.0, 1.0}, {3.0, 2.0},  {1.0, 5.0},
                                            {0.3, 1.0},  {-4.0, 1.0}, {-2.0, -3.0}};

std::vector<Medium> all_media() {
  std::vector<Medium> all = lossy_media;
  all.insert(all.end(), lossless_media.begin(), lossless_media.end());
  return all;
}

void expect_near(Complex value, Fine expected, double tolerance = limit) {
  EXPECT_LE(std::abs(Fine(value) - expected), tolerance) << value << " instead of " << Complex(expected);
}

// k_z / k of a wave that dies away downwards or carries energy there: with eps and mu both negative the phase runs up.
Fine vertical(const Medium& medium, double cosine) {
  const long double c = cosine;
  const Fine q = std::sqrt(Fine(medium.permittivity) * Fine(medium.permeability) - (1.0L - c * c));
  return q.imag() > 0.0L || (q.imag() == 0.0L && medium.permeability.real() < 0.0) ? -q : q;
}

struct Pair {
  Fine te, tm;
};

void expect_near(const SurfaceResponse::Polarised& value, const Pair& expected, double tolerance = limit) {
  expect_near(value.te, expected.te, tolerance);
  expect_near(value.tm, expected.tm, tolerance);
}

// Fresnel (Stratton 1941, section 9.5): of E along the plane, and of H along the plane.
Pair fresnel(const Medium& medium, double cosine) {
  const Fine q = vertical(medium, cosine), mu = medium.permeability, eps = medium.permittivity;
  const long double c = cosine;
  return {(mu * c - q) / (mu * c + q), (eps * c - q) / (eps * c + q)};
}

TEST(Layers, HalfSpaceIsFresnel) {
  for (const Medium& medium : all_media())
    for (const double c : cosines()) {
      SCOPED_TRACE(testing::Message() << medium.permittivity << ' ' << medium.permeability << ' ' << c);
      expect_near(half_space_response(medium, c).reflected, fresnel(medium, c));
      expect_near(half_space_response(medium, c).transmitted, {0.0L, 0.0L}, 0.0);
    }
}

// The same in angles of incidence and refraction (Born & Wolf 1999, section 1.5.2), where their sum is not 90 degrees.
TEST(Layers, HalfSpaceInAngles) {
  for (const Complex eps : {Complex(2.25), Complex(80.0), Complex(4.0, -1.0), Complex(0.98, -0.02)})
    for (const double angle : {5.0, 20.0, 45.0, 60.0, 85.0}) {
      const Fine incident = angle * degree, refracted = std::asin(std::sin(incident) / std::sqrt(Fine(eps)));
      const Pair expected = {-std::sin(incident - refracted) / std::sin(incident + refracted),
                             std::tan(incident - refracted) / std::tan(incident + refracted)};
      expect_near(half_space_response({eps, 1.0}, std::cos(angle * degree)).reflected, expected);
    }
}

TEST(Layers, BrewsterAngles) {
  for (const double ratio : {1.5, 2.25, 9.0, 80.0}) {
    const double c = 1.0 / std::sqrt(1.0 + ratio);  // tan = sqrt(eps), and sqrt(mu) for the other polarisation
    expect_near(half_space_response({ratio, 1.0}, c).reflected.tm, 0.0L);
    expect_near(half_space_response({1.0, ratio}, c).reflected.te, 0.0L);
  }
}

// eps = mu has the impedance of vacuum: nothing comes back from straight down, and nowhere does one polarisation differ.
TEST(Layers, ImpedanceOfVacuum) {
  const Medium medium{{3.0, -2.0}, {3.0, -2.0}};
  expect_near(half_space_response(medium, 1.0).reflected, {0.0L, 0.0L});
  for (const double c : cosines()) {
    const SurfaceResponse r = half_space_response(medium, c);
    EXPECT_EQ(r.reflected.te, r.reflected.tm);
  }
}

// sin > sqrt(eps): all comes back, with the phases of Born & Wolf 1999, equation 1.5.4(60), their n = sqrt(eps).
TEST(Layers, TotalReflection) {
  const double eps = 0.3;
  for (const double c : cosines()) {
    const double s2 = 1.0 - c * c;
    if (s2 < eps) continue;
    const double te = 2.0 * std::atan(std::sqrt(s2 - eps) / c), tm = 2.0 * std::atan(std::sqrt(s2 - eps) / (eps * c));
    const SurfaceResponse r = half_space_response({eps, 1.0}, c);
    expect_near(r.reflected.te, std::polar(1.0, te));
    expect_near(r.reflected.tm, std::polar(1.0, tm));
  }
}

// eps = sin^2 exactly: the wave below travels along the face. With sin(q k d) / q = k d and q = 0 the layer has the matrices
// [1, j mu k d; 0, 1] (TE) and [1, 0; j eps k d, 1] (TM).
TEST(Layers, WaveAlongTheFace) {
  const double c = 0.5;
  const Layer layer{{0.75, 1.0}, 0.01};
  const Fine kd = k * layer.thickness, turn = std::exp(j_fine * kd * 0.5L);
  expect_near(half_space_response(layer.medium, c).reflected, {1.0L, 1.0L}, 0.0);
  const Fine z = j_fine * kd;
  expect_near(coated_response(std::span(&layer, 1), k, c).reflected, {(0.5L * z - 1.0L) / (0.5L * z + 1.0L), 1.0L});
  const SurfaceResponse r = sheet_response(std::span(&layer, 1), k, c);
  const Fine te = 0.5L * j_fine * kd, tm = 0.5L * 0.75L * j_fine * kd;  // z / z_0 and y / y_0, of vacuum at this angle
  expect_near(r.reflected, {te / (2.0L + te) * turn, tm / (2.0L + tm) * turn});
  expect_near(r.transmitted, {2.0L / (2.0L + te) * turn, 2.0L / (2.0L + tm) * turn});
}

// Impedance of the shorted line, z = j Z tan(q k d), Z = mu / q and q / eps.
TEST(Layers, CoatedConductorIsAShortedLine) {
  for (const Medium& medium : all_media())
    for (const double thickness : {1e-12, 1e-6, 1e-4, 0.003, 0.02})
      for (const double cosine : cosines()) {
        SCOPED_TRACE(testing::Message() << medium.permittivity << ' ' << thickness << ' ' << cosine);
        const long double c = cosine;
        const Fine q = vertical(medium, cosine), t = j_fine * std::tan(q * Fine(k * thickness)),
                   te = Fine(medium.permeability) / q * t, tm = q / Fine(medium.permittivity) * t;
        const Layer layer{medium, thickness};
        expect_near(coated_response(std::span(&layer, 1), k, cosine).reflected,
                    {(te * c - 1.0L) / (te * c + 1.0L), (c - tm) / (c + tm)});
      }
}

// Of layers, [A B; C D] for tangential E and eta H: product of [cos, j Z sin; j sin / Z, cos] (Born & Wolf 1999, section 1.6.2).
struct Matrix {
  Fine a = 1.0L, b = 0.0L, c = 0.0L, d = 1.0L;
};

Matrix times(const Matrix& m, const Matrix& n) {
  return {m.a * n.a + m.b * n.c, m.a * n.b + m.b * n.d, m.c * n.a + m.d * n.c, m.c * n.b + m.d * n.d};
}

Matrix matrix(const std::vector<Layer>& layers, bool te, double cosine) {
  Matrix all;
  for (const Layer& layer : layers) {
    const Fine q = vertical(layer.medium, cosine), phase = q * Fine(static_cast<long double>(k) * layer.thickness),
               z = te ? Fine(layer.medium.permeability) / q : q / Fine(layer.medium.permittivity);
    all = times(all, {std::cos(phase), j_fine * z * std::sin(phase), j_fine * std::sin(phase) / z, std::cos(phase)});
  }
  return all;
}

struct Ratios {
  Fine reflected, transmitted;
};

// Of tangential E, phases at the middle.
Ratios of_sheet(const std::vector<Layer>& layers, bool te, double cosine) {
  const Matrix m = matrix(layers, te, cosine);
  const long double z = te ? 1.0L / cosine : cosine;
  const Fine sum = m.a * z + m.b + m.c * z * z + m.d * z;
  long double thickness = 0.0L;
  for (const Layer& layer : layers) thickness += layer.thickness;
  const Fine turn = std::exp(j_fine * static_cast<long double>(k * cosine) * thickness);
  return {(m.a * z + m.b - m.c * z * z - m.d * z) / sum * turn, 2.0L * z / sum * turn};
}

const std::vector<std::vector<Layer>> stacks = {
    {{lossy_media[0], 0.004}},
    {{lossless_media[0], 0.0031}, {lossless_media[1], 0.0007}},
    {{lossy_media[0], 0.002}, {{}, 0.01}, {lossy_media[4], 0.0015}},
    {{lossless_media[2], 0.004}, {lossless_media[4], 0.0013}, {lossless_media[5], 0.0002}, {lossless_media[0], 0.01}},
    {{lossy_media[5], 0.0003}, {lossy_media[6], 0.002}, {lossy_media[7], 0.02}, {lossy_media[1], 0.0005}, {lossy_media[2], 1e-5}},
    {{lossless_media[0], 1e-9}, {lossy_media[3], 1e-8}}};

// Close to the wave along the face, q = 1e-7 at cosine 1/2, the layer is what it is at q = 0, and thick enough to matter.
TEST(Layers, WaveNearlyAlongTheFace) {
  for (const Complex eps : {Complex(0.75 + 1e-14), Complex(0.75 - 1e-14), Complex(0.75, -1e-14), Complex(0.75 + 1e-8)}) {
    const std::vector<Layer> layers = {{{eps, 1.0}, 0.05}};
    const SurfaceResponse r = sheet_response(layers, k, 0.5);
    const Ratios te = of_sheet(layers, true, 0.5), tm = of_sheet(layers, false, 0.5);
    expect_near(r.reflected, {te.reflected, -tm.reflected});
    expect_near(r.transmitted, {te.transmitted, tm.transmitted});
  }
}

TEST(Layers, SheetsAreProductsOfMatrices) {
  for (std::size_t i = 0; i < stacks.size(); ++i)
    for (const double c : cosines()) {
      SCOPED_TRACE(testing::Message() << "stack " << i << ", cosine " << c);
      const SurfaceResponse r = sheet_response(stacks[i], k, c);
      const Ratios te = of_sheet(stacks[i], true, c), tm = of_sheet(stacks[i], false, c);
      expect_near(r.reflected, {te.reflected, -tm.reflected});
      expect_near(r.transmitted, {te.transmitted, tm.transmitted});
    }
}

TEST(Layers, CoatsAreProductsOfMatrices) {
  for (std::size_t i = 0; i < stacks.size(); ++i)
    for (const double cosine : cosines()) {
      SCOPED_TRACE(testing::Message() << "stack " << i << ", cosine " << cosine);
      const Matrix te = matrix(stacks[i], true, cosine), tm = matrix(stacks[i], false, cosine);
      const long double c = cosine;
      expect_near(coated_response(stacks[i], k, cosine).reflected,
                  {(te.b * c - te.d) / (te.b * c + te.d), (tm.d * c - tm.b) / (tm.d * c + tm.b)});
    }
}

// All that goes back and forth in a slab, added up (Airy 1833): r, then (1 - r^2) times a geometric series.
TEST(Layers, SlabIsASumOfEchoes) {
  const double thickness = 0.004;
  for (const Medium& medium : {lossy_media[0], lossy_media[1], lossy_media[4], lossless_media[0]})
    for (const double c : {1.0, 0.8, 0.5, 0.2}) {
      SCOPED_TRACE(testing::Message() << medium.permittivity << ' ' << c);
      const Pair face = fresnel(medium, c);
      const Fine pass = std::exp(-j_fine * vertical(medium, c) * Fine(k * thickness)), turn = std::polar(1.0, k * thickness * c);
      const auto echoes = [&](Fine r) {
        Ratios sum{r, 0.0L};
        Fine wave = (1.0L - r * r) * pass;  // at the far face
        for (int bounce = 0; bounce < 400; ++bounce) {
          sum.transmitted += wave;
          sum.reflected -= wave * r * pass;
          wave *= r * r * pass * pass;
        }
        return Ratios{sum.reflected * turn, sum.transmitted * turn};
      };
      const Ratios te = echoes(face.te), tm = echoes(face.tm);
      const Layer layer{medium, thickness};
      const SurfaceResponse r = sheet_response(std::span(&layer, 1), k, c);
      expect_near(r.reflected, {te.reflected, tm.reflected});
      expect_near(r.transmitted, {te.transmitted, tm.transmitted});
    }
}

TEST(Layers, LosslessSheetsKeepTheEnergy) {
  for (const std::size_t i : {1u, 3u})
    for (const double c : cosines()) {
      const SurfaceResponse r = sheet_response(stacks[i], k, c);
      EXPECT_NEAR(std::norm(r.reflected.te) + std::norm(r.transmitted.te), 1.0, limit) << i << ' ' << c;
      EXPECT_NEAR(std::norm(r.reflected.tm) + std::norm(r.transmitted.tm), 1.0, limit) << i << ' ' << c;
      const SurfaceResponse coated = coated_response(stacks[i], k, c);
      EXPECT_NEAR(std::abs(coated.reflected.te), 1.0, limit) << i << ' ' << c;
      EXPECT_NEAR(std::abs(coated.reflected.tm), 1.0, limit) << i << ' ' << c;
    }
}

TEST(Layers, PassiveOnesMakeNoEnergy) {
  for (const std::vector<Layer>& layers : stacks)
    for (const double c : cosines()) {
      const SurfaceResponse r = sheet_response(layers, k, c);
      EXPECT_LE(std::norm(r.reflected.te) + std::norm(r.transmitted.te), 1.0 + limit);
      EXPECT_LE(std::norm(r.reflected.tm) + std::norm(r.transmitted.tm), 1.0 + limit);
    }
}

// What goes into a half-space: tangential E (TE) or H (TM) is continuous, T = 1 + R, and the power downwards is |T|^2 times
// Re(q / mu) or Re(q / eps), that of vacuum being the cosine.
TEST(Layers, HalfSpaceKeepsTheEnergy) {
  for (const Medium& medium : all_media())
    for (const double c : cosines()) {
      SCOPED_TRACE(testing::Message() << medium.permittivity << ' ' << c);
      const SurfaceResponse::Polarised r = half_space_response(medium, c).reflected;
      const Complex q(vertical(medium, c));
      EXPECT_LE(std::abs(r.te), 1.0 + limit);
      EXPECT_LE(std::abs(r.tm), 1.0 + limit);
      EXPECT_NEAR(std::norm(r.te) + std::norm(1.0 + r.te) * (q / medium.permeability).real() / c, 1.0, limit);
      EXPECT_NEAR(std::norm(r.tm) + std::norm(1.0 + r.tm) * (q / medium.permittivity).real() / c, 1.0, limit);
    }
}

// A gap that the wave cannot travel in, eps = 0.3 beyond its angle of total reflection, lets some through: |T|^2 = 1 / (1 + ((1 +
// x^2) / 2x)^2 sinh^2(|q| k d)), x = |q| / (mu c) or |q| / (eps c).
TEST(Layers, TunnelsThroughAGap) {
  const double eps = 0.3, c = 0.5, q = std::sqrt(0.75 - eps);
  for (const double thickness : {1e-4, 1e-3, 0.01, 0.03}) {
    const Layer gap{{eps, 1.0}, thickness};
    const SurfaceResponse r = sheet_response(std::span(&gap, 1), k, c);
    const auto through = [&](double x) {
      return 1.0 / (1.0 + std::pow((1.0 + x * x) / (2.0 * x) * std::sinh(q * k * thickness), 2));
    };
    EXPECT_NEAR(std::norm(r.transmitted.te), through(q / c), limit) << thickness;
    EXPECT_NEAR(std::norm(r.transmitted.tm), through(q / (eps * c)), limit) << thickness;
  }
}

// Half a wavelength within a lossless slab: it is not there, but for the phase of the slab's thickness, and -1.
TEST(Layers, HalfWaveWindow) {
  const double c = 0.7, q = std::sqrt(4.0 - (1.0 - c * c));
  const Layer window{{4.0, 1.0}, pi / (q * k)};
  const SurfaceResponse r = sheet_response(std::span(&window, 1), k, c);
  const Fine passed = -std::polar(1.0, k * window.thickness * c);
  expect_near(r.reflected, {0.0L, 0.0L});
  expect_near(r.transmitted, {passed, passed});
}

TEST(Layers, VacuumIsNotThere) {
  const std::vector<Layer> layers = {{{}, 0.37}, {{}, 0.0}, {{}, 1.9}};
  for (const double c : cosines()) {
    const SurfaceResponse r = sheet_response(layers, k, c);
    expect_near(r.reflected, {0.0L, 0.0L});
    expect_near(r.transmitted, {1.0L, 1.0L});
    const Fine there_and_back = std::exp(-2.0L * j_fine * Fine(k * 2.27 * c));
    expect_near(coated_response(layers, k, c).reflected, {-there_and_back, there_and_back});
  }
}

// Layers without thickness, and none at all.
TEST(Layers, NoThickness) {
  const std::vector<Layer> none, thin = {{lossy_media[1], 0.0}, {lossless_media[5], 0.0}};
  for (const std::vector<Layer>& layers : {none, thin})
    for (const double c : cosines()) {
      expect_near(coated_response(layers, k, c).reflected, {-1.0L, 1.0L}, 1e-15);
      expect_near(sheet_response(layers, k, c).reflected, {0.0L, 0.0L}, 1e-15);
      expect_near(sheet_response(layers, k, c).transmitted, {1.0L, 1.0L}, 1e-15);
    }
}

// |Im q| k d = 1e4: e^{1e4} does not fit a double. The half-space, as nothing comes back from below.
TEST(Layers, ThickLossyLayersAreHalfSpaces) {
  for (const Medium& medium : lossy_media)
    for (const double c : cosines()) {
      SCOPED_TRACE(testing::Message() << medium.permittivity << ' ' << c);
      const double thickness = 1e4 / (k * -static_cast<double>(vertical(medium, c).imag()));
      const std::vector<Layer> layers = {{medium, thickness}, {lossless_media[1], 0.01}, {medium, thickness}};
      expect_near(coated_response(layers, k, c).reflected, fresnel(medium, c));
      const SurfaceResponse sheet = sheet_response(layers, k, c);
      EXPECT_EQ(sheet.transmitted.te, 0.0);
      EXPECT_EQ(sheet.transmitted.tm, 0.0);
      EXPECT_NEAR(std::abs(sheet.reflected.te), static_cast<double>(std::abs(fresnel(medium, c).te)), limit);
      EXPECT_NEAR(std::abs(sheet.reflected.tm), static_cast<double>(std::abs(fresnel(medium, c).tm)), limit);
    }
}

// A conductivity of 1e20 S/m at 10 GHz. Its impedance relative to vacuum is z = 1 / sqrt(eps), 7e-11 (Leontovich): (z c - 1) / (z
// c
// + 1) and (c - z) / (c + z).
TEST(Layers, GoodConductorIsThePerfectOne) {
  const Complex eps(1.0, -1e20 / (2.0 * pi * 1e10 * 8.8541878128e-12));
  const Fine z = 1.0L / std::sqrt(Fine(eps));
  for (const double cosine : cosines()) {
    const long double c = cosine;
    const Pair expected = {(z * c - 1.0L) / (z * c + 1.0L), (c - z) / (c + z)};
    const Layer foil{{eps, 1.0}, 1e-3};
    expect_near(half_space_response(foil.medium, cosine).reflected, expected);
    expect_near(coated_response(std::span(&foil, 1), k, cosine).reflected, expected);
    expect_near(half_space_response(foil.medium, cosine).reflected, {-1.0L, 1.0L}, 2e-10 / cosine);
    EXPECT_EQ(sheet_response(std::span(&foil, 1), k, cosine).transmitted.te, 0.0);
  }
}

// Waves from behind: the same gets through (reciprocity); what comes back has the same size where nothing is absorbed, and phases
// that add up to that of -T / T* (unitarity).
TEST(Layers, SheetsFromBehind) {
  for (const std::size_t i : {1u, 3u, 4u}) {
    Material material{.name = "sheet", .kind = MaterialKind::sheet, .layers = {stacks[i]}};
    for (const double c : cosines()) {
      SCOPED_TRACE(testing::Message() << i << ' ' << c);
      const SurfaceResponse front = response(material, 0, k, c, false), back = response(material, 0, k, c, true);
      expect_near(back.transmitted, {front.transmitted.te, front.transmitted.tm});
      if (i == 4u) continue;  // absorbs
      expect_near(back.reflected.te * std::conj(front.transmitted.te), -std::conj(front.reflected.te) * front.transmitted.te);
      expect_near(back.reflected.tm * std::conj(front.transmitted.tm), -std::conj(front.reflected.tm) * front.transmitted.tm);
    }
  }
}

constexpr double eta = 376.730313668;
constexpr double infinite = std::numeric_limits<double>::infinity();

// Shunt R, and series 1 / G, in lines of the wave impedances eta / c (TE) and eta c (TM). R_TM is that of H.
TEST(Layers, ThinSheetsAreCircuits) {
  for (const double resistance : {0.0, 1.0, 188.0, 5000.0, infinite})
    for (const double c : cosines()) {
      const SurfaceResponse r = thin_sheet_response(resistance, infinite, c);
      const auto shunt = [&](double line) { return -line / (line + 2.0 * resistance); };
      expect_near(r.reflected, {shunt(eta / c), -shunt(eta * c)});
      expect_near(r.transmitted, {1.0 + shunt(eta / c), 1.0 + shunt(eta * c)});
      const double conductance = resistance / (eta * eta);  // the dual sheet: E and eta H, TE and TM change places
      const SurfaceResponse dual = thin_sheet_response(infinite, conductance, c);
      expect_near(dual.reflected, {-shunt(eta * c), shunt(eta / c)});
      expect_near(dual.transmitted, {1.0 + shunt(eta * c), 1.0 + shunt(eta / c)});
    }
}

// Both currents with R = eta / 2 and G = 1 / (2 eta), straight down: what each sends to either side adds up to the whole wave
// behind and to nothing in front. Neither current: no sheet. No resistance: a perfect conductor.
TEST(Layers, ThinSheetsOfBothCurrents) {
  expect_near(thin_sheet_response(eta / 2.0, 0.5 / eta, 1.0).reflected, {0.0L, 0.0L});
  expect_near(thin_sheet_response(eta / 2.0, 0.5 / eta, 1.0).transmitted, {0.0L, 0.0L});
  for (const double c : cosines()) {
    expect_near(thin_sheet_response(infinite, infinite, c).reflected, {0.0L, 0.0L}, 0.0);
    expect_near(thin_sheet_response(infinite, infinite, c).transmitted, {1.0L, 1.0L}, 0.0);
    expect_near(thin_sheet_response(0.0, infinite, c).reflected, {-1.0L, 1.0L}, 0.0);
    expect_near(thin_sheet_response(0.0, infinite, c).transmitted, {0.0L, 0.0L}, 0.0);
    for (const double resistance : {1.0, 300.0})
      for (const double conductance : {1e-4, 0.1}) {
        const SurfaceResponse r = thin_sheet_response(resistance, conductance, c);
        EXPECT_LE(std::norm(r.reflected.te) + std::norm(r.transmitted.te), 1.0);
        EXPECT_LE(std::norm(r.reflected.tm) + std::norm(r.transmitted.tm), 1.0);
      }
  }
}

// A film of k d eps'' = eta / R, and one of k d mu'' = 1 / (eta G). What a film of thickness d has besides is of order k d / c,
// with its displacement current and the currents across it: k d is 1e-9, c down to 0.0017.
TEST(Layers, ThinSheetsAreThinFilms) {
  const double kd = 1e-9, resistance = 250.0, conductance = 0.001;
  const Layer electric{{Complex(1.0, -eta / resistance / kd), 1.0}, kd / k},
      magnetic{{1.0, Complex(1.0, -1.0 / (eta * conductance) / kd)}, kd / k};
  const auto alike = [&](const Layer& film, const SurfaceResponse& thin, double c) {
    const SurfaceResponse r = sheet_response(std::span(&film, 1), k, c);
    expect_near(r.reflected, {thin.reflected.te, thin.reflected.tm}, 10.0 * kd / c);
    expect_near(r.transmitted, {thin.transmitted.te, thin.transmitted.tm}, 10.0 * kd / c);
  };
  for (const double c : cosines()) {
    alike(electric, thin_sheet_response(resistance, infinite, c), c);
    alike(magnetic, thin_sheet_response(infinite, conductance, c), c);
  }
}

// One definition of phase for all: what a material does does not depend on how it is cut into layers.
TEST(Layers, CutLayersAreTheWhole) {
  const std::vector<Layer> whole = {{lossy_media[4], 0.01}};
  const std::vector<Layer> cut = {{lossy_media[4], 0.0013}, {lossy_media[4], 0.0}, {lossy_media[4], 0.0087}};
  for (const double c : cosines()) {
    const SurfaceResponse one = sheet_response(whole, k, c), three = sheet_response(cut, k, c);
    expect_near(three.reflected, {one.reflected.te, one.reflected.tm});
    expect_near(three.transmitted, {one.transmitted.te, one.transmitted.tm});
    const SurfaceResponse coat = coated_response(whole, k, c), coats = coated_response(cut, k, c);
    expect_near(coats.reflected, {coat.reflected.te, coat.reflected.tm});
  }
}

TEST(Layers, KindsOfMaterial) {
  const double c = 0.6;
  const auto of_kind = [&](MaterialKind kind) {
    Material material{.name = "any", .kind = kind, .layers = {{}, stacks[2]}};  // those of the second frequency
    material.resistance = 100.0;
    return response(material, 1, k, c, false);
  };
  expect_near(of_kind(MaterialKind::conductor).reflected, {-1.0L, 1.0L}, 0.0);
  expect_near(of_kind(MaterialKind::absorber).reflected, {0.0L, 0.0L}, 0.0);
  EXPECT_EQ(of_kind(MaterialKind::half_space).reflected.te, half_space_response(stacks[2].front().medium, c).reflected.te);
  EXPECT_EQ(of_kind(MaterialKind::coated).reflected.tm, coated_response(stacks[2], k, c).reflected.tm);
  EXPECT_EQ(of_kind(MaterialKind::sheet).transmitted.te, sheet_response(stacks[2], k, c).transmitted.te);
  EXPECT_EQ(of_kind(MaterialKind::thin_sheet).reflected.te, thin_sheet_response(100.0, infinite, c).reflected.te);
}

// Heights of a Gaussian distribution: the mean of e^{2 j k h cos} over them (Ament 1953), here by the sum over the distribution,
// which at a step of a tenth of its width is exact to rounding. What goes through a sheet keeps its size.
TEST(Layers, RoughnessIsTheMeanOverHeights) {
  Material material{.name = "rough", .kind = MaterialKind::sheet, .layers = {stacks[2]}};
  for (const double c : cosines()) {
    const SurfaceResponse smooth = response(material, 0, k, c, false);
    material.roughness = 0.002;
    Complex mean = 0.0;
    for (int i = -100; i <= 100; ++i)
      mean += std::polar(0.1 / std::sqrt(2.0 * pi) * std::exp(-0.005 * i * i), 2.0 * k * 0.1 * i * material.roughness * c);
    const SurfaceResponse rough = response(material, 0, k, c, false);
    material.roughness = 0.0;
    expect_near(rough.reflected, {smooth.reflected.te * mean, smooth.reflected.tm * mean});
    expect_near(rough.transmitted, {smooth.transmitted.te, smooth.transmitted.tm}, 0.0);
  }
}

}  // namespace
}  // namespace raytube
