#include "mesh/features/thin_plates.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "mesh/features/edge_sectors.h"

namespace raytube {

namespace {

constexpr double taper = 3.0 * degree;      // between the sides of a plate, and between the edges of its border face
constexpr double slant = 20.0 * degree;     // between the border face and the upright on the sides
constexpr double least_side = 2.0;          // breadth of the sides over the thickness
constexpr double least_facing = 0.5;        // of the shorter edge
constexpr double corner_tolerance = 0.05;   // of the thickness, by which a corner's edge may be longer
constexpr double overlap_tolerance = 1e-6;  // of an edge's length: neighbouring border faces meet

/// An edge and which of its faces may be a border face.
struct BorderEdge {
  std::uint32_t wedge;
  int face;
};

/// A line parallel to a border face, or nearly so, by the distance gone in the direction `along` of that face.
struct Line {
  dvec3 origin, direction;  // direction . along = 1

  Line(const Wedge& wedge, const dvec3& start, const dvec3& along) {
    const dvec3 edge = wedge.end - wedge.start;
    direction = edge / glm::dot(edge, along);
    origin = wedge.start - glm::dot(wedge.start - start, along) * direction;
  }
  dvec3 at(double distance) const { return origin + distance * direction; }
};

struct Span {
  double begin, end;
};

Span span_of(const Wedge& wedge, const dvec3& start, const dvec3& along) {
  const auto [begin, end] = std::minmax({glm::dot(wedge.start - start, along), glm::dot(wedge.end - start, along)});
  return {begin, end};
}

/// Of two edges, each with the face that may be the border face (`border`) and the one that may be a side of the plate.
bool could_bound(const WedgeFace& border, const WedgeFace& side, const WedgeFace& other_border, const WedgeFace& other_side) {
  return glm::dot(border.into_face, other_border.into_face) < -std::cos(taper) &&
         glm::dot(side.into_face, other_side.into_face) > std::cos(taper) &&
         std::abs(glm::dot(border.into_face, side.into_face)) < std::sin(slant) &&
         std::abs(glm::dot(other_border.into_face, other_side.into_face)) < std::sin(slant);
}

double length(const Span& span) { return span.end - span.begin; }

Span overlap(const Span& a, const Span& b) { return {std::max(a.begin, b.begin), std::min(a.end, b.end)}; }

/// Ends that are no farther apart than the plate is thick are one end of its border face: the farther one, so that the outlines
/// stay closed.
Span common_span(const Span& a, const Span& b, double thickness) {
  return {std::abs(a.begin - b.begin) <= thickness ? std::min(a.begin, b.begin) : std::max(a.begin, b.begin),
          std::abs(a.end - b.end) <= thickness ? std::max(a.end, b.end) : std::min(a.end, b.end)};
}

class ThinPlateEdgeFinder {
 public:
  ThinPlateEdgeFinder(const TriangleMesh& mesh, std::span<const Wedge> wedges)
      : wedges_(wedges), closed_(mesh.patches.size()), area_(mesh.patches.size()) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      closed_[mesh.triangle_patch[t]] = mesh.closed(t);
      area_[mesh.triangle_patch[t]] += mesh.twice_area(t) / 2;
    }
  }

  std::vector<ThinPlateEdge> find() const {
    std::vector<ThinPlateEdge> found;
    for (const auto& [patch, edges] : edges_by_patch())
      for (std::size_t i = 0; i < edges.size(); ++i)
        for (std::size_t j = i + 1; j < edges.size(); ++j)
          if (const std::optional<ThinPlateEdge> edge = between(edges[i], edges[j])) found.push_back(*edge);
    sort_thinnest_first(found);
    return found;
  }

 private:
  /// Convex edges of closed bodies, by the patches of their faces.
  std::map<std::uint32_t, std::vector<BorderEdge>> edges_by_patch() const {
    std::map<std::uint32_t, std::vector<BorderEdge>> result;
    for (std::uint32_t w = 0; w < wedges_.size(); ++w)
      for (int face = 0; face < 2; ++face)
        if (wedges_[w].convex() && closed_[wedges_[w].faces[face].patch])
          result[wedges_[w].faces[face].patch].push_back({w, face});
    return result;
  }

