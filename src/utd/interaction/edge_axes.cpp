#include "utd/interaction/edge_axes.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "scene/frequency_bands.h"

namespace raytube {

namespace {

// Ends of concave wedges by position. Corners that are one have the same coordinates to the bit.
using ConcaveEnds = std::multimap<std::tuple<double, double, double>, const Wedge*>;

std::tuple<double, double, double> key(const dvec3& point) { return {point.x, point.y, point.z}; }

ConcaveEnds concave_ends(std::span<const Wedge> wedges, const std::vector<bool>& mirrors) {
  const auto is_mirror = [&](const WedgeFace& face) { return face.material == no_index || mirrors[face.material]; };
  ConcaveEnds ends;
  for (const Wedge& wedge : wedges) {
    if (wedge.convex() || !std::ranges::all_of(wedge.faces, is_mirror)) continue;
    ends.emplace(key(wedge.start), &wedge);
    ends.emplace(key(wedge.end), &wedge);
  }
  return ends;
}

// Whether something of the mesh rises above one of the wedge's faces.
bool anything_in_front(const TriangleMesh& mesh, const Wedge& wedge) {
  const double flat = flat_fraction * 2 * mesh.radius;
  return std::ranges::any_of(mesh.vertices, [&](const dvec3& vertex) {
    return glm::dot(vertex - wedge.start, wedge.faces[0].normal) > flat ||
           glm::dot(vertex - wedge.start, wedge.faces[1].normal) > flat;
  });
}

// The faces of the wedge that meet a further surface in a concave edge at this end, beyond which the edge would run behind it.
std::vector<int> abutting_faces_at(const ConcaveEnds& ends, const Wedge& wedge, const dvec3& end, const dvec3& outwards) {
  std::vector<int> faces;
  const auto [first, last] = ends.equal_range(key(end));
  for (auto concave = first; concave != last; ++concave)
    for (int own = 0; own < 2; ++own)
      for (int shared = 0; shared < 2; ++shared) {
        const WedgeFace& face = concave->second->faces[shared];
        const bool same = face.patch == wedge.faces[own].patch && face.back == wedge.faces[own].back;
        if (same && glm::dot(concave->second->faces[1 - shared].normal, outwards) < 0.0) faces.push_back(own);
      }
  return faces;
}

EdgeAxis axis_of(const Wedge& wedge, const ConcaveEnds& ends) {
  EdgeAxis axis{&wedge, wedge.start, glm::cross(wedge.faces[0].into_face, wedge.faces[0].normal), wedge.length()};
  const bool reversed = glm::dot(wedge.end - wedge.start, axis.tangent) < 0.0;
  if (reversed) axis.origin = wedge.end;
  axis.abutting_faces[0] = abutting_faces_at(ends, wedge, axis.origin, -axis.tangent);
  axis.abutting_faces[1] = abutting_faces_at(ends, wedge, reversed ? wedge.start : wedge.end, axis.tangent);
  return axis;
}

}  // namespace

double incidence_weight(const Wedge& wedge, const WedgeIncidence& incidence) {
  constexpr double least_sine = 1e-4;  // below this sine of the cone light runs along the edge, which sends no wave then
  const FaceIncidence& face = incidence.faces[0];
  if (face.sin_cone < least_sine) return 0.0;
  if (wedge.n != 2.0) return incidence.weight;
  const double share = std::min({face.source_angle, 2 * pi - face.source_angle, degree}) / degree;
  return incidence.weight * share * share * (3 - 2 * share);
}

LitInterval along_wedge(const LitEdgePiece& piece) {
  const EdgeAxis& axis = *piece.edge;
  const double from = piece.from / axis.length, to = piece.to / axis.length;
  return axis.reversed() ? LitInterval{1.0 - to, 1.0 - from} : LitInterval{from, to};
}

std::vector<PlainPart> plain_parts(const LitEdgePiece& piece, const LookVectors& look, std::span<const double> wavenumbers,
                                   double radius) {
  const LitInterval lit = along_wedge(piece);
  const PlaneWave& wave = *piece.wave;
  if (!wave.antennas) return {{lit, look_of(wave, look), wave.path}};
  std::vector<NearPiece> near;
  PieceCutter(*wave.antennas, sampling_wavenumber(wavenumbers), radius).cut(*piece.edge->wedge, lit.begin, lit.end, near);
  std::vector<PlainPart> parts;
  for (const NearPiece& part : near) parts.push_back({{part.begin, part.end}, part.look, part.path});
  return parts;
}

std::vector<EdgeAxis> edge_axes(const TriangleMesh& mesh, std::span<const Wedge> wedges, const std::vector<bool>& mirrors) {
  const ConcaveEnds ends = concave_ends(wedges, mirrors);
  std::vector<EdgeAxis> axes;
  for (const Wedge& wedge : wedges)
    if (wedge.radiates() && anything_in_front(mesh, wedge)) axes.push_back(axis_of(wedge, ends));
  return axes;
}

}  // namespace raytube
