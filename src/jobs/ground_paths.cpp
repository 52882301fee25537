#include "jobs/ground_paths.h"

namespace raytube {

namespace {

constexpr std::array<GroundPath, 4> paths{{{false, false}, {false, true}, {true, false}, {true, true}}};

// Components of spherical_basis are exact on the horizon, too.
Direction mirrored(const Direction& direction) { return {pi - direction.theta, direction.phi}; }

// As SurfaceResponse has it: phi_hat is t, and theta_hat of direction and mirrored direction are d x t and d_r x t.
SurfaceResponse::Polarised reflection(const Ground& ground, std::size_t frequency_index, double k, double cosine) {
  if (ground.perfect()) return perfect_conductor.reflected;
  return response(*ground.material, frequency_index, k, cosine, false).reflected;
}

}  // namespace

std::span<const GroundPath> ground_paths(const Ground& ground) { return std::span(paths).first(ground.perfect() ? 2 : 4); }

Sweep sweep_of_paths(const Sweep& sweep, const Ground& ground) {
  Sweep all = sweep;
  all.bistatic = true;
  all.looks.clear();
  for (const Look& look : sweep.looks)
    for (const GroundPath& path : ground_paths(ground))
      all.looks.push_back({path.lit_by_ground ? mirrored(look.transmit) : look.transmit,
                           path.seen_by_ground ? mirrored(look.receive) : look.receive});
  return all;
}

std::array<Complex, 2> ground_reflection(const Ground& ground, const Direction& direction, std::size_t frequency_index,
                                         double frequency) {
  const double cosine = spherical_basis(direction).radial.z, k = wavenumber(frequency);
  const SurfaceResponse::Polarised ratio = reflection(ground, frequency_index, k, cosine);
  const Complex phase = std::polar(1.0, 2.0 * k * ground.height * cosine);
  return {ratio.tm * phase, ratio.te * phase};
}

}  // namespace raytube
