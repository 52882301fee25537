#include "mesh/features/resolved_wedges.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/features/patch_borders.h"

namespace raytube {

namespace {

constexpr int most_steps = 4096;       // triangles that one profile passes
constexpr double turned_back = 0.05;   // of its length: a profile that ends so close to its beginning has no chord
constexpr double no_direction = 1e-3;  // sine: the normal of a triangle so close to the edge's direction says nothing

/// The surface from the middle of a wedge onwards over one of its faces, in the plane across the wedge.
struct SurfaceProfile {
  WedgeFace face;        // from the edge to where the profile ends: direction and normal of the chord, patch of the end
  double turn = 0.0;     // of the chord against the wedge's own face, towards the free space [rad]
  int others = 0;        // further convex edges in its first half
  double reached = 1.0;  // of the length; less if it ends at a border, where several surfaces meet, or back where it began
};

/// Follows the surface of a mesh, which must outlive it.
class SurfaceProfiles {
 public:
  /// Creases of less than `min_wedge_angle` [rad] are no edges, nor are its bends.
  SurfaceProfiles(const TriangleMesh& mesh, double min_wedge_angle)
      : mesh_(mesh), min_wedge_angle_(min_wedge_angle), edges_(mesh.edges()), borders_(mesh) {}

  /// `length` [m] along the surface from the middle of the wedge, starting on faces[side].
  SurfaceProfile find(const Wedge& wedge, int side, double length) const {
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

 private:
  /// The plane across the wedge, with the axes x_f and n_f of its face and the origin in its middle.
  struct Section {
    Section(const Wedge& wedge, int side)
        : face(wedge.faces[side]), middle(0.5 * (wedge.start + wedge.end)), along(glm::cross(face.into_face, face.normal)) {}
    double beyond(const dvec3& point) const { return glm::dot(point - middle, along); }
    dvec2 in_plane(const dvec3& vector) const { return {glm::dot(vector, face.into_face), glm::dot(vector, face.normal)}; }

    const WedgeFace& face;
    dvec3 middle, along;
  };
  /// The profile in one triangle. The side over which it leaves begins at corner `exit`.
  struct Step {
    std::uint32_t triangle = no_index;
    int exit = 0;
    dvec2 from, to;
    bool back = false;  // the free space is on the triangle's back
  };

  /// How far the profile has come [m].
  struct PatchLengths {
    double first = 0.0, total = 0.0, in_last = 0.0;  // in the first patch; in all but the last; in the last
    bool on_first = true;

    void leave() {
      if (on_first) first = in_last;
      on_first = false;
      total += in_last;
      in_last = 0.0;
    }
  };

  // The sides of a triangle that cross the plane, by the corner at which they begin. A corner in the plane counts as beyond it,
  // so that there are always two or none.
  std::vector<int> crossed_sides(const Section& section, std::uint32_t triangle) const {
    std::vector<int> sides;
    const Triangle& corners = mesh_.triangles[triangle];
    const auto is_beyond = [&](int corner) { return section.beyond(mesh_.vertices[corners[corner % 3]]) >= 0.0; };
    for (int corner = 0; corner < 3; ++corner)
      if (is_beyond(corner) != is_beyond(corner + 1)) sides.push_back(corner);
    return sides;
  }

  // From the same end whichever triangle asks: neighbours agree to the bit.
  dvec2 crossing(const Section& section, std::uint32_t triangle, int corner) const {
    const Triangle& corners = mesh_.triangles[triangle];
    const auto [low, high] = std::minmax(corners[corner], corners[(corner + 1) % 3]);
    const double here = section.beyond(mesh_.vertices[low]), there = section.beyond(mesh_.vertices[high]);
    return section.in_plane(glm::mix(mesh_.vertices[low], mesh_.vertices[high], here / (here - there)) - section.middle);
  }

  // The triangle of the face on whose side the middle of the wedge lies.
  Step first_step(const Section& section) const {
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
  Step next_step(const Section& section, const Step& step) const {
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
  double bend(const Section& section, const Step& from, const Step& to) const {
    const auto normal = [&](const Step& step) {
      const dvec3& front = mesh_.patch_of(step.triangle).normal;
      return section.in_plane(step.back ? -front : front);
    };
    const dvec2 before = normal(from), after = normal(to);
    if (std::min(glm::length(before), glm::length(after)) < no_direction) return 0.0;
    return std::atan2(before.x * after.y - before.y * after.x, glm::dot(before, after));
  }

  // A convex one.
  bool is_edge(const Section& section, const Step& from, const Step& to) const {
    const Triangle& corners = mesh_.triangles[from.triangle];
    return bend(section, from, to) <= -min_wedge_angle_ && !mesh_.is_bend(corners[from.exit], corners[(from.exit + 1) % 3]);
  }

  // The patch of `last` in the section: along the surface from the wedge onwards, or along the chord where no facet is wide
  // enough.
  WedgeFace face_at_end(const Section& section, const Step& last, const dvec2& along) const {
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
  void end_profile(const Section& section, const Step& last, const dvec2& chord, const PatchLengths& lengths,
                   SurfaceProfile& profile) const {
    const double half = 0.5 * (lengths.total + lengths.in_last);
    if (lengths.on_first || lengths.first > half) return;
    if (glm::length(chord) < turned_back * 2 * half) return;
    const dvec2 along = glm::normalize(lengths.in_last > half ? last.to - last.from : chord);
    profile.face = face_at_end(section, last, along);
    profile.turn = std::atan2(along.y, along.x);
  }

  const TriangleMesh& mesh_;
  double min_wedge_angle_;
  const EdgeTable& edges_;
  PatchBorders borders_;
};

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
