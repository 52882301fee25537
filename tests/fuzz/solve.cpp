// A few vertices, triangles, looks and options from the bytes, solved: whatever comes in, finite amplitudes come out.
#include "solve/solve.h"

#include <algorithm>
#include <cmath>

#include "choices.h"
#include "core/error.h"
#include "target.h"

namespace {

using namespace raytube;
using namespace raytube::fuzz;

// On a lattice of 1/8 from -1 to 1, where coincidences are frequent; beside it by what rounding, welding and thin gaps are.
double coordinate(Choices& choices) {
  static constexpr double beside[] = {0.0, 0.0, 0.0, 1e-16, 1e-12, 1e-8, 1e-7, 1e-5, 1e-3, 0.01};
  const unsigned place = choices.byte();
  return (static_cast<double>(place % 17) - 8.0) / 8.0 + beside[place / 17 % std::size(beside)];
}

PolygonSoup mesh(Choices& choices) {
  PolygonSoup soup;
  const unsigned vertices = 3 + choices.below(10), facets = 1 + choices.below(12);
  for (unsigned i = 0; i < vertices; ++i) {
    const double x = coordinate(choices), y = coordinate(choices);
    soup.points.push_back({x, y, coordinate(choices)});
  }
  for (unsigned i = 0; i < facets; ++i) {
    soup.polygons.emplace_back();
    for (unsigned k = 0; k < 3; ++k) soup.polygons.back().push_back(choices.below(vertices));
  }
  return soup;
}

// Multiples of 15 degrees, face-on, edge-on and along many a wedge; and a little beside these.
double angle(Choices& choices, unsigned steps) {
  static constexpr double beside[] = {0.0, 0.0, 1e-13, 1e-9, 1e-6, 1e-3, 0.1, 7.3};
  const unsigned place = choices.byte();
  const double degrees = 15.0 * (place % (steps + 1)) + beside[place / (steps + 1) % std::size(beside)];
  return std::min(degrees, 15.0 * steps) * degree;
}

Direction direction(Choices& choices) {
  const double theta = angle(choices, 12);
  return {theta, angle(choices, 24)};
}

// Targets of less than a wavelength between opposite corners of the lattice: sanitizers take fifty times what a release build
// does.
Sweep sweep(Choices& choices) {
  static constexpr double wavelengths[] = {1e9, 1e3, 30.0, 12.0, 8.0, 6.0, 4.0};
  Sweep sweep;
  for (unsigned i = 0, count = 1 + choices.below(2); i < count; ++i)
    sweep.frequencies.push_back(speed_of_light / wavelengths[choices.below(std::size(wavelengths))]);
  sweep.bistatic = choices.flag();
  for (unsigned i = 0, count = 1 + choices.below(3); i < count; ++i) {
    const Direction transmit = direction(choices);
    sweep.looks.push_back({transmit, sweep.bistatic ? direction(choices) : transmit});
  }
  static constexpr double ranges[] = {3.0, 10.0, 1e3, 1e12};
  if (const unsigned near = choices.below(8); near < std::size(ranges))
    for (Look& look : sweep.looks) look.transmit_range = look.receive_range = ranges[near];
  return sweep;
}

SolveOptions options(Choices& choices) {
  SolveOptions o;
  o.threads = 1;
  o.keep_parts = choices.flag();
  const unsigned tubes = choices.below(4);
  o.tubes.mode = tubes == 0 ? TubeMode::uniform : TubeMode::adaptive;
  o.tubes.per_wavelength = o.tubes.max_per_wavelength = 0.5 + choices.below(8);
  o.tubes.curved = static_cast<CurvedSurfaces>(choices.below(3));
  o.tubes.max_bounces = static_cast<int>(1 + choices.below(6));
  o.tubes.skip = choices.flag();
  if (choices.flag()) o.tubes.up = dvec3(coordinate(choices), coordinate(choices), 1.0);
  o.edges.method = static_cast<EdgeMethod>(choices.below(3));
  o.edges.order = static_cast<int>(1 + choices.below(3));
  o.edges.interaction = choices.flag();
  o.edges.receiver_shadow = choices.flag();
  return o;
}

WedgeOptions wedges(Choices& choices) {
  const bool thin_plates = choices.flag();
  return {15.0 * choices.below(4) * degree, thin_plates};
}

void expect_finite(const SweepResult& result) {
  for (const ScatteringMatrix& s : result.total) expect(std::isfinite(frobenius_norm(s)), "every amplitude is finite");
  for (const ChannelErrors& e : result.error)
    expect(std::isfinite(e[0][0] + e[0][1] + e[1][0] + e[1][1]), "every error estimate is finite");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Choices choices(data, size);
  const Sweep asked = sweep(choices);
  const SolveOptions how = options(choices);
  const WedgeOptions edges = wedges(choices);
  try {
    const LoadedMesh loaded = build_mesh(mesh(choices), 1.0);
    expect_finite(solve(Target(loaded.mesh, edges), asked, how));
  } catch (const InputError& error) {
    expect_sentence(error.what());
  }
  return 0;
}
