#include "sbr/curved/near_facets.h"

#include "sbr/curved/near_facet.h"
#include "sbr/curved/through_sheets.h"

namespace raytube {

namespace {

bool is_curved(const TubeLook& look, std::uint32_t triangle) { return look.smooth->region(triangle) != no_index; }

// Adds what the receiver has through sheets of the curved faces that the antenna sees, and what lies behind the sheets it sees.
void add_with_sheets(const TubeLook& look, std::span<const VisiblePart> parts, BeamVisibility& visible, TubeSums& sums) {
  CurvedThroughSheets curved(look, visible);
  const bool elsewhere = looks_from_elsewhere(look);
  for (const VisiblePart& part : parts) {
    const std::uint32_t triangle = look.faces.faces()[part.face].triangle;
    if (curved.is_sheet(triangle))
      curved.go_through(sums, part);
    else if (elsewhere && is_curved(look, triangle))
      curved.screen(sums, part);
  }
}

bool is_sheet(const TubeLook& look, std::uint32_t triangle) {
  const TriangleMesh& mesh = look.faces.mesh();
  return look.surfaces.transmits(mesh.patch_of(triangle).material);
}

// What the antenna sees of some faces, curved ones and sheets.
std::vector<VisiblePart> visible_parts(const TubeLook& look, std::uint32_t begin, std::uint32_t end, BeamVisibility& visible) {
  std::vector<std::uint32_t> faces;
  for (std::uint32_t face = begin; face < end; ++face)
    if (const std::uint32_t t = look.faces.faces()[face].triangle; is_curved(look, t) || is_sheet(look, t)) faces.push_back(face);
  std::vector<VisiblePart> parts;
  visible.of_faces(incident_beam(look.grid, look.transmit, dvec2(0.0)), faces, parts);
  return parts;
}

}  // namespace

TubeSums light_convex_facets(const TubeLook& look, std::uint32_t begin, std::uint32_t end) {
  NearFacets facets(look);
  for (std::uint32_t t = begin; t < end; ++t)
    if (is_curved(look, t)) facets.light(t);
  return facets.take();
}

TubeSums light_visible_facets(const TubeLook& look, std::uint32_t begin, std::uint32_t end) {
  NearFacets facets(look);
  BeamVisibility visible(look.faces, look.tracer);
  for (std::uint32_t face = begin; face < end; ++face)
    for (const std::uint32_t triangle : look.faces.triangles(face))
      if (is_curved(look, triangle) && facets.is_lit_beyond_horizon(triangle)) facets.light(triangle);
  const std::vector<VisiblePart> parts = visible_parts(look, begin, end, visible);
  for (const VisiblePart& part : parts)
    for (const std::uint32_t triangle : look.faces.triangles(part.face)) {
      if (!is_curved(look, triangle)) continue;
      const ConvexPolygon common = intersection(part.outline, facets.outline_of(triangle));
      if (!common.empty()) facets.light(triangle, common);
    }
  TubeSums sums = facets.take();
  if (look.sheets) add_with_sheets(look, parts, visible, sums);
  sums.sliver_area = visible.sliver_area();
  return sums;
}

}  // namespace raytube
