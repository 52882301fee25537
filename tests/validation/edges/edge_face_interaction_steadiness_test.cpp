// What must not change or jump in edge-face interaction.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>

#include "interaction_bodies.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using namespace raytube::testing::interaction;

/// A target to be asked for looks one by one, quadrature of a hundred-thousandth of the result.
class Prober {
 public:
  explicit Prober(PolygonSoup soup, bool on = true)
      : loaded_(build_mesh(std::move(soup), 1.0)), options_(adaptive(on)), target_(loaded_.mesh) {
    options_.tubes.tolerance_db = 1e-4;
  }
  ScatteringMatrix operator()(const Look& look) const {
    return solve(target_, {{frequency}, {look}, !(look.transmit == look.receive)}, options_).total[0];
  }

 private:
  LoadedMesh loaded_;
  SolveOptions options_;
  Target target_;
};

/// A look that passes an event as its directions turn at these rates.
struct Passage {
  const char* what;
  Look event;
  Direction transmit, receive;

  Look at(double turned) const {
    const auto moved = [&](const Direction& d, const Direction& rate) {
      return Direction{d.theta + turned * rate.theta, d.phi + turned * rate.phi};
    };
    return {moved(event.transmit, transmit), moved(event.receive, receive)};
  }
};

Direction degrees(double theta, double phi) { return {theta * degree, phi * degree}; }
Passage monostatic_passage(const char* what, const Direction& look, const Direction& rate) {
  return {what, {look, look}, rate, rate};
}

const double steps_deg[] = {-1e-2, -1e-3, -1e-4, -1e-5, -1e-6, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2};

TEST(EdgeFaceInteraction, NothingJumpsWhereRaysComeAndGo) {
  const Prober dihedral(shapes::dihedral(3 * lambda, 3 * lambda));
  const Direction theta{1, 0}, phi{0, 1}, none{};
  const Passage passages[] = {
      monostatic_passage("diffraction points of the inner edge's ends leave the outer edges", degrees(45, 30), theta),
      monostatic_passage("these diffraction points, from below", degrees(135, 40), theta),
      {"these diffraction points, bistatic", {degrees(45, 30), degrees(70, 20)}, theta, none},
      monostatic_passage("a face casts its shadow on the other", degrees(80, -25), phi),
      monostatic_passage("across the inner edge, through its bisector", degrees(90, 45), phi),
      {"the receiver passes the plane across the inner edge", {degrees(70, 30), degrees(90, 45)}, none, theta},
      {"the receiver passes the plane of a face", {degrees(70, 30), degrees(70, 0)}, none, phi},
      {"the receiver passes a shadow of the edges", {degrees(70, 30), degrees(70, -45)}, none, phi}};
  // S is a sum over points within R of the origin, 4.5 wavelengths: it turns by 2kR rad per rad, and |S| is below 3 wavelengths.
  // Quadrature is asked for a hundred-thousandth of |S|; where a corner turns up between two panels it leaves some times that.
  const double slope = 2 * 2 * pi * 4.5 * 3.0, noise = 2e-4;
  for (const Passage& passage : passages) {
    const ScatteringMatrix on = dihedral(passage.event);
    double worst = 0.0;
    for (const double step : steps_deg) {
      const double change = frobenius_norm(dihedral(passage.at(step * degree)) - on) / lambda;
      EXPECT_LE(change, slope * std::abs(step) * degree + noise) << passage.what << ", " << step << " deg";
      worst = std::max(worst, change - slope * std::abs(step) * degree);
    }
    measured(passage.what, worst, "wavelengths beyond the slope");
  }
}

