// Everything turned together, or moved together.
#include "stress/description.h"
#include "stress/stability.h"

namespace raytube::testing {
namespace {

Description turned(Description d, const glm::dmat3& turn) {
  d.soup = shapes::transformed(std::move(d.soup), turn);
  for (Look& look : d.sweep.looks) {
    const bool monostatic = look.transmit == look.receive;
    look.transmit = direction_of(turn * spherical_basis(look.transmit).radial);
    look.receive = monostatic ? look.transmit : direction_of(turn * spherical_basis(look.receive).radial);
  }
  d.options.tubes.up = turn * *d.options.tubes.up;
  return d;
}

// The old basis vectors of a direction, turned, in terms of the new ones.
glm::dmat2 turned_basis(const Direction& before, const Direction& now, const glm::dmat3& turn) {
  const SphericalBasis a = spherical_basis(before), b = spherical_basis(now);
  const dvec3 v = turn * a.theta_hat, h = turn * a.phi_hat;
  return {{glm::dot(b.theta_hat, v), glm::dot(b.phi_hat, v)}, {glm::dot(b.theta_hat, h), glm::dot(b.phi_hat, h)}};
}

ScatteringMatrix turned_back(const ScatteringMatrix& s, const Look& before, const Look& now, const glm::dmat3& turn) {
  const glm::dmat2 r = turned_basis(before.receive, now.receive, turn), t = turned_basis(before.transmit, now.transmit, turn);
  ScatteringMatrix back;
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q)
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) back.at(p, q) += r[p][i] * s.at(i, j) * t[q][j];
  return back;
}

Change turned_at_random(const Description& d, int trial) {
  const glm::dmat3 turn = random_rotation(1, static_cast<std::uint64_t>(trial));
  const Description now = turned(d, turn);
  const auto back = [=, before = d.sweep.looks, looks = now.sweep.looks](const ScatteringMatrix& s, std::size_t row) {
    return turned_back(s, before[row], looks[row], turn);
  };
  return {now, back};
}

TEST(Motion, TurnedTogether) {
  expect_unseen("mesh, looks and `tubes.up` turned at random", size_of_run(1, 10), turned_at_random, as_they_are);
}

// The phase of a shift, from the doubles of the look, in extended precision; exact zeros as in spherical_basis.
Complex shifted_phase(const Look& look, double frequency, const dvec3& shift) {
  const auto zero_or = [](long double x) { return std::abs(x) < 1e-15L ? 0.0L : x; };
  const auto towards = [&](const Direction& d) {
    const long double theta = d.theta, phi = d.phi, level = zero_or(std::sin(theta));
    return level * zero_or(std::cos(phi)) * shift.x + level * zero_or(std::sin(phi)) * shift.y +
           zero_or(std::cos(theta)) * shift.z;
  };
  const long double waves = (towards(look.transmit) + towards(look.receive)) * frequency / speed_of_light;
  return std::polar(1.0, 2 * pi * static_cast<double>(waves - std::floor(waves)));
}

Changing shifted_by(double distance) {
  return [=](const Description& d, int trial) {
    const dvec3 shift = random_rotation(2, static_cast<std::uint64_t>(trial)) * dvec3(distance, 0, 0);
    Description moved = d;
    for (dvec3& p : moved.soup.points) p += shift;
    const auto back = [=, looks = d.sweep.looks, f = d.sweep.frequencies[0]](ScatteringMatrix s, std::size_t row) {
      return s *= std::conj(shifted_phase(looks[row], f, shift));
    };
    return Change{std::move(moved), back};
  };
}

std::vector<NamedOptions> no_strips() {
  return {tubes_and_edges(TubeMode::uniform, 0, false), tubes_and_edges(TubeMode::uniform, 1, false),
          tubes_and_edges(TubeMode::adaptive, 0, false)};
}

struct Shift {
  double distance;
  std::string name;
};

// Everything at 94 GHz, the same in wavelengths.
double worst_shift(double distance, std::vector<NamedSoup> targets, const std::vector<NamedOptions>& options,
                   std::vector<Sweep> sweeps) {
  for (NamedSoup& target : targets)
    for (dvec3& p : target.soup.points) p *= stress_frequency / 94e9;
  for (Sweep& sweep : sweeps) sweep.frequencies = {94e9};
  return worst_of_changes(targets, options, sweeps, size_of_run(1, 5), shifted_by(distance));
}

// A coordinate is rounded to half a unit of the last place of the distance, so a corner lies up to 1e-16 of the distance beside
// its place in each axis, 1e-10 m at 1000 km. A bounce's phase is wrong by 2 k times that, k = 1970 / m: 4e-7 rad. (The phase of
// the shift itself, 4e9 rad, is taken in extended precision in the solver, as it is here: in double it is good to 1e-6.) Sides of
// 2 wavelengths, 6 mm, are turned by 2e-8; where currents run exactly along them strips are turned to them by 1e-5 rad, of which
// that is 2e-3. Panels of the cylinder are 0.6 mm wide and turned by 2e-7, which of a path of 20 mm makes 1e-5 rad a bounce.
TEST(Motion, ShiftedWithTheirPhase) {
  const std::vector<Shift> shifts = {{1.0, "1 m"}, {1e3, "1 km"}};
  for (const Shift& shift : shifts) {
    std::vector<NamedSoup> targets = flat_targets();
    targets.push_back(round_targets()[1]);
    const std::string what = "shifted by " + shift.name + " at 94 GHz, phase included";
    expect_stable({what + "; no edges and order 1", std::string(flat_names) + ", open cylinder",
                   worst_shift(shift.distance, targets, no_strips(), all_looks()), 4e-15 * shift.distance * 1970 + 1e-10,
                   "coordinates round to 1e-16 of the distance, phases to 2 k times that, ten bounces"});
    expect_stable({"the same; edges of order 3, edge-face interaction", flat_names,
                   worst_shift(shift.distance, flat_targets(), {order_3(), everything()}, all_looks()),
                   1e-6 + 2e-9 * shift.distance,
                   "edges turned by 2e-14 of the distance in m; strips along them are found at 1e-5"});
  }
}

TEST(Motion, ShiftedByAThousandKilometres) {
  const std::string what = "shifted by 1000 km at 94 GHz, phase included";
  expect_stable({what + "; no edges and order 1, all looks", flat_names,
                 worst_shift(1e6, flat_targets(), no_strips(), all_looks()), 1e-6,
                 "coordinates round to 1e-10 m: 4e-7 rad a bounce"});
  expect_stable({"the same; all edges, general looks", flat_names,
                 worst_shift(1e6, flat_targets(), all_options(), general_looks()), 1e-6, "the same"});
  expect_stable({"the same; all edges, looks exactly along edges", flat_names,
                 worst_shift(1e6, flat_targets(), all_options(), exact_looks()), 2e-3,
                 "edges are turned by 2e-8 rad; strips along them are found at 1e-5"});
  expect_stable({"the same; no edges and order 1, general looks", "open cylinder",
                 worst_shift(1e6, {round_targets()[1]}, no_strips(), general_looks()), 1e-4,
                 "panels of 0.6 mm are turned by 2e-7 rad: 1e-5 rad a bounce"});
}

}  // namespace
}  // namespace raytube::testing