  /// Of the two extents of a side, away from the edge and along it, the smaller.
  double breadth(const WedgeFace& side) const { return std::min(side.width, area_[side.patch] / side.width); }

  std::optional<ThinPlateEdge> between(const BorderEdge& a, const BorderEdge& b) const {
    const Wedge &first = wedges_[a.wedge], &second = wedges_[b.wedge];
    const WedgeFace &border = first.faces[a.face], &other_border = second.faces[b.face];
    const WedgeFace &side = first.faces[1 - a.face], &other_side = second.faces[1 - b.face];
    if (!could_bound(border, side, other_border, other_side)) return {};
    const dvec3 along = glm::cross(side.into_face, side.normal);
    const Span own = span_of(first, first.start, along), other = span_of(second, first.start, along),
               facing = overlap(own, other);
    if (length(facing) < least_facing * std::min(length(own), length(other))) return {};
    const Line line(first, first.start, along), other_line(second, first.start, along);
    const double middle = (facing.begin + facing.end) / 2;
    const dvec3 over = other_line.at(middle) - line.at(middle);
    const double thickness = std::abs(glm::dot(over, side.normal));
    if (glm::dot(over, border.into_face) <= 0.0 || least_side * thickness > std::min(breadth(side), breadth(other_side)))
      return {};
    const Span common = common_span(own, other, thickness);
    const auto amid = [&](double distance) { return (line.at(distance) + other_line.at(distance)) / 2.0; };
    return ThinPlateEdge{{a.wedge, b.wedge}, {side, other_side}, border.patch,       border.material, over,
                         thickness,          thickness,          amid(common.begin), amid(common.end)};
  }

  std::span<const Wedge> wedges_;
  std::vector<bool> closed_;
  std::vector<double> area_;
};

/// The half plane that stands for a thin-plate edge, with its sides' frames turned about its own tangent, from which those of
/// tapered edges differ a little.
Wedge half_plane(const ThinPlateEdge& edge, double n) {
  Wedge wedge{edge.start, edge.end, n, edge.sides};
  wedge.thickness_vector = edge.thickness_vector;
  wedge.border_patch = edge.border_patch;
  wedge.border_material = edge.border_material;
  const dvec3 tangent = glm::normalize(edge.end - edge.start);
  std::array<FaceFrame, 2> frames;
  for (int i = 0; i < 2; ++i) {
    frames[i] = face_frame(wedge.faces[i].normal, tangent, i);
    wedge.faces[i].into_face = frames[i].into_face, wedge.faces[i].normal = frames[i].normal;
  }
  wedge.n = refined_n(frames[0], frames[1], n);
  return wedge;
}

/// Puts half planes in the place of thin-plate edges. Until the end they are numbered by themselves.
class Merger {
 public:
  explicit Merger(std::span<const Wedge> wedges) : wedges_(wedges), parts_(wedges.size()) {}

  /// Of two that claim the same part of a wedge the first one, of the thinner plate, has it.
  void add(const ThinPlateEdge& edge) {
    std::array<Span, 2> spans;
    for (int i = 0; i < 2; ++i) spans[i] = span_on(edge.edges[i], edge);
    if (taken(edge.edges[0], spans[0]) || taken(edge.edges[1], spans[1])) return;
    const auto number = static_cast<std::uint32_t>(half_planes_.size());
    for (int i = 0; i < 2; ++i) parts_[edge.edges[i]].push_back({spans[i], number});
    of_border_patch_.try_emplace(edge.border_patch, number);
    const double n = wedges_[edge.edges[0]].n + wedges_[edge.edges[1]].n - 1;
    half_planes_.push_back(half_plane(edge, n));
  }

  std::vector<Wedge> take() {
    std::vector<Wedge> result;
    for (std::uint32_t w = 0; w < wedges_.size(); ++w) add_parts(w, result);
    const auto first = static_cast<std::uint32_t>(result.size());
    for (Wedge& wedge : result)
      if (wedge.replaced_by != no_index) wedge.replaced_by += first;
    result.insert(result.end(), half_planes_.begin(), half_planes_.end());
    return result;
  }

 private:
  struct Part {
    Span span;  // fractions of the edge's length
    std::uint32_t half_plane;
  };

