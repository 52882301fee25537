#include "utd/strip_waves.h"

namespace raytube {

namespace {

constexpr double flattest_link = 1.02;  // n of an edge that is next to no edge at all

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

}  // namespace

StripWave strip_wave(std::span<const Wedge> wedges, std::uint32_t wedge, int face, const FaceIncidence& incidence, double sign) {
  const dvec3 direction = incidence.sin_cone * wedges[wedge].faces[face].into_face + incidence.cos_cone * incidence.tangent;
  return {wedge, face, incidence, sign, direction};
}

std::optional<FaceExit> strip_end(std::span<const Wedge> wedges, const Outlines& outlines, const StripWave& wave,
                                  const dvec3& point) {
  const FaceExit exit = outlines.exit(wedges[wave.wedge].faces[wave.face], wave.wedge, point, wave.direction);
  if (!exit.edge || exit.edge->smooth) return std::nullopt;
  return exit;
}

std::optional<std::array<StripWave, 2>> waves_beyond(std::span<const Wedge> wedges, const StripWave& wave,
                                                     const OutlineEdge& edge) {
  if (edge.wedge == no_index) return std::nullopt;
  const Wedge& next = wedges[edge.wedge];
  const double sine = -glm::dot(wave.direction, edge.into_face);
  if (next.n < flattest_link || sine < along_edge) return std::nullopt;
  const int own = edge.wedge_face, other = 1 - own;
  // t of the other face is opposite, and so is H along it.
  return std::array{
      strip_wave(wedges, edge.wedge, own, grazing_incidence(next, own, true, wave.direction, sine), -wave.sign),
      strip_wave(wedges, edge.wedge, other, grazing_incidence(next, other, false, wave.direction, sine), wave.sign)};
}

}  // namespace raytube