TEST(EdgeFaceInteraction, OnTheBorderOfABeamCountsTheMeanOfItsSides) {
  // In looks across the inner edge the ends of one face are the border of what the other reflects: lit on one side of the plane,
  // dark on the other, half in it. The light on them fades over some degrees; cut at the border, half the jump was 0.3, 0.05 and
  // 0.5 wavelengths. In the last row the look also runs through the outer edges' own border.
  const Prober dihedral(shapes::dihedral(3 * lambda, 3 * lambda));
  const Direction theta{1, 0}, none{};
  struct Border {
    Passage passage;
    double most;  // half the jump that is left, in wavelengths: what is measured, rounded up
  };
  const Border borders[] = {{monostatic_passage("look at 45 deg", degrees(90, 45), theta), 1e-9},  // by symmetry
                            {monostatic_passage("look at 20 deg", degrees(90, 20), theta), 3e-3},
                            {{"from 35 to 60 deg", {degrees(90, 35), degrees(90, 60)}, theta, none}, 1e-3},
                            {{"from 45 deg, received above", {degrees(90, 45), degrees(80, 50)}, theta, none}, 0.08}};
  for (const Border& border : borders) {
    const Passage& passage = border.passage;
    const double step = 5e-3 * degree;
    const ScatteringMatrix on = dihedral(passage.event), below = dihedral(passage.at(-step)), above = dihedral(passage.at(step));
    ScatteringMatrix mean = below + above;
    mean *= 0.5;
    const double jump = frobenius_norm(above - below) / 2 / lambda, off = frobenius_norm(on - mean) / lambda;
    measured(fmt::format("{}: half the jump", passage.what).c_str(), jump, "wavelengths");
    measured(fmt::format("{}: distance from the mean", passage.what).c_str(), off, "wavelengths");
    EXPECT_LE(jump, border.most) << passage.what;
    EXPECT_LE(off, 0.015) << passage.what;
  }
}

TEST(EdgeFaceInteraction, BesideABorderOfABeamNothingJumps) {
  // On the border, and within 1e-5 rad of it, means of both sides count: of the light, and of the wave over the rim where it
  // ends. Steps from inside of that to outside; where the two did not agree on what is inside, S was off by 0.17 to 0.34
  // wavelengths.
  const Prober dihedral(shapes::dihedral(3 * lambda, 3 * lambda));
  for (const Passage& passage : {monostatic_passage("look at 20 deg", degrees(90, 20), {1, 0}),
                                 monostatic_passage("look at 57 deg", degrees(90, 57), {1, 0}),
                                 Passage{"from 35 to 60 deg", {degrees(90, 35), degrees(90, 60)}, {1, 0}, {}}}) {
    const ScatteringMatrix on = dihedral(passage.event);
    double most = 0.0;
    for (double step = 1e-7; step < 2e-3; step *= std::sqrt(10.0))
      for (const double sign : {-1.0, 1.0})
        most = std::max(most, frobenius_norm(dihedral(passage.at(sign * step * degree)) - on) / lambda);
    measured(fmt::format("{}, beside the border", passage.what).c_str(), most, "wavelengths");
    EXPECT_LE(most, 1e-3) << passage.what;  // strips beyond the first order and quadrature leave a third of it
  }
}

TEST(EdgeFaceInteraction, AnEdgeGoesDarkBehindAnother) {
  // What is lit is decided by geometrical optics: the fringe of an edge jumps, and its illumination of other faces may add as
  // much again at most.
  const Passage passage = monostatic_passage("", degrees(70, 315), {0, 1});
  const auto jump = [&](bool on) {
    const Prober dihedral(shapes::dihedral(3 * lambda, 3 * lambda), on);
    return frobenius_norm(dihedral(passage.at(1e-3 * degree)) - dihedral(passage.at(-1e-3 * degree))) / lambda;
  };
  const double with = jump(true), without = jump(false);
  measured("an edge goes dark: jump", with, "wavelengths");
  measured("an edge goes dark: jump, without", without, "wavelengths");
  EXPECT_LE(with, 2 * without);
}

TEST(EdgeFaceInteraction, ConvexTargetsAreLeftAlone) {
  Sweep sweep{{frequency, 1.2 * frequency}, {}, true};
  for (int i = 0; i < 6; ++i) sweep.looks.push_back({{0.3 + 0.4 * i, 0.7 * i}, {0.5 + 0.4 * i, 1.1 * i}});
  for (const PolygonSoup& soup : {shapes::plate(3 * lambda), shapes::cube(2 * lambda), shapes::cylinder(lambda, 3 * lambda, 24),
                                  shapes::icosphere(2, 2 * lambda)}) {
    const SweepResult with = solve_soup(soup, sweep, adaptive(true)), without = solve_soup(soup, sweep, adaptive(false));
    EXPECT_EQ(with.statistics.counted("edge_illumination_pieces"), 0u);
    EXPECT_GT(frobenius_norm(with.total[0]), 0.0);
    ASSERT_EQ(with.total.size(), without.total.size());
    EXPECT_EQ(std::memcmp(with.total.data(), without.total.data(), with.total.size() * sizeof with.total[0]), 0);
    EXPECT_EQ(with.error, without.error);
  }
}

