#include "sbr/curved/through_sheets.h"

#include "sbr/beams/current_map.h"
#include "sbr/beams/spherical_look.h"
#include "sbr/curved/curved_integral.h"
#include "sbr/curved/near_facet.h"

namespace raytube {

bool looks_from_elsewhere(const TubeLook& look) {
  if (!look.spherical) return look.receive.radial != look.transmit.radial;
  return look.spherical->antennas().receive.position() != look.spherical->antennas().transmit.position();
}

CurvedPiece piece_over(const TubeLook& look, const dvec2& at, std::uint32_t triangle) {
  const LaunchGrid& grid = look.grid;
  const TriangleMesh& mesh = look.faces.mesh();
  const Patch& patch = mesh.patch_of(triangle);
  const dvec3 above = grid.plane_origin + at.x * grid.u_hat + at.y * grid.v_hat;
  return {grid, look.smooth->at(above, grid.direction, triangle), patch.material, glm::dot(patch.normal, grid.direction) > 0.0};
}

CurvedThroughSheets::CurvedThroughSheets(const TubeLook& look, BeamVisibility& visible)
    : look_(look),
      visible_(visible),
      beams_(look.faces.mesh(), look.surfaces, look.receive, incident_beam(look.grid, look.transmit, dvec2(0.0))),
      line_of_sight_(*look.sheets, look.faces, look.tracer, visible, beams_) {}

// Straight on: what else sheets do with the wave, and what else it meets, is that of tubes on flat facets.
void CurvedThroughSheets::go_through(TubeSums& to, std::uint32_t beam, const VisiblePart& sheet, int bounce) {
  const std::uint32_t through = beams_.through(beams_.child(beam, patch(sheet), middle(sheet.outline)));
  if (through == no_index || bounce + 1 == look_.max_bounces) return;
  const Ray ray = visible_.middle_ray(beams_.beam(through), patch(sheet), sheet.outline);
  Hit in_middle;
  look_.tracer.closest_hits({&ray, 1}, {&in_middle, 1});
  ++to.rays;
  std::vector<VisiblePart> met;
  visible_.from_surface(beams_.beam(through), patch(sheet), sheet.outline, in_middle, met);
  for (const VisiblePart& part : met) meet(to, through, part, bounce + 1);
}

void CurvedThroughSheets::meet(TubeSums& to, std::uint32_t beam, const VisiblePart& part, int bounce) {
  if (beams_.is_sheet(patch(part))) return go_through(to, beam, part, bounce);
  if (look_.smooth->region(look_.faces.faces()[part.face].triangle) == no_index) return;
  to.at(bounce, look_.wavenumbers().size());
  ++to.hits[static_cast<std::size_t>(bounce)];
  to.meet(bounce, area(part.outline), beams_.amplitude(beam));
  add(to, {beam, beams_.child(beam, patch(part), middle(part.outline))}, part, bounce);
  screen(to, beam, part, bounce);
}

void CurvedThroughSheets::screen(TubeSums& to, std::uint32_t beam, const VisiblePart& part, int bounce) {
  const std::uint32_t node = beams_.child(beam, patch(part), middle(part.outline));
  for (ScreenedPart& screened : line_of_sight_.through_sheets(node, part.outline))
    add(to, {beam, screened.node}, {part.face, std::move(screened.outline)}, bounce);
}

SheetsBefore CurvedThroughSheets::sheets_before(const dvec2& at, double depth, std::uint32_t triangle) const {
  const TriangleMesh& mesh = look_.faces.mesh();
  const auto patch_of = [&](std::uint32_t t) { return mesh.triangle_patch[t]; };
  SheetsBefore sheets;
  Ray ray = tube_ray(beams_.beam(BeamTree::root), at, nullptr, no_index);
  const dvec3 point = ray.origin + depth * ray.direction;
  for (Hit hit;; sheets.transmitter.push_back(ray.source_patch)) {
    look_.tracer.closest_hits({&ray, 1}, {&hit, 1});
    if (!hit || !is_sheet(hit.triangle)) break;
    ray = {ray.origin + hit.distance * ray.direction, ray.direction, patch_of(hit.triangle)};
    if (glm::dot(point - ray.origin, ray.direction) < 0.0) break;
  }
  RayLineOfSight line(*look_.sheets, look_.tracer);
  line.add(0, 0, point, patch_of(triangle));
  line.follow([&](const RayLineOfSight::Line& met) {
    if (beams_.is_sheet(met.ray.source_patch)) sheets.receiver.push_back(met.ray.source_patch);
  });
  return sheets;
}

std::vector<ScatteringMatrix> CurvedThroughSheets::far_field(const SheetsBefore& sheets, const CurvedPiece& piece,
                                                             const Bounds& box, TubeSums& incoherent) const {
  const TriangleMesh& mesh = look_.faces.mesh();
  Spectrum wave = plain_spectrum({look_.transmit.theta_hat, look_.transmit.phi_hat}, look_.wavenumbers().size());
  for (const std::uint32_t sheet : sheets.transmitter) {
    const Patch& plane = mesh.patches[sheet];
    const bool from_behind = glm::dot(plane.normal, look_.grid.direction) > 0.0;
    const Incidence at{look_.grid.direction, from_behind ? -plane.normal : plane.normal, plane.material, from_behind};
    wave = leaving_waves(look_.surfaces, at, wave, look_.receive).transmitted;
  }
  Illumination light{look_.grid, look_.transmit, look_.receive, look_.surfaces, nullptr, &wave};
  std::vector<ScatteringMatrix> all = curved_far_field(light, piece, box, &incoherent);
  if (sheets.receiver.empty()) return all;
  light.returns_alone = true;
  const std::vector<ScatteringMatrix> returning = curved_far_field(light, piece, box);
  for (std::size_t f = 0; f < all.size(); ++f) {
    ScatteringMatrix behind = returning[f];
    for (const std::uint32_t sheet : sheets.receiver)
      behind.s = received_through(through_screen(look_.surfaces, mesh.patches[sheet], f, look_.receive), behind.s);
    all[f] += behind - returning[f];
  }
  return all;
}

void CurvedThroughSheets::add(TubeSums& to, const Source& source, const VisiblePart& part, int bounce) {
  if (look_.spherical)
    add_near(to, source, part, bounce);
  else
    add_far(to, source, part, bounce);
}

void CurvedThroughSheets::add_near(TubeSums& to, const Source& source, const VisiblePart& part, int bounce) const {
  NearFacets facets(look_);
  for (const std::uint32_t triangle : look_.faces.triangles(part.face)) {
    const ConvexPolygon common = intersection(part.outline, facets.outline_of(triangle));
    if (!common.empty()) facets.light(to, bounce, *beams_.beam(source.node).met, triangle, common);
  }
}

void CurvedThroughSheets::add_far(TubeSums& to, const Source& source, const VisiblePart& part, int bounce) {
  const CurvedPiece piece = piece_over(look_, middle(part.outline), look_.faces.faces()[part.face].triangle);
  std::vector<ScatteringMatrix> radiated = far_field(source, piece, part.outline, &to);
  if (CurrentMap* const map = look_.map)
    map->add(
        bounce, part.outline, [&](const dvec2&) { return look_.faces.faces()[part.face].triangle; },
        radiated[map->frequency_index()],
        [&](const ConvexPolygon& of) { return far_field(source, piece, of, nullptr)[map->frequency_index()]; });
  std::vector<ScatteringMatrix>& sums = to.at(bounce, radiated.size());
  to.pieces.resize(radiated.size());
  for (std::size_t f = 0; f < radiated.size(); ++f) {
    sums[f] += radiated[f];
    to.pieces[f].add(radiated[f] *= curved_integration_error);
  }
}

// The shadow of the incident wave is not seen through sheets.
std::vector<ScatteringMatrix> CurvedThroughSheets::far_field(const Source& source, const CurvedPiece& piece,
                                                             const ConvexPolygon& outline, TubeSums* incoherent) const {
  const bool screened = beams_.is_screened(source.node);
  const Illumination light{look_.grid, look_.transmit, look_.receive, look_.surfaces, nullptr, beams_.beam(source.beam).spectrum,
                           screened};
  std::vector<ScatteringMatrix> radiated = curved_far_field(light, piece, outline, screened ? nullptr : incoherent);
  for (std::size_t f = 0; screened && f < radiated.size(); ++f)
    radiated[f].s = received_through(beams_.added_by_screen(source.node, f), radiated[f].s);
  return radiated;
}

}  // namespace raytube
