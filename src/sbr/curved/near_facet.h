// A curved facet near the antennas.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sbr/beams/beam.h"
#include "sbr/beams/surfaces_met.h"
#include "sbr/beams/tube_look.h"
#include "sbr/beams/tube_sums.h"

namespace raytube {

/// The curved facets of a look, one after the other. Outlines are those of facets in launch coordinates.
class NearFacets {
 public:
  /// Keeps a reference to `look`.
  explicit NearFacets(const TubeLook& look);

  /// All of a facet.
  void light(std::uint32_t triangle);
  /// The part of a facet that the antenna sees.
  void light(std::uint32_t triangle, const ConvexPolygon& part);
  /// A part lit by a wave behind sheets, or received through some, as currents of bounce `bounce`: `met` has these, and last of
  /// its surfaces the facet.
  void light(TubeSums& to, int bounce, const SurfacesMet& met, std::uint32_t triangle, const ConvexPolygon& part);

  /// A facet turned away from the antenna part of whose surface is not, with nothing in between but that surface.
  bool is_lit_beyond_horizon(std::uint32_t triangle) const;

  ConvexPolygon outline_of(std::uint32_t triangle) const;

  TubeSums take();

 private:
  BentFacet seen(std::uint32_t triangle) const;
  std::uint32_t material(std::uint32_t triangle) const;
  ConvexPolygon outline_of(const BentFacet& facet) const;
  std::span<const dvec3> points_on(const Patch& plane, const ConvexPolygon& part);
  template <class Radiate>
  void add(std::uint32_t triangle, const ConvexPolygon& part, Radiate radiate);
  void add_to_map(std::uint32_t triangle, const ConvexPolygon& outline, const ScatteringMatrix& whole);

  const TubeLook& look_;
  Beam beam_;
  Band band_;
  TubeSums sums_;
  std::vector<dvec3> points_;
};

}  // namespace raytube
