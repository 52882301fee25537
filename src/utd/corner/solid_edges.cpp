#include "utd/corner/solid_edges.h"

#include <algorithm>
#include <cmath>

#include "core/angle.h"
#include "math/smooth_step.h"
#include "math/special/elementary.h"
#include "utd/corner/corner_angles.h"
#include "utd/corner/wedge_ends.h"
#include "utd/wedge/rounding_guard.h"

namespace raytube {

namespace {

// The edge is 45 to 165 degrees off a plane.
bool is_edge_of_solid(const Wedge& wedge) {
  return wedge.radiates() && wedge.n > 1.25 && wedge.n < 1.0 + 165.0 / 180.0 && wedge.share == 1.0;
}

/// From the arc between two directions.
double angle_to_arc(const dvec3& direction, const dvec3& from, const dvec3& to) {
  const dvec3 normal = glm::normalize(glm::cross(from, to));
  if (glm::dot(direction, glm::cross(normal, from)) > 0 && glm::dot(direction, glm::cross(to, normal)) > 0)
    return std::asin(std::min(std::abs(glm::dot(direction, normal)), 1.0));
  return std::min(angle_between(direction, from), angle_between(direction, to));
}

}  // namespace

const SolidCorner& SolidCorners::solved() const {
  std::call_once(once_, [this] { corner_.emplace(shape_); });
  return *corner_;
}

// As of a plate's corners (corner_waves.cpp); nor is there a plane wave for a source over one of the corner's own faces, behind
// which it sets. Of edges closer together than 2 sqrt(2 / kL) each stands in the other's zone, and the corner sends no plane wave
// there: a tip of 30 degrees under waves of 3 lambda.
double SolidEnd::weight(const dvec3& towards, double wavenumber, double length) const {
  const double electrical = wavenumber * length, zone = 2.0 * std::sqrt(2.0 / electrical);
  const auto off = [&](double angle) { return -std::expm1(-electrical * angle * angle); };
  double product = 1.0, off_own_cone = pi;
  for (const int other : {1, 2}) {
    const double between = angle_between(edges[0], edges[other]), off_edge = angle_between(towards, edges[other]);
    const double electrical_length = wavenumber * other_lengths[other - 1];
    off_own_cone = std::min(off_own_cone, std::abs(angle_between(towards, edges[0]) + between - pi));
    product *= off(off_edge + between - pi) * -std::expm1(-electrical_length * electrical_length) *
               smooth_step(2.5 * (between / zone - 0.8));
  }
  const double off_faces = std::min({angle_to_arc(towards, edges[0], edges[1]), angle_to_arc(towards, edges[0], edges[2]),
                                     angle_to_arc(towards, edges[1], edges[2])});
  return product * off(off_own_cone) * off(off_faces);
}

SolidEnd::Passage SolidEnd::passage(const dvec3& towards, const std::array<dvec3, 2>& fields) const {
  const ComplexVector wave = corners->solved().start(local(towards));
  return {{dot(wave, local(fields[0])), dot(wave, local(fields[1]))}};
}

bool SolidEnd::sees(const dvec3& towards) const {
  const double side = glm::dot(edges[0], glm::cross(edges[1], edges[2]));
  const auto turned_to = [&](int a, int b) { return side * glm::dot(towards, glm::cross(edges[a], edges[b])) < 0.0; };
  return turned_to(0, 1) || turned_to(1, 2) || turned_to(2, 0);
}

double SolidEdge::length_weight(double wavenumber) const { return smooth_step(2.0 - wavenumber * length / (2.0 * pi * 20.0)); }

/// Looks for the corners between which edges run.
class SolidEdges::Finder {
 public:
  explicit Finder(std::span<const Wedge> wedges) : wedges_(wedges), ends_(wedges) {}

  std::optional<SolidEdge> edge(std::uint32_t index) {
    const Wedge& wedge = wedges_[index];
    if (!is_edge_of_solid(wedge)) return std::nullopt;
    const auto start = corner(2 * index), finish = start ? corner(2 * index + 1) : std::nullopt;
    if (!finish) return std::nullopt;
    return SolidEdge{{*start, *finish}, wedge.length(), wedge.n};
  }

