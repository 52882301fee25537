// Targets with a closed form or an exact series, edges off.
#include <gtest/gtest.h>

#include "closed_forms.h"
#include "dihedral_sector.h"
#include "run.h"
#include "shapes.h"

namespace raytube {
namespace {

using namespace raytube::testing;

constexpr double frequency = 3e9;
const double k = wavenumber(frequency);

// theta 45 ... 0 ... 45 degrees through phi = 180, then 0.
std::vector<Direction> plate_cut(int steps) {
  std::vector<Direction> cut;
  for (int i = -steps; i <= steps; ++i) cut.push_back({45.0 * degree * std::abs(i) / steps, i < 0 ? pi : 0.0});
  return cut;
}

// Errors in dB against the closed form, where it is within 40 dB of the peak.
std::vector<double> plate_errors(double turn, double per_wavelength, const std::vector<Direction>& cut) {
  const SweepResult result =
      solve_soup(shapes::plate(1.5, turn), monostatic(cut, frequency), options(EdgeMethod::none, per_wavelength));
  const double peak = std::abs(closed_forms::plate(1.5, k, {0.0, 0.0}));
  std::vector<double> errors;
  for (std::size_t i = 0; i < cut.size(); ++i) {
    const Complex exact = closed_forms::plate(1.5, k, cut[i], turn);
    if (std::abs(exact) < 0.01 * peak) continue;
    errors.push_back(std::abs(dbsm(result.total[i].vv()) - dbsm(exact)));
    errors.push_back(std::abs(dbsm(result.total[i].hh()) - dbsm(exact)));
  }
  return errors;
}

// Error of the look along the normal, which is in the middle of the cut.
double peak_error(const std::vector<double>& errors) { return errors[errors.size() / 2]; }

void print_errors(double per_wavelength, const std::vector<double>& errors) {
  const std::string name = "plate turned 33 deg, " + std::to_string(std::lround(per_wavelength)) + " tubes per wavelength, ";
  measured((name + "peak").c_str(), peak_error(errors), "dB");
  measured((name + "median").c_str(), quantile(errors, 0.5), "dB");
  measured((name + "95th percentile").c_str(), quantile(errors, 0.95), "dB");
  measured((name + "rms").c_str(), rms(errors), "dB");
}

TEST(Plate, FittedGridIsExact) {
  // The grid covers the plate without staircase and every footprint integral is closed, so only rounding is left: k r of
  // 100 rad times 2^-53 relative to a value 40 dB down, 1e-10 dB.
  const double worst = quantile(plate_errors(0.0, 10.0, plate_cut(450)), 1.0);
  measured("plate, 901 looks, largest error", worst, "dB");
  EXPECT_LE(worst, 1e-10);
}

TEST(Plate, TurnedPlateStaircaseIsSmall) {
  // Staircase bound asked of a plate whose edges run across the grid: 0.02 / 0.1 / 1 dB.
  const std::vector<double> errors = plate_errors(33.0 * degree, 10.0, plate_cut(450));
  print_errors(10.0, errors);
  EXPECT_LE(peak_error(errors), 0.02);
  EXPECT_LE(quantile(errors, 0.5), 0.1);
  EXPECT_LE(quantile(errors, 0.95), 1.0);
}

TEST(Plate, TurnedPlateConvergesWithOrder1point4) {
  // A random staircase along a straight edge converges with h^1.5 on average; 1.4 leaves room for the finite number of looks.
  const auto cut = plate_cut(150);
  std::vector<double> errors;
  for (const double per_wavelength : {10.0, 20.0, 40.0}) {
    const std::vector<double> here = plate_errors(33.0 * degree, per_wavelength, cut);
    print_errors(per_wavelength, here);
    errors.push_back(rms(here));
  }
  const double order = std::log(errors.front() / errors.back()) / std::log(4.0);
  measured("plate turned 33 deg, order of the rms error from 10 to 40", order, "");
  EXPECT_GE(order, 1.4);
}

TEST(Sphere, MonostaticMeanAndSpread) {
  // Physical optics of the sphere is 0.022 dB below Mie; facets and the grid may add a little more than that.
  std::vector<Direction> looks;
  for (int i = 0; i < 64; ++i) looks.push_back({std::acos(1.0 - (2 * i + 1) / 64.0), 2.399963 * i});
  const SweepResult result = solve_soup(shapes::icosphere(5), monostatic(looks, frequency), options(EdgeMethod::none));
  const double mie = dbsm(closed_forms::sphere(1.0, k, 0.0).second);
  EXPECT_NEAR(mie, 4.988, 5e-4);
  for (const bool horizontal : {false, true}) {
    std::vector<double> difference;
    for (const ScatteringMatrix& s : result.total) difference.push_back(dbsm(horizontal ? s.hh() : s.vv()) - mie);
    const double mean = std::accumulate(difference.begin(), difference.end(), 0.0) / 64.0;
    for (double& d : difference) d -= mean;
    measured(horizontal ? "sphere, 64 looks, mean HH" : "sphere, 64 looks, mean VV", mie + mean, "dBsm");
    measured(horizontal ? "sphere, 64 looks, deviation HH" : "sphere, 64 looks, deviation VV", rms(difference), "dB");
    EXPECT_NEAR(mean, 0.0, 0.06);
    EXPECT_LE(rms(difference), 0.03);
  }
  EXPECT_EQ(result.statistics.lost_rays, 0u);
}

TEST(Sphere, BistaticAgainstMie) {
  // Physical optics itself differs from Mie by 0.025 dB (E across the plane, to 120 degrees) and 0.33 dB (in it, to 60).
  Sweep sweep{{frequency}, {}, true};
  for (int i = 0; i <= 120; ++i) sweep.looks.push_back({{90.0 * degree, 0.0}, {90.0 * degree, i * degree}});
  const SweepResult result = solve_soup(shapes::icosphere(5), sweep, options(EdgeMethod::none));
  std::vector<double> across, in_plane;
  for (int i = 0; i <= 120; ++i) {
    const auto [h, v] = closed_forms::sphere(1.0, k, i * degree);
    across.push_back(dbsm(result.total[i].vv()) - dbsm(v));
    if (i <= 60) in_plane.push_back(dbsm(result.total[i].hh()) - dbsm(h));
  }
  measured("bistatic sphere, E across the plane, 0 to 120 deg, rms", rms(across), "dB");
  measured("bistatic sphere, E in the plane, 0 to 60 deg, rms", rms(in_plane), "dB");
  EXPECT_LE(rms(across), 0.1);
  EXPECT_LE(rms(in_plane), 0.45);
}

TEST(Sphere, SeriesHasTheRightPhase) {
  // ka = 200: S tends to -(a/2) e^{2jka}; the next term of the asymptotic series is of order 1 / 2ka.
  const Complex s = closed_forms::sphere(1.0, 200.0, 0.0).second, limit = -0.5 * std::polar(1.0, 400.0);
  EXPECT_LE(std::abs(s - limit), 0.5 / 400.0 * 1.1);
  EXPECT_NEAR(std::abs(closed_forms::sphere(1.0, 200.0, 0.0).first - s), 0.0, 1e-9);
}

TEST(Dihedral, Boresight) {
  const SweepResult result =
      solve_soup(shapes::dihedral(1.5, 1.5), monostatic({{90.0 * degree, 45.0 * degree}}, frequency), options(EdgeMethod::none));
  measured("dihedral boresight, VV", dbsm(result.total[0].vv()), "dBsm");
  measured("dihedral boresight, HH", dbsm(result.total[0].hh()), "dBsm");
  measured("dihedral boresight, double bounce alone", dbsm(result.bounces.at(1)[0].vv()), "dBsm");
  // 15 wavelengths to a side: half a cell of staircase along the beam's boundary is 1/300 of the area, 0.03 dB.
  EXPECT_NEAR(dbsm(result.total[0].vv()), 40.988, 0.06);
  EXPECT_NEAR(dbsm(result.total[0].hh()), 41.116, 0.06);
  EXPECT_NEAR(dbsm(result.bounces.at(1)[0].vv()), 41.052, 0.06);
}

TEST(Dihedral, WholeSectorWithPhase) {
  const double error = dihedral_sector_error(1.5, frequency, options(EdgeMethod::none));
  measured("dihedral sector, largest |S - closed form| / peak", error, "");
  EXPECT_LE(error, 0.01);  // half a cell of staircase where the two beams meet, as above
}

TEST(Trihedral, Boresight) {
  const Direction axis{std::acos(1.0 / std::sqrt(3.0)), 45.0 * degree};
  const SweepResult result = solve_soup(shapes::trihedral(1.5), monostatic({axis}, frequency), options(EdgeMethod::none));
  measured("trihedral boresight, triple bounce alone", dbsm(result.bounces.at(2)[0].vv()), "dBsm");
  measured("trihedral boresight, VV", dbsm(result.total[0].vv()), "dBsm");
  measured("trihedral boresight, HH", dbsm(result.total[0].hh()), "dBsm");
  // Triple bounce: 4 pi a^4 / 3 lambda^2 = 33.27 dBsm; with single and double bounces 33.07 (converged grid). Three oblique
  // boundaries at 10 tubes per wavelength leave a few hundredths of a dB.
  EXPECT_NEAR(dbsm(result.bounces.at(2)[0].vv()), 33.27, 0.1);
  EXPECT_NEAR(dbsm(result.total[0].vv()), 33.07, 0.1);
  EXPECT_NEAR(dbsm(result.total[0].hh()), 33.07, 0.1);
}

}  // namespace
}  // namespace raytube
