// Range profiles and images of pieces, of one look at one frequency, against those of the sweep.
#include <gtest/gtest.h>

#include <numeric>
#include <tuple>

#include "imaging/centres.h"
#include "imaging/direct.h"
#include "plan/mechanism.h"
#include "run.h"
#include "shapes.h"
#include "solve/pieces.h"

namespace raytube {
namespace {

using namespace raytube::testing;

// Faces of 0.3 m on +x and +y, the fold is z.
TriangleMesh dihedral() { return build_mesh(shapes::dihedral(0.3, 0.3), 1.0).mesh; }

struct Aperture {
  EvenAxis frequency;
  AngleGrid grid;
  Sweep sweep;
  SweepSamples samples;
};

Aperture aperture(const EvenAxis& frequency, const EvenAxis& phi_deg, double theta_deg = 90.0) {
  Aperture result{
      frequency, {{theta_deg, 0.0, 1}, phi_deg, std::vector<std::size_t>(phi_deg.count)}, {}, {.frequency = frequency}};
  std::iota(result.grid.looks.begin(), result.grid.looks.end(), std::size_t{0});
  std::vector<Direction> directions;
  for (std::size_t i = 0; i < phi_deg.count; ++i) {
    directions.push_back({theta_deg * degree, phi_deg.at(i) * degree});
    const dvec3 direction = spherical_basis(directions.back()).radial;
    constexpr double far = std::numeric_limits<double>::infinity();
    result.samples.looks.push_back({direction, direction, far, far});
  }
  result.sweep = monostatic(directions, frequency.first);
  result.sweep.frequencies.clear();
  for (std::size_t f = 0; f < frequency.count; ++f) result.sweep.frequencies.push_back(frequency.at(f));
  return result;
}

double correlation(const std::vector<ScatteringMatrix>& a, const std::vector<ScatteringMatrix>& b, int p) {
  Complex product = 0.0;
  double of_a = 0.0, of_b = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    product += std::conj(a[i].at(p, p)) * b[i].at(p, p);
    of_a += std::norm(a[i].at(p, p)), of_b += std::norm(b[i].at(p, p));
  }
  return std::abs(product) / std::sqrt(of_a * of_b);
}

// Each look at the middle frequency: pieces lose nothing. First and later bounces, edges and what they start; rims as half
// planes, with the currents of their thickness; strips over the jacket of a cylinder, what runs on into its dark side, and what
// either starts at its rims.
TEST(Pieces, AddUpToS) {
  SolveOptions o;
  o.surfaces.waves = true;
  for (const PolygonSoup& soup : {shapes::dihedral(0.3, 0.3), shapes::box({0.2, 0.15, 5e-4}), shapes::cylinder(0.05, 0.1, 72)}) {
    const Target target(build_mesh(soup, 1.0).mesh);
    const Aperture of = aperture({10e9, 0.0, 1}, {20.0, 12.5, 3}, 70.0);
    const SweepResult result = solve(target, of.sweep, o);
    for (std::size_t look = 0; look < 3; ++look) {
      ScatteringMatrix sum;
      scattering_pieces(target, of.sweep, look, 10e9, o, 0.02, [&](const ScatteringPiece& piece) { sum += piece.s; });
      EXPECT_LT(largest_amplitude(sum - result.total[look]), 1e-9 * largest_amplitude(result.total[look]));
    }
  }
}

// A band of 2 GHz and 8 degrees. Bounces once: at the plates' sides; twice: at the fold. Seen across the fold, and well off that,
// where edges that light the other plate, and its rims, prevail (told at the edges where they began they made 0.7). What is left
// is the change of S with angle of what is not small.
TEST(DirectImage, OfADihedralIsThatOfTheSweep) {
  const Target target(dihedral());
  for (const auto& [theta, phi, least] : {std::tuple(90.0, 26.0, 0.995), std::tuple(60.0, 36.0, 0.98)}) {
    const Aperture of = aperture({9e9, 100e6, 21}, {phi, 0.5, 17}, theta);
    SweepSamples swept = of.samples;
    swept.s = solve(target, of.sweep, {}).total;
    const IsarOptions image_options{{}, {{1.0, 0.8, 0.0}}, 3.0};
    DirectImage direct(of.samples, of.grid);
    scattering_pieces(target, of.sweep, middle_index(17), of.frequency.at(middle_index(21)), {}, 0.015,
                      [&](const ScatteringPiece& piece) {
                        direct.add({piece.place, piece.s, piece.mechanism < tube_pieces.size()});
                      });
    const IsarImage a = direct.image(image_options, ""), b = isar_image(swept, of.grid, image_options, "");
    for (const int p : {0, 1}) EXPECT_GT(correlation(a.s, b.s, p), least) << "theta " << theta << ", channel " << p;
  }
}

// The profile of one look needs no other angle: nothing but the cut into pieces is left at order 1. At order 3 what runs over the
// plate to further edges is most of S (told at the edge where it began it made 0.3 of the correlation): its amplitudes fall with
// k^(-1/2) for each strip that it takes, which pieces leave out.
TEST(DirectSweep, OfATiltedPlateIsTheSweep) {
  const Target target(build_mesh(shapes::plate(0.7), 1.0).mesh);
  const Aperture of = aperture({9e9, 100e6, 21}, {30.0, 0.0, 1}, 55.0);
  for (const auto& [order, least] : {std::pair(1, 0.999), std::pair(3, 0.995)}) {
    SolveOptions o;
    o.edges.order = order;
    const SweepResult swept = solve(target, of.sweep, o);
    DirectSweep direct(of.frequency, spherical_basis(of.sweep.looks.front().transmit).radial);
    scattering_pieces(target, of.sweep, 0, of.frequency.at(middle_index(21)), o, 0.02, [&](const ScatteringPiece& piece) {
      direct.add({piece.place, piece.s, piece.mechanism < tube_pieces.size()});
    });
    const std::vector<ScatteringMatrix> s = direct.scattering();
    for (const int p : {0, 1}) EXPECT_GT(correlation(s, swept.total, p), least) << "order " << order << ", channel " << p;
  }
}

// What physical optics lacks on a sphere, the wave that has crept round it among it: half of the way round behind its middle,
// where no surface is (told where its currents are: 0.4). It fades the faster the higher the frequency, which pieces leave out.
TEST(DirectSweep, OfAWaveRoundASphereHasItsPath) {
  const Target target(build_mesh(shapes::icosphere(4, 0.05), 1.0).mesh);
  const Aperture of = aperture({8e9, 200e6, 21}, {30.0, 0.0, 1}, 55.0);
  SolveOptions with, without;
  with.surfaces.waves = true, without.surfaces.waves = false;
  std::vector<ScatteringMatrix> swept = solve(target, of.sweep, with).total;
  const std::vector<ScatteringMatrix> bare = solve(target, of.sweep, without).total;
  for (std::size_t f = 0; f < swept.size(); ++f) swept[f] = swept[f] - bare[f];
  DirectSweep direct(of.frequency, spherical_basis(of.sweep.looks.front().transmit).radial);
  scattering_pieces(target, of.sweep, 0, of.frequency.at(middle_index(21)), with, 0.02, [&](const ScatteringPiece& piece) {
    if (piece_names(mechanism_list())[piece.mechanism] == "surface_waves") direct.add({piece.place, piece.s, false});
  });
  for (const int p : {0, 1}) EXPECT_GT(correlation(direct.scattering(), swept, p), 0.96);
}

// A trihedral of 0.4 m, seen along its axis: the triple bounce is at its apex, with the level of all of it, 4 pi a^4 / 3 lambda^2
// of leg a; nothing else comes within 30 dB. The rest adds what is missing.
TEST(ScatteringCentres, OfATrihedralIsItsApex) {
  constexpr double leg = 0.4, frequency = 10e9;
  const Target target(build_mesh(shapes::trihedral(leg), 1.0).mesh);
  Aperture of = aperture({frequency, 0.0, 1}, {45.0, 0.0, 1});
  of.sweep.looks.front().transmit.theta = of.sweep.looks.front().receive.theta = std::acos(1.0 / std::sqrt(3.0));
  std::vector<ScatteringPiece> pieces;
  ScatteringMatrix s;
  scattering_pieces(target, of.sweep, 0, frequency, {}, 0.015, [&](const ScatteringPiece& piece) {
    pieces.push_back(piece);
    s += piece.s;
  });
  const SphericalBasis basis = spherical_basis(of.sweep.looks.front().transmit);
  const ScatteringCentres found = scattering_centres(pieces, {-basis.radial, basis.phi_hat, -basis.theta_hat},
                                                     {20, 0.06, wavelength(frequency), piece_names(mechanism_list())});
  const ScatteringCentre& first = found.centres.front();
  EXPECT_LT(glm::length(first.place), 0.1 * 0.06);
  EXPECT_EQ(first.mechanism(), 2u);  // later bounces
  const double level = 4.0 * pi * std::pow(leg, 4) / (3.0 * wavelength(frequency) * wavelength(frequency));
  EXPECT_NEAR(dbsm(first.s.vv()), 10.0 * std::log10(level), 0.3);
  EXPECT_LT(dbsm(found.centres[1].s.vv()), dbsm(first.s.vv()) - 30.0);
  ScatteringMatrix sum = found.rest;
  for (const ScatteringCentre& centre : found.centres) sum += centre.s;
  EXPECT_LT(largest_amplitude(sum - s), 1e-12 * largest_amplitude(s));
}

TEST(Pieces, WhatHasNoPiecesIsRefused) {
  const Target target(build_mesh(shapes::plate(0.1), 1.0).mesh);
  const Aperture of = aperture({10e9, 0.0, 1}, {0.0, 0.0, 1});
  Sweep bistatic = of.sweep;
  bistatic.bistatic = true;
  EXPECT_THROW(scattering_pieces(target, bistatic, 0, 10e9, {}, 0.1, [](const ScatteringPiece&) {}), InputError);
  SolveOptions rays;
  rays.edges.method = EdgeMethod::utd;
  EXPECT_THROW(scattering_pieces(target, of.sweep, 0, 10e9, rays, 0.1, [](const ScatteringPiece&) {}), InputError);
}

}  // namespace
}  // namespace raytube
