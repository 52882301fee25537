// One mesh from 1 MHz to 1 THz.
#include "closed_forms.h"
#include "stress/description.h"
#include "stress/stability.h"

namespace raytube::testing {
namespace {

std::vector<double> frequencies(double lowest, double highest, int per_decade) {
  std::vector<double> result;
  const int steps = static_cast<int>(std::round(per_decade * std::log10(highest / lowest)));
  for (int i = 0; i <= steps; ++i) result.push_back(lowest * std::pow(10.0, static_cast<double>(i) / per_decade));
  return result;
}

const double plate_side = 0.1, plate_turn = 0.3;

std::vector<Direction> plate_looks() {
  std::vector<Direction> cut;
  for (int i = 0; i <= 20; ++i) cut.push_back({4.1 * i * degree, 0.4});
  return cut;
}

// |S - physical optics| by the peak of the cut, each frequency by itself: a sweep of many would be another path of the program.
double plate_error(double frequency, const SolveOptions& o) {
  const double k = wavenumber(frequency);
  const std::vector<Direction> cut = plate_looks();
  const SweepResult result = solve_soup(shapes::plate(plate_side, plate_turn), monostatic(cut, frequency), o);
  double worst = 0.0;
  for (std::size_t i = 0; i < cut.size(); ++i) {
    const Complex exact = closed_forms::plate(plate_side, k, cut[i], plate_turn);
    worst = std::max({worst, std::abs(result.total[i].vv() - exact), std::abs(result.total[i].hh() - exact)});
  }
  return worst / (plate_side * plate_side / wavelength(frequency));
}

TEST(Frequency, PlateIsPhysicalOptics) {
  // Phases of 2 k R sin(theta), 3000 rad at 1 THz, are rounded to 2^-53 of that, a few times.
  double worst = 0.0;
  for (const double f : frequencies(1e6, 1e12, size_of_run(4, 40)))
    worst = worse(worst, plate_error(f, tubes_and_edges(TubeMode::adaptive, 0, false).options));
  expect_stable({"1 MHz to 1 THz, against the closed form; adaptive, no edges", "plate of 0.1 m", worst, 3e-12,
                 "2 k R = 3000 rad, rounded to 1e-16 of that a few times"});
}

TEST(Frequency, SpecularReturnGrowsWithItsSquare) {
  double worst = 0.0;
  for (const double f : frequencies(1e6, 1e12, size_of_run(4, 40))) {
    SolveOptions o = tubes_and_edges(TubeMode::adaptive, 0, false).options;
    const SweepResult result = solve_soup(shapes::plate(plate_side), monostatic({{0.0, 0.0}}, f), o);
    worst = worse(worst, std::abs(std::abs(result.total[0].vv()) * wavelength(f) / (plate_side * plate_side) - 1));
  }
  expect_stable({"1 MHz to 1 THz, S wavelength / area of a plate seen square-on, against 1 in magnitude", "plate of 0.1 m", worst,
                 1e-13, "some roundings"});
}

// Largest change of S / k from one frequency to a third of it, where the body is small: its next term is k D of the first.
double change_at_low_end(const NamedSoup& target, SolveOptions o, double frequency) {
  Description d{target.soup, looks(true, true, false), o};
  d.sweep.frequencies = {frequency};
  const SweepResult high = solve(d);
  d.sweep.frequencies = {frequency / 3};
  return worst_change(high, solve(d), [](ScatteringMatrix s, std::size_t) { return s *= 3.0; });
}

TEST(Frequency, SmallBodiesAreTheirProjectedAreas) {
  // Physical optics of a body small against the wavelength is -j k / 2 pi times an integral of its lit faces, with a phase of 2 k
  // D at most: D = 0.16 m, k = 0.021 / m at 1 MHz. Between 1 and 1/3 MHz two thirds of that are left.
  double worst = 0.0;
  for (const NamedSoup& target : flat_targets())
    for (const TubeMode mode : {TubeMode::uniform, TubeMode::adaptive})
      worst = worse(worst, change_at_low_end(target, tubes_and_edges(mode, 0, false).options, 1e6));
  expect_stable({"1/3 MHz for 1 MHz, S by the same; no edges", flat_names, worst, 7e-3, "phases of 2 k D: 7e-3 rad at 1 MHz"});
}

std::size_t not_finite(const SweepResult& result) {
  std::size_t count = 0;
  for (std::size_t row = 0; row < result.total.size(); ++row) {
    const bool error_known = std::isfinite(result.error[row][0][0]) && std::isfinite(result.error[row][1][1]);
    count += std::isfinite(frobenius_norm(result.total[row])) && error_known ? 0 : 1;
  }
  return count;
}

TEST(Frequency, AllIsFinite) {
  std::size_t bad = 0;
  std::vector<NamedSoup> targets = flat_targets();
  std::ranges::copy(round_targets(), std::back_inserter(targets));
  for (const NamedSoup& target : targets)
    for (const NamedOptions& o : all_options()) {
      const bool sampled = o.options.tubes.mode == TubeMode::uniform || target.name == "open cylinder";
      const double highest = sampled || o.name == everything().name ? 30e9 : 1e12;
      for (const double f : frequencies(1e6, highest, size_of_run(1, 5))) {
        Description d{target.soup, looks(true), o.options};
        d.sweep.frequencies = {f};
        bad += not_finite(solve(d));
      }
    }
  expect_stable({"1 MHz to 30 GHz, adaptive to 1 THz: rows that are not finite, of S or its error", "all of the above",
                 static_cast<double>(bad), 0.0, "a number"});
}

}  // namespace
}  // namespace raytube::testing