  /// What a thin-plate edge takes of a wedge; a rest shorter than the plate is thick goes with it.
  Span span_on(std::uint32_t number, const ThinPlateEdge& edge) const {
    const Wedge& wedge = wedges_[number];
    const dvec3 along = wedge.end - wedge.start;
    const double squared = glm::dot(along, along), rest = edge.thickness / std::sqrt(squared);
    const double from = glm::dot(edge.start - wedge.start, along) / squared,
                 to = glm::dot(edge.end - wedge.start, along) / squared;
    const auto [begin, end] = std::minmax(from, to);
    return {begin <= rest ? 0.0 : begin, end >= 1.0 - rest ? 1.0 : end};
  }

  bool taken(std::uint32_t edge, const Span& span) const {
    return std::ranges::any_of(parts_[edge], [&](const Part& part) {
      return std::min(part.span.end, span.end) - std::max(part.span.begin, span.begin) > overlap_tolerance;
    });
  }

  void add_parts(std::uint32_t edge, std::vector<Wedge>& result) {
    std::vector<Part>& parts = parts_[edge];
    std::ranges::sort(parts, {}, [](const Part& part) { return part.span.begin; });
    const Wedge& wedge = wedges_[edge];
    const auto add = [&](double begin, double end, std::uint32_t half_plane) {
      if (!(end > begin)) return;
      result.push_back(wedge);
      if (begin > 0.0) result.back().start = glm::mix(wedge.start, wedge.end, begin);
      if (end < 1.0) result.back().end = glm::mix(wedge.start, wedge.end, end);
      result.back().replaced_by = half_plane;
    };
    double reached = 0.0;
    for (const Part& part : parts) {
      const double begin = part.span.begin - reached < overlap_tolerance ? reached : part.span.begin;
      add(reached, begin, no_index);
      add(begin, part.span.end, part.half_plane);
      reached = part.span.end;
    }
    add(reached, 1.0, parts.empty() ? corner_of(wedge) : no_index);
  }

  /// The half plane whose border face this wedge runs across as one of its corners.
  std::uint32_t corner_of(const Wedge& wedge) const {
    if (!wedge.convex()) return no_index;
    for (const WedgeFace& face : wedge.faces) {
      const auto found = of_border_patch_.find(face.patch);
      if (found == of_border_patch_.end()) continue;
      if (wedge.length() <= (1 + corner_tolerance) * half_planes_[found->second].thickness()) return found->second;
    }
    return no_index;
  }

  std::span<const Wedge> wedges_;
  std::vector<std::vector<Part>> parts_;
  std::vector<Wedge> half_planes_;
  std::map<std::uint32_t, std::uint32_t> of_border_patch_;  // the half plane that stands for it
};

}  // namespace

void sort_thinnest_first(std::vector<ThinPlateEdge>& edges) {
  std::ranges::sort(edges, {},
                    [](const ThinPlateEdge& edge) { return std::tuple(edge.effective, edge.edges, edge.border_patch); });
}

std::vector<ThinPlateEdge> find_thin_plate_edges(const TriangleMesh& mesh, std::span<const Wedge> wedges) {
  return ThinPlateEdgeFinder(mesh, wedges).find();
}

std::size_t count_thin(std::span<const ThinPlateEdge> edges, double frequency) {
  return static_cast<std::size_t>(
      std::ranges::count_if(edges, [&](const ThinPlateEdge& edge) { return edge.effective < thin_limit(frequency); }));
}

std::vector<Wedge> merge_thin_plate_edges(std::span<const Wedge> wedges, std::span<const ThinPlateEdge> edges, double limit) {
  Merger merger(wedges);
  for (const ThinPlateEdge& edge : edges)
    if (edge.effective < limit) merger.add(edge);
  return merger.take();
}

std::size_t thin_plate_corners(std::span<const Wedge> merged) {
  const auto on_side = [&](const Wedge& wedge, const WedgeFace& side) {
    return wedge.faces[0].patch == side.patch || wedge.faces[1].patch == side.patch;
  };
  const auto corner = [&](const Wedge& wedge) {
    return wedge.replaced_by != no_index &&
           std::ranges::none_of(merged[wedge.replaced_by].faces, [&](const WedgeFace& side) { return on_side(wedge, side); });
  };
  return static_cast<std::size_t>(std::ranges::count_if(merged, corner));
}

}  // namespace raytube
