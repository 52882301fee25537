#include "utd/interaction/interaction_groups.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <tuple>

#include "utd/interaction/azimuth_cuts.h"

namespace raytube {

namespace {

// Vertices inside a plane face or a straight edge are no corners.
std::vector<dvec3> find_corners(std::span<const Wedge> wedges) {
  std::vector<dvec3> corners;
  for (const Wedge& wedge : wedges) corners.insert(corners.end(), {wedge.start, wedge.end});
  const auto key = [](const dvec3& corner) { return std::tuple(corner.x, corner.y, corner.z); };
  std::ranges::sort(corners, {}, key);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  if (corners.size() > most_cuts) corners.clear();
  return corners;
}

// So many of the patches, and which.
void mark_large(const InteractionParts& parts, double least_area, InteractionGroup& group) {
  const auto small = [&](std::uint32_t patch) { return parts.patches[patch].area < least_area; };
  group.large_faces = static_cast<std::size_t>(std::ranges::find_if(parts.by_area, small) - parts.by_area.begin());
  group.large.resize(parts.patches.size());
  for (std::size_t i = 0; i < group.large_faces; ++i) group.large[parts.by_area[i]] = true;
}

}  // namespace

std::vector<bool> mirrors_among(const FaceMaterials& materials, std::size_t frequency, double wavenumber) {
  std::vector<bool> mirrors;
  for (std::uint32_t m = 0; m < materials.materials.size(); ++m)
    mirrors.push_back(std::abs(materials.response(m, frequency, wavenumber, 1.0, false).reflected.te) > 0.5);
  return mirrors;
}

// Waves of edges end at sheets: they would go on behind these with what both sides of a face radiate.
InteractionParts::InteractionParts(const TriangleMesh& mesh, std::span<const Wedge> wedges, const FaceMaterials& materials,
                                   double wavenumber)
    : axes(edge_axes(mesh, wedges, mirrors_among(materials, 0, wavenumber))),
      corners(find_corners(wedges)),
      patches(patch_extents(mesh)),
      by_area(patches.size()) {
  std::iota(by_area.begin(), by_area.end(), 0u);
  std::erase_if(by_area, [&](std::uint32_t patch) {
    const std::uint32_t material = mesh.patches[patch].material;
    return materials.any() && material != no_index && materials.materials[material].transmits();
  });
  std::ranges::stable_sort(by_area, std::ranges::greater{}, [&](std::uint32_t patch) { return patches[patch].area; });
}

TooSmall too_small_to_interact(const TriangleMesh& mesh, std::span<const Wedge> wedges, double frequency) {
  const double least = wavelength(frequency);
  TooSmall result;
  double longest = 0.0, largest = 0.0;
  for (const Wedge& wedge : wedges) {
    if (!wedge.radiates()) continue;
    longest = std::max(longest, wedge.length());
    if (wedge.length() < least) ++result.edges;
  }
  for (const PatchExtent& patch : patch_extents(mesh)) {
    largest = std::max(largest, patch.area);
    if (patch.area < least * least) ++result.faces;
  }
  result.longest = std::min(longest, std::sqrt(largest));
  return result;
}

std::vector<InteractionGroup> interaction_groups(const InteractionParts& parts, std::span<const double> frequencies,
                                                 const std::vector<bool>& wanted) {
  std::vector<InteractionGroup> groups;
  for (std::size_t f = 0; f < frequencies.size(); ++f) {
    if (!wanted[f]) continue;
    const double least = wavelength(frequencies[f]);
    InteractionGroup group{{f}, {frequencies[f]}, least, 0, 0, {}};
    group.axes = std::ranges::count_if(parts.axes, [&](const EdgeAxis& axis) { return axis.length >= least; });
    mark_large(parts, least * least, group);
    if (group.axes == 0 || group.large_faces == 0) continue;
    const auto same = std::ranges::find_if(groups, [&](const InteractionGroup& other) {
      return other.axes == group.axes && other.large_faces == group.large_faces;
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
