// Descriptions of one physics: a mesh, what is asked about it and how, and by how much the answers to two of them differ.
#pragma once

#include <algorithm>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "core/random.h"
#include "interaction_bodies.h"
#include "run.h"
#include "shapes.h"
#include "stress/stability.h"

namespace raytube::testing {

inline constexpr double stress_frequency = 10e9;
inline const double stress_wavelength = wavelength(stress_frequency);

struct Description {
  PolygonSoup soup;
  Sweep sweep;
  SolveOptions options;
  double metres_per_unit = 1.0;
};

inline SweepResult solve(const Description& d) {
  const LoadedMesh loaded = build_mesh(d.soup, d.metres_per_unit);
  return solve(Target(loaded.mesh), d.sweep, d.options);
}

struct NamedSoup {
  std::string name;
  PolygonSoup soup;
};

struct NamedOptions {
  std::string name;
  SolveOptions options;
};

/// An open tube of `sides` flat panels along z.
inline PolygonSoup open_cylinder(double radius, double length, std::uint32_t sides) {
  PolygonSoup soup = shapes::cylinder(radius, length, sides);
  soup.polygons.resize(sides);
  return soup;
}

/// A closed body of L-shaped section, its legs `a` long and a / 3 thick, `length` long along z.
inline PolygonSoup angle_bar(double a, double length) {
  const double t = a / 3;
  const std::vector<dvec2> outline = {{0, 0}, {a, 0}, {a, t}, {t, t}, {t, a}, {0, a}};
  PolygonSoup soup;
  for (const double z : {-length / 2, length / 2})
    for (const dvec2& p : outline) soup.points.emplace_back(p, z);
  soup.polygons = {{5, 4, 3, 2, 1, 0}, {6, 7, 8, 9, 10, 11}};
  for (std::uint32_t i = 0; i < 6; ++i) soup.polygons.push_back({i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i});
  return soup;
}

/// Targets of flat faces, a few wavelengths large.
inline std::vector<NamedSoup> flat_targets() {
  const double a = stress_wavelength;
  return {{"plate", shapes::plate(3 * a, 0.3)},         {"cube", shapes::cube(2 * a)},
          {"dihedral", shapes::dihedral(3 * a, 3 * a)}, {"trihedral", shapes::trihedral(3 * a)},
          {"L-shaped bar", angle_bar(3 * a, 2.5 * a)},  {"two boxes", interaction::two_boxes(1.5 * a, 0.7 * a)}};
}
inline const char* const flat_names = "plate, cube, dihedral, trihedral, L-shaped bar, two boxes";

/// Targets of facets that stand for a curved surface: taken as that, and as they are, as they light one another.
inline std::vector<NamedSoup> round_targets() {
  return {{"sphere", shapes::icosphere(3, 1.5 * stress_wavelength)},
          {"open cylinder", open_cylinder(stress_wavelength, 2 * stress_wavelength, 36)}};
}
inline const char* const round_names = "sphere of 1280 facets, open cylinder of 36";

inline NamedOptions tubes_and_edges(TubeMode mode, int order, bool between) {
  SolveOptions o = options(order ? EdgeMethod::fringe : EdgeMethod::none, mode == TubeMode::uniform ? 10.0 : 40.0);
  o.tubes.mode = mode;
  o.tubes.up = dvec3(0.2, 0.1, 1.0);
  o.edges.order = std::max(order, 1);
  o.edges.interaction = between;
  o.edges.interaction_budget = unlimited_interaction_budget;  // what it gives is tested, not what it may cost
  const std::string edges = order == 0 ? "no edges" : "order " + std::to_string(order) + (between ? " and between" : "");
  return {(mode == TubeMode::uniform ? "uniform, " : "adaptive, ") + edges, o};
}

/// Both ways to cut tubes, and currents that pass one edge or two.
inline std::vector<NamedOptions> plain_options() {
  return {tubes_and_edges(TubeMode::uniform, 0, false), tubes_and_edges(TubeMode::uniform, 1, false),
          tubes_and_edges(TubeMode::adaptive, 0, false), tubes_and_edges(TubeMode::adaptive, 2, false)};
}
inline NamedOptions order_3() { return tubes_and_edges(TubeMode::adaptive, 3, false); }
inline NamedOptions everything() { return tubes_and_edges(TubeMode::adaptive, 3, true); }
inline std::vector<NamedOptions> all_options() {
  std::vector<NamedOptions> all = plain_options();
  all.push_back(order_3());
  all.push_back(everything());
  return all;
}

/// Looks without a special direction, then looks along axes and diagonals, where faces are seen edge-on and beams end at edges.
inline Sweep looks(bool bistatic, bool general = true, bool exact = true) {
  Sweep sweep{{stress_frequency}, {}, bistatic};
  const auto add = [&](const Direction& transmit, const Direction& receive) {
    sweep.looks.push_back({transmit, bistatic ? receive : transmit});
  };
  for (int i = 0; general && i < size_of_run(2, 6); ++i)
    add({0.31 + 0.53 * i, 0.13 + 1.27 * i}, {2.7 - 0.47 * i, 1.3 + 0.91 * i});
  const std::vector<dvec2> special = {{0, 0}, {90, 0}, {90, 45}, {180, 0}, {45, 90}, {135, -135}};
  for (std::size_t i = 0; exact && i < special.size(); ++i) {
    const dvec2 from = degree * special[i], to = degree * special[(i + 2) % special.size()];
    add({from.x, from.y}, {to.x, to.y});
  }
  return sweep;
}
inline std::vector<Sweep> all_looks() { return {looks(false), looks(true)}; }
inline std::vector<Sweep> general_looks() { return {looks(false, true, false), looks(true, true, false)}; }
inline std::vector<Sweep> exact_looks() { return {looks(false, false), looks(true, false)}; }

/// Accurate next to the poles, too.
/// A number below 1, the `index`-th of a stream with this name.
inline double random_number(std::uint64_t stream, std::uint64_t index) { return random_point(7, stream, index).x; }

/// Uniform among all rotations (Shoemake 1992, "Uniform random rotations").
inline glm::dmat3 random_rotation(std::uint64_t stream, std::uint64_t index) {
  const dvec2 a = random_point(7, stream, 2 * index), b = random_point(7, stream, 2 * index + 1);
  const double low = std::sqrt(1.0 - a.x), high = std::sqrt(a.x);
  return glm::mat3_cast(glm::dquat(high * std::cos(2 * pi * b.x), low * std::sin(2 * pi * a.y), low * std::cos(2 * pi * a.y),
                                   high * std::sin(2 * pi * b.x)));
}

/// S of a row of the new description in the terms of the old one.
using Translation = std::function<ScatteringMatrix(const ScatteringMatrix& s, std::size_t row)>;

/// Largest |S' - S| over all rows and channels by the largest |S|; infinite if a number is none.
inline double worst_change(const SweepResult& before, const SweepResult& after, const Translation& translated) {
  double worst = 0.0, peak = 0.0;
  for (std::size_t row = 0; row < before.total.size(); ++row) {
    const double change = largest_amplitude(translated(after.total[row], row) - before.total[row]);
    if (!std::isfinite(change)) return std::numeric_limits<double>::infinity();
    worst = worse(worst, change);
    peak = std::max(peak, largest_amplitude(before.total[row]));
  }
  return peak > 0.0 ? worst / peak : worst;
}
inline double worst_change(const SweepResult& before, const SweepResult& after) {
  return worst_change(before, after, [](const ScatteringMatrix& s, std::size_t) { return s; });
}

/// The same physics described otherwise, and how its results read in the old terms.
struct Change {
  Description description;
  Translation translated = [](const ScatteringMatrix& s, std::size_t) { return s; };
};

/// Change number `trial` of a description.
using Changing = std::function<Change(const Description& d, int trial)>;

/// The worst of `trials` changes of each target, solved with these options; what each target comes to is printed.
inline double worst_of_changes(const std::vector<NamedSoup>& targets, const std::vector<NamedOptions>& options,
                               const std::vector<Sweep>& sweeps, int trials, const Changing& changing) {
  double worst = 0.0;
  for (const NamedSoup& target : targets)
    for (const NamedOptions& o : options) {
      double here = 0.0;
      for (const Sweep& sweep : sweeps) {
        const Description d{target.soup, sweep, o.options};
        const SweepResult before = solve(d);
        for (int trial = 0; trial < trials; ++trial) {
          const Change change = changing(d, trial);
          here = std::max(here, worst_change(before, solve(change.description), change.translated));
        }
      }
      measured((target.name + ", " + o.name).c_str(), here, "of the largest |S|");
      worst = worse(worst, here);
    }
  return worst;
}

/// A change that must not be seen, in three rows.
///
/// Corners are rounded to 1e-16 of some wavelengths, phases of 60 rad to 1e-14. What is decided otherwise - a tube at an edge, a
/// ray at the rim of a shadow - would be 1e-6 and more. Where a current runs exactly along an edge its strips are turned to the
/// edge by 1e-5 rad, and see a rounding as 1e-11; what they start along a third edge sees it as 1e-16 / (1e-5)^2. Rules about an
/// edge stop at 1e-4 wavelengths, which is part of err_pq_db; where the edge is described from its other end they may take other
/// points.
inline void expect_unseen(const std::string& what, int trials, const Changing& changing,
                          const std::function<std::vector<NamedSoup>(std::vector<NamedSoup>)>& described) {
  std::vector<NamedSoup> flat = described(flat_targets()), all = flat;
  std::ranges::copy(described(round_targets()), std::back_inserter(all));
  const std::string names = std::string(flat_names) + ", " + round_names;
  expect_stable({what + "; no edges, order 1 and 2, all looks", names,
                 worst_of_changes(all, plain_options(), all_looks(), trials, changing), 1e-9,
                 "rounding is 1e-14, of strips along edges 1e-11; a decision by rounding would be 1e-6 or more"});
  expect_stable({"the same; order 3, general looks", names, worst_of_changes(all, {order_3()}, general_looks(), trials, changing),
                 1e-9, "the same"});
  const double along = worst_of_changes(flat, {order_3()}, exact_looks(), trials, changing);
  const double between = worst_of_changes(flat, {everything()}, all_looks(), trials, changing);
  expect_stable({"the same; order 3 along edges, edge-face interaction", flat_names, std::max(along, between), 1e-6,
                 "strips of strips along edges see 1e-16 / (1e-5)^2; other points of a rule good to 1e-4 wavelengths"});
}
inline std::vector<NamedSoup> as_they_are(std::vector<NamedSoup> targets) { return targets; }

}  // namespace raytube::testing
