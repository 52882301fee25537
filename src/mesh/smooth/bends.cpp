#include "mesh/smooth/bends.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/angle.h"

namespace raytube {

namespace {

constexpr double most_bend = 60.0 * degree;  // nothing is like the surface whose chords turn by more
constexpr double longest = 8.0;              // reach of a section, in widths of the narrower facet at the crease
constexpr double furthest = 2.0;             // widths: what lies beyond it explains nothing
constexpr int most_steps = 64;               // triangles that it passes
constexpr double least_side = 0.25;          // of a crease that either side explains
constexpr double least_bending = 0.1;        // of the threshold: flatter creases are planes
constexpr double most_hollow = 1.0 / 3.0;    // of the threshold: diagonals of facets may be as hollow
constexpr double next_crease = 0.5;          // widths: closer creases are one step

/// A crease that a section crosses.
struct Step {
  double distance;  // from where it began, in widths
  double turn;      // in its plane, above zero as the crease where it began [rad]
  bool steep;       // as a wedge
};

using Profile = std::vector<Step>;

// Between the mean normals of the widths before and after the point so many widths away.
double turn_about(const Profile& profile, double distance) {
  double sum = 0.0;
  for (const Step& step : profile) sum += step.turn * std::max(0.0, 1.0 - std::abs(step.distance - distance));
  return sum;
}

// What the surface would turn by where the profile begins if it went on as it comes: as it turns a width away, and by as much
// more as it turns there more than at two.
double explained(const Profile& profile) {
  const double near = turn_about(profile, 1.0);
  return near + std::max(0.0, near - turn_about(profile, 2.0));
}

// Before the surface turns flat or back there are two steps flatter than wedges: one is how fillets end.
bool ends_in_tessellation(const Profile& profile, double threshold) {
  const double flat = least_bending * threshold;
  constexpr double nowhere = std::numeric_limits<double>::infinity();
  double first = nowhere;
  for (const Step& step : profile) {
    if (step.turn < -most_hollow * threshold) return false;
    if (step.steep) first = nowhere;
    if (step.steep || step.turn <= flat) continue;
    if (step.distance >= first + next_crease) return true;
    first = std::min(first, step.distance);
  }
  return false;
}

/// The plane across the middle of an edge.
struct Section {
  dvec3 middle, along;
  double beyond(const dvec3& point) const { return glm::dot(point - middle, along); }
  dvec3 in_plane(const dvec3& vector) const { return vector - glm::dot(vector, along) * along; }
};

class BendFinder {
 public:
  BendFinder(const TriangleMesh& mesh, double min_wedge_angle)
      : mesh_(mesh), min_wedge_angle_(min_wedge_angle), edges_(mesh.edges()) {}

  std::vector<Bend> find() const {
    const double flattest = std::cos(min_wedge_angle_), steepest = std::cos(most_bend);
    std::vector<Bend> bends;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const EdgeTable::Edge edge = edges_[e];
      if (edge.sides.size() != 2) continue;
      const double cosine = glm::dot(normal(edge.sides[0]), normal(edge.sides[1]));
      if (cosine <= flattest && cosine >= steepest && mesh_.is_surface(edge) && is_bend(edge))
        bends.push_back({edge.low, edge.high, std::acos(cosine)});
    }
    return bends;
  }

 private:
  const dvec3& normal(const EdgeTable::Side& side) const { return mesh_.patch_of(side.triangle).normal; }

  // Between the facets, above zero where the surface is convex [rad].
  double turn(const EdgeTable::Edge& edge, const EdgeTable::Side& from) const {
    const EdgeTable::Side& to = edge.beside(from.triangle);
    const dvec3& tip = mesh_.vertices[mesh_.triangles[to.triangle][(to.corner + 2) % 3]];
    const double angle = angle_between(normal(from), normal(to));
    return glm::dot(normal(from), tip - mesh_.vertices[edge.low]) < 0.0 ? angle : -angle;
  }

