#include "utd/multiple/strip_waves.h"

#include <cmath>

#include "core/angle.h"
#include "math/smooth_step.h"
#include "utd/wedge/rounding_guard.h"

namespace raytube {

namespace {

// The arriving strip as a wave that grazes one face of the next wedge: its own (phi' = 0) or the other one (phi' = n pi).
FaceIncidence grazing_incidence(const Wedge& wedge, int face, bool own, const dvec3& direction, double sine) {
  FaceIncidence result;
  result.tangent = glm::cross(wedge.faces[face].into_face, wedge.faces[face].normal);
  result.cos_cone = glm::dot(direction, result.tangent);
  result.sin_cone = sine;
  result.source_angle = own ? 0.0 : wedge.n * pi;
  result.lit = own;
  return result;
}

dvec3 strip_direction(const WedgeFace& face, const FaceIncidence& incidence) {
  return incidence.sin_cone * face.into_face + incidence.cos_cone * incidence.tangent;
}

}  // namespace

StripWave first_wave(std::span<const Wedge> wedges, std::uint32_t wedge, int face, const FaceIncidence& incidence,
                     const dvec3& incident, int order) {
  const WedgeFace& lit = wedges[wedge].faces[face];
  const bool grazes = std::abs(glm::dot(incident, lit.normal)) <= lit_threshold;
  return {wedge, face, incidence, 1.0, order, grazes, strip_direction(lit, incidence), lit.into_face, wedge, face};
}

const OutlineEdge* strip_end(const Outlines& outlines, const WedgeFace& face, const StripWave& wave, const dvec3& point) {
  const OutlineEdge* edge = outlines.exit(face, wave.wedge, point, wave.direction).edge;
  return edge && !edge->smooth ? edge : nullptr;
}

std::optional<std::array<StripWave, 2>> waves_beyond(std::span<const Wedge> wedges, const StripWave& wave,
                                                     const OutlineEdge& edge) {
  if (edge.wedge == no_index) return std::nullopt;
  const Wedge& next = wedges[edge.wedge];
  // A half plane is met over both of its faces at once.
  const bool anew = wave.lights_far_edges && next.n < 2.0 - rounding_guard;
  const int left = anew ? wave.strips_left : wave.strips_left - 1;
  if (left == 0) return std::nullopt;
  const double sine = -glm::dot(wave.direction, edge.into_face);
  // An edge of n below 1.02 is next to none.
  if (next.n < 1.02 || sine < along_edge) return std::nullopt;
  const auto beyond = [&](int face, bool own, double sign) {
    const FaceIncidence incidence = grazing_incidence(next, face, own, wave.direction, sine);
    const WedgeFace& lit = next.faces[face];
    return StripWave{edge.wedge,    face,       incidence, sign, left, false, strip_direction(lit, incidence),
                     lit.into_face, edge.wedge, face};
  };
  const StripWave own = beyond(edge.wedge_face, true, -wave.sign);
  // Both sides of a half plane carry the same current, as that of a wave that grazes them.
  if (ends_sheet(next)) return std::array{own, beyond(1 - edge.wedge_face, true, -wave.sign)};
  // t of the other face is opposite, and so is H along it.
  return std::array{own, beyond(1 - edge.wedge_face, false, wave.sign)};
}

// Two mirrors are those where three faces meet; between parallel walls there would be no end of them.
std::optional<StripWave> mirrored_wave(std::span<const Wedge> wedges, const StripWave& wave, const OutlineEdge& edge) {
  if (edge.wedge == no_index || !wedges[edge.wedge].conducting() || wave.mirrors == 2) return std::nullopt;
  // An image in a face that stands by an angle off the right one is turned by twice that: over strips of ten wavelengths it goes
  // out of phase by a tenth of a radian at 0.05 degrees, and by a whole one at half a degree. In between images fade.
  const double off = std::abs(wedges[edge.wedge].n - 0.5) * pi;
  const double share = smooth_step((0.5 * degree - off) / (0.5 * degree - 0.05 * degree));
  if (share == 0.0) return std::nullopt;
  if (-glm::dot(wave.direction, edge.into_face) < along_edge) return std::nullopt;
  StripWave result = wave;
  for (dvec3* each : {&result.direction, &result.across, &result.incidence.tangent}) *each = glm::reflect(*each, edge.into_face);
  result.wedge = edge.wedge;
  result.face = edge.wedge_face;
  result.sign = -share * wave.sign;
  ++result.mirrors;
  return result;
}

}  // namespace raytube
