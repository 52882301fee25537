#include "mesh/features/surface_profile.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raytube {

namespace {

constexpr int most_steps = 4096;       // triangles that one profile passes
constexpr double turned_back = 0.05;   // of its length: a profile that ends so close to its beginning has no chord
constexpr double no_direction = 1e-3;  // sine: the normal of a triangle so close to the edge's direction says nothing

}  // namespace

SurfaceProfiles::Section::Section(const Wedge& wedge, int side)
    : face(wedge.faces[side]), middle(0.5 * (wedge.start + wedge.end)), along(glm::cross(face.into_face, face.normal)) {}

SurfaceProfiles::SurfaceProfiles(const TriangleMesh& mesh, double min_wedge_angle)
    : mesh_(mesh), min_wedge_angle_(min_wedge_angle), edges_(mesh.edges()), borders_(mesh) {}

// The sides of a triangle that cross the plane, by the corner at which they begin. A corner in the plane counts as beyond it, so
// that there are always two or none.
std::vector<int> SurfaceProfiles::crossed_sides(const Section& section, std::uint32_t triangle) const {
  std::vector<int> sides;
  const Triangle& corners = mesh_.triangles[triangle];
  const auto is_beyond = [&](int corner) { return section.beyond(mesh_.vertices[corners[corner % 3]]) >= 0.0; };
  for (int corner = 0; corner < 3; ++corner)
    if (is_beyond(corner) != is_beyond(corner + 1)) sides.push_back(corner);
  return sides;
}

// From the same end whichever triangle asks: neighbours agree to the bit.
dvec2 SurfaceProfiles::crossing(const Section& section, std::uint32_t triangle, int corner) const {
  const Triangle& corners = mesh_.triangles[triangle];
  const auto [low, high] = std::minmax(corners[corner], corners[(corner + 1) % 3]);
  const double here = section.beyond(mesh_.vertices[low]), there = section.beyond(mesh_.vertices[high]);
  return section.in_plane(glm::mix(mesh_.vertices[low], mesh_.vertices[high], here / (here - there)) - section.middle);
}

// The triangle of the face on whose side the middle of the wedge lies.
SurfaceProfiles::Step SurfaceProfiles::first_step(const Section& section) const {
  Step best;
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::uint32_t triangle : mesh_.of_patch()[section.face.patch]) {
    const std::vector<int> sides = crossed_sides(section, triangle);
    for (std::size_t entry = 0; entry < sides.size(); ++entry) {
      const dvec2 from = crossing(section, triangle, sides[entry]);
      if (!(glm::length(from) < nearest)) continue;
      nearest = glm::length(from);
      const int exit = sides[1 - entry];
      best = {triangle, exit, from, crossing(section, triangle, exit), section.face.back};
    }
  }
  return best;
}

// Over an edge that has another triangle, and no more than one.
SurfaceProfiles::Step SurfaceProfiles::next_step(const Section& section, const Step& step) const {
  const std::uint32_t shared = edges_.edge_of(step.triangle, step.exit);
  const EdgeTable::Edge edge = edges_[shared];
  if (edge.sides.size() != 2) return {};
  const EdgeTable::Side& side = edge.beside(step.triangle);
  const bool turned = mesh_.triangles[side.triangle][side.corner] == mesh_.triangles[step.triangle][step.exit];
  for (const int exit : crossed_sides(section, side.triangle))
    if (edges_.edge_of(side.triangle, exit) != shared)
      return {side.triangle, exit, step.to, crossing(section, side.triangle, exit), step.back != turned};
  return {};
}

// The surface's change of direction from one triangle to the next, positive where it rises into the free space [rad].
double SurfaceProfiles::bend(const Section& section, const Step& from, const Step& to) const {
  const auto normal = [&](const Step& step) {
    const dvec3& front = mesh_.patch_of(step.triangle).normal;
    return section.in_plane(step.back ? -front : front);
  };
  const dvec2 before = normal(from), after = normal(to);
  if (std::min(glm::length(before), glm::length(after)) < no_direction) return 0.0;
  return std::atan2(before.x * after.y - before.y * after.x, glm::dot(before, after));
}

// A convex one.
bool SurfaceProfiles::is_edge(const Section& section, const Step& from, const Step& to) const {
  const Triangle& corners = mesh_.triangles[from.triangle];
  return bend(section, from, to) <= -min_wedge_angle_ && !mesh_.is_bend(corners[from.exit], corners[(from.exit + 1) % 3]);
}

// The patch of `last` in the section: along the surface from the wedge onwards, or along the chord where no facet is wide enough.
WedgeFace SurfaceProfiles::face_at_end(const Section& section, const Step& last, const dvec2& along) const {
  const WedgeFace& own = section.face;
  const std::uint32_t patch = mesh_.triangle_patch[last.triangle];
  WedgeFace result{patch,
                   along.x * own.into_face + along.y * own.normal,
                   along.x * own.normal - along.y * own.into_face,
                   own.width,
                   last.back,
                   mesh_.patches[patch].material};
  for (const std::uint32_t vertex : borders_[patch])
    result.width = std::max(result.width, glm::dot(mesh_.vertices[vertex] - section.middle, result.into_face));
  return result;
}

// What makes up more than half of the profile is its direction: the first facet, or the last one; else the chord.
void SurfaceProfiles::end_profile(const Section& section, const Step& last, const dvec2& chord, const PatchLengths& lengths,
                                  SurfaceProfile& profile) const {
  const double half = 0.5 * (lengths.total + lengths.in_last);
  if (lengths.on_first || lengths.first > half) return;
  if (glm::length(chord) < turned_back * 2 * half) return;
  const dvec2 along = glm::normalize(lengths.in_last > half ? last.to - last.from : chord);
  profile.face = face_at_end(section, last, along);
  profile.turn = std::atan2(along.y, along.x);
}

SurfaceProfile SurfaceProfiles::find(const Wedge& wedge, int side, double length) const {
  const Section section(wedge, side);
  SurfaceProfile result{section.face};
  const Step first = first_step(section);
  PatchLengths lengths;
  Step step = first;
  for (int count = 0; step.triangle != no_index && count < most_steps; ++count) {
    const double width = glm::length(step.to - step.from), reached = lengths.total + lengths.in_last;
    if (reached + width >= length) {
      lengths.in_last += length - reached;
      end_profile(section, step, step.from + (length - reached) / width * (step.to - step.from), lengths, result);
      return result;
    }
    lengths.in_last += width;
    const Step next = next_step(section, step);
    if (next.triangle == no_index || next.triangle == first.triangle) {
      result.reached = (reached + width) / length;
      break;
    }
    if (reached + width < 0.5 * length && is_edge(section, step, next)) ++result.others;
    if (mesh_.triangle_patch[next.triangle] != mesh_.triangle_patch[step.triangle]) lengths.leave();
    step = next;
  }
  return result;
}

}  // namespace raytube
