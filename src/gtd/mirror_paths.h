// Rays from one point to another over plane mirrors, the patches of a mesh: by the method of images.
#pragma once

#include <span>
#include <vector>

#include "gtd/ray_surfaces.h"

namespace raytube {

struct MirrorPath {
  std::vector<std::uint32_t> patches;  // the mirrors, in order
  std::vector<SheetsPassed> sheets;    // before each mirror, and after the last one
  double length;                       // [m]
};

/// The paths of a look and what finding them took.
struct MirrorPathList {
  std::vector<MirrorPath> paths;  // fewest reflections first
  std::uint64_t rays = 0;         // traced
  bool cut = false;               // the search was given up before all sequences of patches were tried
};

class MirrorPaths {
 public:
  /// Keeps a reference to the surfaces.
  explicit MirrorPaths(const RaySurfaces& surfaces);

  /// All paths of 1 to `most` reflections whose every leg is clear but for sheets; both ends lie outside the target's bounding
  /// sphere, in recentred coordinates. Sequences grow patch by patch: the next one must stand in the beam that the ball around
  /// the last one reflects. Past `most_tests` pairs of patches the search stops, with the shorter sequences complete. A patch in
  /// `boundary_patches`, on whose reflection boundary the look lies, reflects once whether or not the point of reflection is
  /// inside it; its legs have no sheets here.
  MirrorPathList find(const dvec3& from, const dvec3& to, int most, std::span<const std::uint32_t> boundary_patches) const;

  static constexpr std::uint64_t most_tests = 20'000'000;

 private:
  struct Ball {
    dvec3 middle{0.0};
    double radius = 0.0;
    bool two_sided = true;
  };
  struct Stage {
    dvec3 image;  // of the source after the last mirror
    std::uint32_t patch;
    std::ptrdiff_t before;  // the stage with one mirror less, -1 for none
  };
  class Search;

  const RaySurfaces& surfaces_;
  std::vector<Ball> balls_;  // around each patch
};

}  // namespace raytube
