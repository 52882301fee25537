// The triangles of a mesh that is being mended, and what they are made of.
#pragma once

#include <vector>

#include "mesh/model/geometry.h"
#include "mesh/model/triangle_mesh.h"
#include "scene/material.h"

namespace raytube {

struct Facets {
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> materials;  // of each triangle, as Patch::material; empty: all are perfect conductors
  std::vector<std::uint32_t> parts;      // of each triangle, as PolygonSoup::parts; empty: not wanted

  std::uint32_t material(std::size_t triangle) const { return materials.empty() ? no_index : materials[triangle]; }

  /// Adds a triangle made of what triangle `like` of `other` is made of.
  void add(const Triangle& triangle, const Facets& other, std::size_t like) {
    triangles.push_back(triangle);
    if (!other.materials.empty()) materials.push_back(other.materials[like]);
    if (!other.parts.empty()) parts.push_back(other.parts[like]);
  }

  /// Leaves out the triangles for which `drop(index)` holds; returns how many.
  template <class Drop>
  std::uint64_t drop_if(Drop drop) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      if (drop(i)) continue;
      if (!materials.empty()) materials[kept] = materials[i];
      if (!parts.empty()) parts[kept] = parts[i];
      triangles[kept++] = triangles[i];
    }
    const std::uint64_t dropped = triangles.size() - kept;
    triangles.resize(kept);
    if (!materials.empty()) materials.resize(kept);
    if (!parts.empty()) parts.resize(kept);
    return dropped;
  }
};

/// Whether waves go on behind a surface of this material; not if it is none of them, as a perfect conductor is not.
inline bool transmits(std::span<const Material> materials, std::uint32_t material) {
  return material < materials.size() && materials[material].transmits();
}

}  // namespace raytube