  /// The edges that waves see for themselves, body by body: those of a body hang together by their ends.
  std::vector<std::vector<std::uint32_t>> bodies() {
    std::vector<bool> known(wedges_.size());
    std::vector<std::vector<std::uint32_t>> bodies;
    for (std::uint32_t first = 0; first < wedges_.size(); ++first) {
      if (known[first] || !wedges_[first].stands_alone()) continue;
      known[first] = true;
      std::vector<std::uint32_t>& body = bodies.emplace_back(1, first);
      for (std::size_t i = 0; i < body.size(); ++i)
        for (const std::uint32_t end : {2 * body[i], 2 * body[i] + 1})
          for (const std::uint32_t other : ends_.met_by(end, rounding_guard * wedges_[body[i]].length()))
            if (!known[other / 2]) known[other / 2] = true, body.push_back(other / 2);
      std::erase_if(body, [&](std::uint32_t i) { return !wedges_[i].stands_alone(); });
      std::ranges::sort(body);
    }
    return bodies;
  }

 private:
  /// The other two ends there, that in the first face of this one's wedge first.
  std::optional<std::array<std::uint32_t, 2>> beside(std::uint32_t end) {
    const Wedge& wedge = wedges_[end / 2];
    const double distance = rounding_guard * wedge.length();
    const auto met = ends_.met_by(end, distance);
    if (met.size() != 2 || !std::ranges::all_of(met, [&](std::uint32_t e) { return is_edge_of_solid(ends_.wedge(e)); }))
      return std::nullopt;
    const auto off = [&](std::uint32_t e) { return std::abs(glm::dot(ends_.direction(e), wedge.faces[0].normal)); };
    return off(met[0]) < off(met[1]) ? std::array{met[0], met[1]} : std::array{met[1], met[0]};
  }

  std::optional<SolidEnd> corner(std::uint32_t end) {
    const auto others = beside(end);
    if (!others) return std::nullopt;
    SolidEnd corner{
        .position = ends_.position(end), .edges = {ends_.direction(end)}, .other_lengths = {}, .beside = {}, .frame = {}};
    for (const int side : {0, 1}) {
      const WedgeFace& face = wedges_[end / 2].faces[side];
      const dvec3 edge = ends_.direction((*others)[side]);
      const double angle = angle_between(edge, corner.edges[0]);
      if (std::abs(glm::dot(edge, face.normal)) > off_plane || glm::dot(edge, face.into_face) <= 0.0 || angle < least_corner ||
          angle > greatest_corner)
        return std::nullopt;
      corner.edges[side + 1] = edge;
      corner.beside[side] = (*others)[side] / 2;
      corner.other_lengths[side] = wedges_[(*others)[side] / 2].length();
    }
    const auto rounded_to = [&](int other) { return rounded_corner(angle_between(corner.edges[0], corner.edges[other])); };
    const bool left_handed = glm::dot(corner.edges[0], glm::cross(corner.edges[1], corner.edges[2])) < 0.0;
    const bool turned = rounded_to(1) > rounded_to(2) || (rounded_to(1) == rounded_to(2) && left_handed);
    if (turned)
      std::swap(corner.edges[1], corner.edges[2]), std::swap(corner.other_lengths[0], corner.other_lengths[1]),
          std::swap(corner.beside[0], corner.beside[1]);
    const WedgeFace& first = wedges_[end / 2].faces[turned];
    corner.frame = {corner.edges[0], first.into_face, -first.normal};
    return corner;
  }

  std::span<const Wedge> wedges_;
  WedgeEnds ends_;
};

SolidEdges::SolidEdges(std::span<const Wedge> wedges) : edges_(wedges.size()) {
  Finder finder(wedges);
  for (std::vector<std::uint32_t>& body : finder.bodies()) {
    if (body.size() > most_edges) continue;
    std::ranges::stable_sort(body, std::ranges::greater{}, [&](std::uint32_t i) { return wedges[i].length(); });
    Shapes shapes;
    for (const std::uint32_t i : body)
      if (std::optional<SolidEdge> edge = finder.edge(i); edge && find_corners(*edge, shapes))
        edges_[i] = std::make_unique<SolidEdge>(*edge);
  }
}

bool SolidEdges::find_corners(SolidEdge& edge, Shapes& of_body) {
  for (SolidEnd& end : edge.ends) {
    const SolidCornerShape shape{rounded_corner(angle_between(end.edges[0], end.edges[1])),
                                 rounded_corner(angle_between(end.edges[0], end.edges[2])), rounded_corner((2.0 - edge.n) * pi)};
    const auto is_that = [&](const auto& s) { return s->shape() == shape; };
    if (const auto known = std::ranges::find_if(of_body, is_that); known != of_body.end()) {
      end.corners = *known;
      continue;
    }
    if (of_body.size() == most_shapes) return false;
    const auto known = std::ranges::find_if(shapes_, is_that);
    end.corners = known != shapes_.end() ? known->get() : shapes_.emplace_back(std::make_unique<SolidCorners>(shape)).get();
    of_body.push_back(end.corners);
  }
  return true;
}

}  // namespace raytube
