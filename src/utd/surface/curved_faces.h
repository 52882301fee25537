// Which faces of wedges are curved, and where wedges lie on the facets of these.
#pragma once

#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "mesh/features/wedges.h"
#include "utd/surface/curved_target.h"
#include "utd/surface/surface_ray.h"

namespace raytube {

/// A face of a wedge.
struct WedgeSide {
  std::uint32_t wedge = no_index;
  int face = 0;
};

class CurvedFaces {
 public:
  /// Keeps a reference to `curved`.
  CurvedFaces(const CurvedTarget& curved, std::span<const Wedge> wedges);

  const CurvedTarget& target() const { return target_; }

  /// Whether a face of a wedge is part of a curved surface.
  bool curved(std::uint32_t wedge, int face) const { return !sides_[2 * std::size_t{wedge} + face].empty(); }

  /// The point of the surface at a point of the wedge: on the facet that has it on its side.
  std::optional<FacetPoint> at(std::uint32_t wedge, int face, const dvec3& point) const;

  /// The wedge that stands at the side of a facet from `corner` to the next; `back`: on the side its normal points away from.
  WedgeSide at(std::uint32_t triangle, int corner, bool back) const;

 private:
  struct FacetSide {
    std::uint32_t triangle;
    int corner;
    double begin, end;  // arc length on the wedge [m]
  };
  struct Line {
    dvec3 start, along;  // unit
    double arc_length(const dvec3& point) const { return glm::dot(point - start, along); }
  };
  void find_sides(std::uint32_t triangle, int corner, std::span<const Wedge> wedges, std::span<const WedgeSide> of_patch);

  const CurvedTarget& target_;
  std::vector<Line> lines_;                              // [wedge]
  std::vector<std::vector<FacetSide>> sides_;            // [2 wedge + face]
  std::unordered_map<std::size_t, WedgeSide> wedge_at_;  // [2 (3 triangle + corner) + back]
};

}  // namespace raytube
