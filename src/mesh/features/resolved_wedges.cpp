#include "mesh/features/resolved_wedges.h"

#include "mesh/features/surface_profile.h"

namespace raytube {

namespace {

// A face is at least half as wide at the middle of an edge as it is anywhere beside it, if it is convex.
bool is_narrow(const Wedge& wedge, double limit) {
  const auto narrow = [limit](const WedgeFace& face) { return face.width < 2 * limit; };
  return wedge.replaced_by == no_index && wedge.thickness() == 0.0 && std::ranges::any_of(wedge.faces, narrow);
}

// Where both faces go over into others the narrow one of the two is in nobody's way.
void replace_face(Wedge& wedge, int side, const SurfaceProfile& profile) {
  if (profile.face.patch != wedge.faces[side].patch) wedge.border_patch = wedge.faces[side].patch;
  wedge.faces[side] = profile.face;
  wedge.n -= profile.turn / pi;
}

// What is concave stays so: of a convex group of folds the convex ones carry the currents.
void resolve(const SurfaceProfiles& profiles, double limit, double min_wedge_angle, Wedge& wedge) {
  const std::array<SurfaceProfile, 2> sides{profiles.find(wedge, 0, limit), profiles.find(wedge, 1, limit)};
  Wedge resolved = wedge;
  for (int side = 0; side < 2; ++side) replace_face(resolved, side, sides[side]);
  resolved.n = std::min(resolved.n, 2.0);
  resolved.flat = std::abs(resolved.n - 1.0) * pi < min_wedge_angle;
  resolved.share = std::min(sides[0].reached, sides[1].reached) / (1.0 + sides[0].others + sides[1].others);
  if (wedge.convex() && resolved.convex())
    wedge = resolved;
  else if (wedge.convex() || resolved.flat)
    wedge.flat = true;
}

bool has_details(std::span<const Wedge> wedges, double limit) {
  return std::ranges::any_of(wedges, [limit](const Wedge& wedge) { return is_narrow(wedge, limit); });
}

}  // namespace

double detail_limit(double frequency) { return std::exp2(std::floor(std::log2(wavelength(frequency) / 50))); }

double known_details(std::span<const Wedge> wedges, double frequency) {
  const double limit = detail_limit(frequency);
  return has_details(wedges, limit) ? limit : 0.0;
}

void resolve_details(const TriangleMesh& mesh, std::span<Wedge> wedges, double limit, double min_wedge_angle) {
  if (!has_details(wedges, limit)) return;
  const SurfaceProfiles profiles(mesh, min_wedge_angle);
  for (Wedge& wedge : wedges)
    if (is_narrow(wedge, limit)) resolve(profiles, limit, min_wedge_angle, wedge);
}

}  // namespace raytube