/// Every square of a dihedral cut into `count` by `count` squares and these along alternating diagonals. `shift`: the corners of
/// the second face are moved along the inner edge, so that those of one face lie on the edges of the other.
PolygonSoup cut_dihedral(double a, int count, double shift) {
  PolygonSoup soup;
  for (int face = 0; face < 2; ++face) {
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    for (int i = 0; i <= count; ++i)
      for (int k = 0; k <= count; ++k) {
        const double inner = k > 0 && k < count ? shift * face / count : 0.0;
        const double u = a * i / count, v = a * ((k + inner) / count - 0.5);
        soup.points.push_back(face == 0 ? dvec3(u, 0, v) : dvec3(0, u, v));
      }
    const auto at = [&](int i, int k) { return first + static_cast<std::uint32_t>(i * (count + 1) + k); };
    for (int i = 0; i < count; ++i)
      for (int k = 0; k < count; ++k) {
        const std::uint32_t p = at(i, k), q = at(i + 1, k), r = at(i + 1, k + 1), s = at(i, k + 1);
        if ((i + k) % 2 == 0)
          soup.polygons.insert(soup.polygons.end(), {{p, q, r}, {p, r, s}});
        else
          soup.polygons.insert(soup.polygons.end(), {{p, q, s}, {q, r, s}});
      }
  }
  return soup;
}

TEST(EdgeFaceInteraction, FacetsOfAPlaneFaceDoNotShow) {
  Sweep sweep{{frequency}, {}, true};
  for (int i = 0; i < 8; ++i) sweep.looks.push_back({{0.5 + 0.2 * i, 0.2 + 0.15 * i}, {1.9 - 0.15 * i, 1.4 - 0.16 * i}});
  SolveOptions o = adaptive(true);
  o.tubes.tolerance_db = 1e-4;
  const SweepResult whole = solve_soup(shapes::dihedral(3 * lambda, 3 * lambda), sweep, o);
  EXPECT_GT(whole.statistics.counted("edge_illumination_pieces"), 0u);
  for (const int count : {4, 12})
    for (const double shift : {0.0, 0.37}) {
      const SweepResult cut = solve_soup(cut_dihedral(3 * lambda, count, shift), sweep, o);
      EXPECT_EQ(cut.statistics.counted("edge_illumination_pieces"), whole.statistics.counted("edge_illumination_pieces"));
      double worst = 0.0;
      for (std::size_t i = 0; i < sweep.looks.size(); ++i)
        worst = std::max(worst, frobenius_norm(cut.total[i] - whole.total[i]) / lambda);
      measured(fmt::format("facets of a dihedral, {} a side, shifted by {}", count, shift).c_str(), worst, "wavelengths");
      // As one face: rounding of sums of some ten thousand terms. As several: the rows of each are integrated by themselves,
      // those that pass an end of an edge with an error of some 1e-3.
      EXPECT_LE(worst, count == 4 ? 1e-9 : 4e-3);
    }
}

/// A plate, and in front of it a strip that spans a few degrees about an edge of the plate, cut into facets.
PolygonSoup plate_and_strip(int rows, int columns) {
  PolygonSoup soup{{{-3, -1.5, 0}, {0, -1.5, 0}, {0, 1.5, 0}, {-3, 1.5, 0}}, {{0, 1, 2, 3}}};
  for (int i = 0; i <= rows; ++i)
    for (int j = 0; j <= columns; ++j) soup.points.emplace_back(4 + 1.0 * i / rows, -1.5 + 3.0 * j / columns, 4);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const auto first = static_cast<std::uint32_t>(4 + i * (columns + 1) + j),
                 next = first + static_cast<std::uint32_t>(columns) + 1;
      soup.polygons.push_back({first, next, next + 1, first + 1});
    }
  for (dvec3& p : soup.points) p *= lambda;
  return soup;
}

