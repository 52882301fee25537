#include "utd/interaction/interaction_groups.h"

#include <algorithm>
#include <tuple>

namespace raytube {

namespace {

constexpr std::size_t most_interacting_pairs = 1024;
constexpr std::size_t most_corners = 200;

std::vector<double> patch_areas(const TriangleMesh& mesh) {
  std::vector<double> areas(mesh.patches.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    areas[mesh.triangle_patch[t]] += glm::length(area_vector(mesh.vertices, mesh.triangles[t])) / 2;
  return areas;
}

// The ends of the wedges: vertices inside a plane face or a straight edge are no corners.
std::vector<dvec3> find_corners(std::span<const Wedge> wedges) {
  std::vector<dvec3> corners;
  for (const Wedge& wedge : wedges) corners.insert(corners.end(), {wedge.start, wedge.end});
  const auto key = [](const dvec3& corner) { return std::tuple(corner.x, corner.y, corner.z); };
  std::ranges::sort(corners, {}, key);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  if (corners.size() > most_corners) corners.clear();
  return corners;
}

std::size_t at_least(std::span<const double> values, double least) {
  return static_cast<std::size_t>(std::ranges::count_if(values, [&](double value) { return value >= least; }));
}

}  // namespace

std::vector<bool> interaction_limit_exceeded(const TriangleMesh& mesh, std::span<const Wedge> wedges,
                                             std::span<const double> frequencies) {
  const std::vector<double> areas = patch_areas(mesh);
  std::vector<double> lengths;
  for (const Wedge& wedge : wedges)
    if (wedge.radiates()) lengths.push_back(wedge.length());
  std::vector<bool> above_limit;
  for (const double frequency : frequencies) {
    const double least = wavelength(frequency);
    above_limit.push_back(at_least(lengths, least) * at_least(areas, least * least) > most_interacting_pairs);
  }
  return above_limit;
}

std::vector<InteractionGroup> interaction_groups(const TriangleMesh& mesh, std::span<const Wedge> wedges,
                                                 std::span<const double> frequencies, const std::vector<bool>& wanted) {
  const std::vector<double> areas = patch_areas(mesh);
  const std::vector<EdgeAxis> axes = edge_axes(mesh, wedges);
  const std::vector<dvec3> corners = find_corners(wedges);
  std::vector<InteractionGroup> groups;
  for (std::size_t f = 0; f < frequencies.size(); ++f) {
    if (!wanted[f]) continue;
    const double least = wavelength(frequencies[f]);
    InteractionGroup group{{f}, {frequencies[f]}, {}, corners, {}};
    for (const EdgeAxis& axis : axes)
      if (axis.length >= least) group.axes.push_back(axis);
    for (const double area : areas) group.large.push_back(area >= least * least);
    if (group.axes.empty() || std::ranges::none_of(group.large, std::identity{})) continue;
    const auto same = std::ranges::find_if(groups, [&](const InteractionGroup& other) {
      return other.axes.size() == group.axes.size() && other.large == group.large;
    });
    if (same == groups.end()) {
      groups.push_back(std::move(group));
    } else {
      same->indices.push_back(f);
      same->frequencies.push_back(frequencies[f]);
    }
  }
  return groups;
}

}  // namespace raytube
