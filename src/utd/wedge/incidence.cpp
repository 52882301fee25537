#include "utd/wedge/incidence.h"

#include <algorithm>
#include <cmath>

namespace raytube {

namespace {

// The direction towards the source, projected on the plane across the edge: (cos phi', sin phi') sin(beta').
struct AcrossEdge {
  double along_face;
  double above_face;

  bool in_face_plane() const { return std::abs(above_face) <= lit_threshold; }
  bool arrives_over_face() const { return in_face_plane() && along_face > 0.0; }
};

AcrossEdge across_edge(const WedgeFace& face, const dvec3& incident) {
  return {-glm::dot(incident, face.into_face), -glm::dot(incident, face.normal)};
}

// A dark face has its source at pi <= phi' <= n pi: rounding must not put it in front of the face or into the metal.
double source_angle(const AcrossEdge& source, bool lit, double n) {
  if (lit) return std::atan2(source.above_face, source.along_face);
  const double angle = std::atan2(std::min(source.above_face, 0.0), source.along_face);
  return std::min(angle > 0.0 ? angle : angle + 2 * pi, n * pi);
}

FaceIncidence incidence_on_face(const WedgeFace& face, const AcrossEdge& source, double n, const dvec3& incident) {
  FaceIncidence result;
  result.tangent = glm::cross(face.into_face, face.normal);
  result.cos_cone = glm::dot(incident, result.tangent);
  result.sin_cone = std::max(std::hypot(source.along_face, source.above_face), sin_cone_floor);
  result.lit = source.above_face > lit_threshold;
  result.source_angle = source_angle(source, result.lit, n);
  return result;
}

void count_half(WedgeIncidence& wedge, int grazed, const WedgeFace& face) {
  wedge.weight = 0.5;
  wedge.free_side = face.normal;
  wedge.faces[grazed].lit = true;
  wedge.faces[grazed].source_angle = 0.0;
}

// Neither face is lit: the source is behind the wedge, or exactly in the plane of a face.
void decide_grazing(WedgeIncidence& result, const Wedge& wedge, const std::array<AcrossEdge, 2>& sources) {
  if (result.faces[0].sin_cone <= sin_cone_floor) return;
  const bool over_first = sources[0].arrives_over_face(), over_second = sources[1].arrives_over_face();
  if (over_first != over_second) count_half(result, over_first ? 0 : 1, wedge.faces[over_first ? 0 : 1]);
  if (!over_first && !over_second && sources[0].in_face_plane() && sources[1].in_face_plane()) result.weight = 1.0;
}

}  // namespace

WedgeIncidence incidence_on(const Wedge& wedge, const dvec3& incident) {
  WedgeIncidence result;
  std::array<AcrossEdge, 2> sources;
  for (int face = 0; face < 2; ++face) {
    sources[face] = across_edge(wedge.faces[face], incident);
    result.faces[face] = incidence_on_face(wedge.faces[face], sources[face], wedge.n, incident);
  }
  if (result.faces[0].lit || result.faces[1].lit)
    result.weight = 1.0;
  else
    decide_grazing(result, wedge, sources);
  return result;
}

}  // namespace raytube