TEST(EdgeFaceInteraction, SmallFacesReceiveHoweverManyFacets) {
  // A panel of the azimuth integral is wider than the strip: its corners must be cuts in meshes of hundreds of vertices too.
  for (const double theta : {0.4, 0.8, 1.1}) {
    const Sweep sweep{{frequency}, {{{theta, 2.8}, {0.6, -2.0}}}, true};
    SolveOptions o = adaptive(true);
    o.tubes.tolerance_db = 1e-2;
    const ScatteringMatrix whole = solve_soup(plate_and_strip(1, 1), sweep, o).of("interaction").at(0);
    const ScatteringMatrix cut = solve_soup(plate_and_strip(12, 18), sweep, o).of("interaction").at(0);
    measured("a strip of many facets", frobenius_norm(cut - whole) / frobenius_norm(whole), "of what it adds");
    EXPECT_LE(frobenius_norm(cut - whole), 5e-3 * frobenius_norm(whole));  // facets are integrated one by one
  }
}

TEST(EdgeFaceInteraction, ManyFrequenciesAtOnce) {
  std::vector<double> frequencies;
  for (int i = 0; i < 101; ++i) frequencies.push_back(frequency * (0.8 + 0.004 * i));
  const Look look{degrees(80, 40), degrees(80, 40)};
  SolveOptions o = adaptive(true);
  o.tubes.tolerance_db = 1e-3;
  const PolygonSoup soup = shapes::dihedral(3 * lambda, 3 * lambda);
  const SweepResult all = solve_soup(soup, {frequencies, {look}, false}, o);
  for (const int i : {0, 37, 100}) {
    const SweepResult one = solve_soup(soup, {{frequencies[i]}, {look}, false}, o);
    const double change = frobenius_norm(all.total[i] - one.total[0]) / lambda;
    measured("101 frequencies against one", change, "wavelengths");
    EXPECT_LE(change, 3e-4);  // panels of the highest frequency serve all: what quadrature leaves of 1e-4 |S|
  }
}

TEST(EdgeFaceInteraction, QuadratureKeepsToTheTolerance) {
  // A tolerance of 0.1 dB allows changes of 1.2 % of a row's largest amplitude. The estimate is to cover what is left, but for a
  // kink inside a panel here and there.
  std::vector<Direction> directions;
  for (int i = 0; i < 8; ++i) directions.push_back({0.4 + 0.28 * i, -0.5 + 0.36 * i});
  const std::pair<const char*, PolygonSoup> targets[] = {{"dihedral", shapes::dihedral(3 * lambda, 3 * lambda)},
                                                         {"trihedral", square_trihedral(3 * lambda)},
                                                         {"two boxes", two_boxes(2 * lambda, lambda)}};
  for (const auto& [name, soup] : targets) {
    SolveOptions o = adaptive(true);
    const SweepResult loose = solve_soup(soup, monostatic(directions, frequency), o);
    o.tubes.tolerance_db *= 0.1;
    const SweepResult tight = solve_soup(soup, monostatic(directions, frequency), o);
    int covered = 0, channels = 0;
    double worst = 0.0;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      worst = std::max(worst, largest_amplitude(loose.total[i] - tight.total[i]) / largest_amplitude(tight.total[i]));
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q, ++channels) {
          const double change = std::abs(loose.total[i].at(p, q) - tight.total[i].at(p, q));
          covered += change <= loose.error[i][p][q] + 1e-6 * lambda;
        }
    }
    measured(fmt::format("{}: worst change at a tenth of the tolerance", name).c_str(), worst, "of the row");
    measured(fmt::format("{}: share of channels whose estimate covers it", name).c_str(), double(covered) / channels, "");
    EXPECT_LE(worst, 0.0012) << name;  // a tenth is the share of edge-face interaction
    EXPECT_GE(covered, 0.95 * channels) << name;
  }
}

}  // namespace
}  // namespace raytube