  double width(const EdgeTable::Edge& edge, const EdgeTable::Side& side) const {
    return mesh_.twice_area(side.triangle) / glm::distance(mesh_.vertices[edge.high], mesh_.vertices[edge.low]);
  }

  bool is_bend(const EdgeTable::Edge& edge) const {
    const EdgeTable::Side &a = edge.sides[0], &b = edge.sides[1];
    const double own = turn(edge, a), unit = std::min(width(edge, a), width(edge, b)), sign = std::copysign(1.0, own);
    const Profile left = profile(edge, a, unit, sign);
    if (!ends_in_tessellation(left, min_wedge_angle_)) return false;
    const Profile right = profile(edge, b, unit, sign);
    if (!ends_in_tessellation(right, min_wedge_angle_)) return false;
    const double all = std::abs(own) + turn_about(left, 0.0) + turn_about(right, 0.0);
    const double before = explained(left), after = explained(right);
    return std::min(before, after) >= least_side * all && before + after >= all;
  }

  // The side over which a section that came over edge `entry` leaves, if it does. A corner in the plane counts as beyond it: there is one.
  std::optional<EdgeTable::Side> exit_of(const Section& section, std::uint32_t triangle, std::uint32_t entry) const {
    const Triangle& t = mesh_.triangles[triangle];
    const auto is_beyond = [&](std::uint32_t corner) { return section.beyond(mesh_.vertices[t[corner % 3]]) >= 0.0; };
    for (std::uint32_t corner = 0; corner < 3; ++corner)
      if (edges_.edge_of(triangle, static_cast<int>(corner)) != entry && is_beyond(corner) != is_beyond(corner + 1))
        return EdgeTable::Side(triangle, corner);
    return {};
  }

  dvec3 crossing(const Section& section, const EdgeTable::Edge& edge) const {
    const double here = section.beyond(mesh_.vertices[edge.low]), there = section.beyond(mesh_.vertices[edge.high]);
    return glm::mix(mesh_.vertices[edge.low], mesh_.vertices[edge.high], here / (here - there));
  }

  Step step_over(const Section& section, const EdgeTable::Edge& edge, const EdgeTable::Side& from, double distance) const {
    const double whole = turn(edge, from);
    const double part = angle_between(section.in_plane(normal(from)), section.in_plane(normal(edge.beside(from.triangle))));
    return {distance, std::copysign(part, whole), std::abs(whole) >= min_wedge_angle_};
  }

  // From an edge over the facet of one of its sides onwards; turns times `sign`.
  Profile profile(const EdgeTable::Edge& start, EdgeTable::Side side, double unit, double sign) const {
    const dvec3 &low = mesh_.vertices[start.low], &high = mesh_.vertices[start.high];
    const Section section{0.5 * (low + high), glm::normalize(high - low)};
    Profile steps;
    dvec3 at = section.middle;
    double distance = 0.0;
    for (int i = 0; i < most_steps; ++i) {
      const auto exit = exit_of(section, side.triangle, edges_.edge_of(side.triangle, static_cast<int>(side.corner)));
      if (!exit) break;
      const EdgeTable::Edge edge = edges_[edges_.edge_of(exit->triangle, static_cast<int>(exit->corner))];
      const dvec3 next = crossing(section, edge);
      distance += glm::distance(at, next) / unit;
      if (distance > longest || !mesh_.is_surface(edge)) break;
      side = edge.beside(exit->triangle);
      at = next;
      if (mesh_.triangle_patch[exit->triangle] == mesh_.triangle_patch[side.triangle]) continue;
      if (steps.empty() && distance > furthest) break;
      steps.push_back(step_over(section, edge, *exit, distance));
      steps.back().turn *= sign;
    }
    return steps;
  }

  const TriangleMesh& mesh_;
  double min_wedge_angle_;
  const EdgeTable& edges_;
};

}  // namespace

std::vector<Bend> find_bends(const TriangleMesh& mesh, double min_wedge_angle) {
  return BendFinder(mesh, min_wedge_angle).find();
}

}  // namespace raytube
