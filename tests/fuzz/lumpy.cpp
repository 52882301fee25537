// Irregular curved bodies from the bytes, solved over wide lists of frequencies with all that curved surfaces have: whatever
// comes in, amplitudes are finite, and what exceeds the bound of its size is told.
#include <algorithm>
#include <cmath>

#include "choices.h"
#include "core/error.h"
#include "lumpy_bodies.h"
#include "solve/solve.h"
#include "target.h"

namespace {

using namespace raytube;
using namespace raytube::fuzz;

constexpr double most_beyond =
    10.0;  // of two tubes a wavelength on bodies of few facets; what blows up is orders of magnitude off

double share(Choices& choices) { return choices.byte() / 255.0; }

Direction direction(Choices& choices) {
  const double theta = share(choices) * pi;
  return {theta, share(choices) * 2 * pi};
}

dvec3 along(const Direction& d) {
  return {std::sin(d.theta) * std::cos(d.phi), std::sin(d.theta) * std::sin(d.phi), std::cos(d.theta)};
}

PolygonSoup body(Choices& choices, int subdivisions, double reach) {
  std::vector<shapes::Bump> bumps(choices.below(10));
  for (shapes::Bump& bump : bumps) {
    bump.direction = along(direction(choices));
    bump.height = 3.0 * share(choices) - 1.0;
    bump.sharpness = std::exp2(7.0 * share(choices));
  }
  const double x = 0.03 + 0.97 * share(choices);
  return shapes::lumpy_body(subdivisions, bumps, {x, 1.0, 0.1 + 0.9 * share(choices)}, reach);
}

// Beside the first one, or through it.
void add(PolygonSoup& soup, const PolygonSoup& other, double away) {
  const auto first = static_cast<std::uint32_t>(soup.points.size());
  for (const dvec3& p : other.points) soup.points.push_back(p + dvec3(away, 0.1 * away, 0.0));
  for (std::vector<std::uint32_t> polygon : other.polygons) {
    for (std::uint32_t& vertex : polygon) vertex += first;
    soup.polygons.push_back(polygon);
  }
}

// ka of the highest 0.5 to 60 on bodies of few facets, that of the lowest down to a thirtieth of it, in any order.
Sweep sweep(Choices& choices, int subdivisions, double reach) {
  Sweep sweep;
  const double highest = 0.5 * std::pow(subdivisions < 3 ? 120.0 : 16.0, share(choices)) * speed_of_light / (2 * pi * reach);
  for (unsigned i = 0, count = 1 + choices.below(5); i < count; ++i)
    sweep.frequencies.push_back(i == 0 ? highest : highest * std::pow(30.0, -share(choices)));
  std::ranges::sort(sweep.frequencies);
  sweep.frequencies.erase(std::unique(sweep.frequencies.begin(), sweep.frequencies.end()), sweep.frequencies.end());
  sweep.bistatic = choices.flag();
  for (unsigned i = 0, count = 1 + choices.below(2); i < count; ++i) {
    const Direction transmit = direction(choices);
    sweep.looks.push_back({transmit, sweep.bistatic ? direction(choices) : transmit});
  }
  return sweep;
}

// Few tubes: what runs over the surfaces and along their edges is what this is about.
SolveOptions options(Choices& choices) {
  SolveOptions o;
  o.threads = 1;
  o.keep_parts = choices.flag();
  o.surfaces.waves = true;
  o.tubes.per_wavelength = o.tubes.max_per_wavelength = 2.0;
  o.tubes.curved = static_cast<CurvedSurfaces>(choices.below(3));
  o.tubes.max_bounces = static_cast<int>(1 + choices.below(4));
  o.edges.order = static_cast<int>(1 + choices.below(3));
  o.edges.interaction = choices.flag();
  o.edges.interaction_budget = 0.2;
  return o;
}

bool is_finite(const SweepResult& result) {
  return std::ranges::all_of(result.total, [](const ScatteringMatrix& s) { return std::isfinite(frobenius_norm(s)); });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr double reach = 0.85;  // [m]
  Choices choices(data, size);
  const int subdivisions = static_cast<int>(1 + choices.below(3));
  const Sweep asked = sweep(choices, subdivisions, reach);
  const SolveOptions how = options(choices);
  PolygonSoup soup = body(choices, subdivisions, reach);
  if (choices.below(4) == 1) add(soup, body(choices, 1, 0.3 * reach), 2.0 * share(choices));
  try {
    const LoadedMesh loaded = build_mesh(std::move(soup), 1.0);
    const SweepResult result = solve(Target(loaded.mesh, WedgeOptions{}), asked, how);
    expect(is_finite(result), "every amplitude is finite");
    for (const BeyondBound& beyond : result.statistics.beyond_bound)
      expect(beyond.ratio < most_beyond, "no part exceeds its bound by far");
  } catch (const InputError& error) {
    expect_sentence(error.what());
  }
  return 0;
}
