// Each switch of a single mechanism takes that away where a body has it, and nothing elsewhere.
#include <gtest/gtest.h>

#include "run.h"
#include "shapes.h"
#include "smooth_bodies.h"

namespace raytube {
namespace {

using namespace raytube::testing;

constexpr double frequency = speed_of_light;  // of one metre

struct Switch {
  const char* name;
  void (*off)(SolveOptions&);
};

const Switch plates{"edges.plate_corners", [](SolveOptions& o) { o.edges.corners.plates = false; }};
const Switch solids{"edges.solid_corners", [](SolveOptions& o) { o.edges.corners.solids = false; }};
const Switch thin_ends{"edges.thin_ends", [](SolveOptions& o) { o.edges.corners.thin_ends = false; }};
const Switch rounded_edges{"surfaces.rounded_edges", [](SolveOptions& o) { o.surfaces.rounded_edges = false; }};
const Switch flat_tips{"surfaces.flat_tips", [](SolveOptions& o) { o.surfaces.flat_tips = false; }};
const Switch round_tips{"surfaces.round_tips", [](SolveOptions& o) { o.surfaces.round_tips = false; }};
const std::vector<Switch> all{plates, solids, thin_ends, rounded_edges, flat_tips, round_tips};

PolygonSoup lens_wing() {
  constexpr int pieces = 24;
  constexpr double chord = 3.0, half_angle = 10 * degree;
  std::vector<dvec2> outline;
  for (int side : {-1, 1})
    for (int i = 0; i < pieces; ++i) {
      const double x = side * chord * (i / double(pieces) - 0.5);
      outline.emplace_back(-x, i == 0 ? 0.0 : side * shapes::arc(x, chord, half_angle));
    }
  if (outline[1].y > 0.0) std::ranges::reverse(outline);
  return shapes::prism(outline, -1.5, 1.5);
}

std::vector<ScatteringMatrix> solved(const PolygonSoup& body, const Switch* off) {
  SolveOptions options;
  if (off != nullptr) off->off(options);
  const std::vector<Direction> looks{{90 * degree, 8 * degree}, {75 * degree, 20 * degree}, {60 * degree, 33 * degree}};
  return solve_soup(body, monostatic(looks, frequency), options).total;
}

double change(const std::vector<ScatteringMatrix>& a, const std::vector<ScatteringMatrix>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) most = std::max(most, std::abs(a[i].at(p, q) - b[i].at(p, q)));
  return most;
}

struct Body {
  const char* name;
  PolygonSoup soup;
  std::vector<Switch> claimed;
};

TEST(Switches, TakeAwayTheirMechanismAndNothingElse) {
  const Body bodies[] = {{"plate", shapes::plate(3.0), {plates}},
                         {"cube", shapes::cube(2.0), {solids}},
                         {"lens wing", lens_wing(), {thin_ends}},
                         {"leaf", shapes::spindle(25 * degree, 4.0, 1.0 / 3), {rounded_edges, flat_tips}},
                         {"ogive", shapes::spindle(22.6 * degree, 5.0, 1.0), {round_tips}},
                         {"sphere", shapes::icosphere(4, 1.5), {}}};
  constexpr double unnoticed = 1e-6;  // shares of rounded edges fade: at the tips of the ogive 1e-7 of them is left
  constexpr double noticed = 1e-3;    // wavelengths: a hundredth of what each of them adds at one of the looks, or less
  for (const Body& body : bodies) {
    const std::vector<ScatteringMatrix> whole = solved(body.soup, nullptr);
    for (const Switch& each : all) {
      const double changed = change(whole, solved(body.soup, &each));
      const auto is_it = [&](const Switch& s) { return s.name == each.name; };
      if (std::ranges::any_of(body.claimed, is_it))
        EXPECT_GT(changed, noticed) << body.name << ' ' << each.name;
      else
        EXPECT_LE(changed, unnoticed) << body.name << ' ' << each.name;
    }
  }
}

}  // namespace
}  // namespace raytube
