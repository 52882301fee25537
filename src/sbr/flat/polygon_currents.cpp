#include "sbr/flat/polygon_currents.h"

#include "sbr/beams/current_map.h"
#include "sbr/beams/polygon_integral.h"
#include "sbr/beams/spherical_look.h"

namespace raytube {

void PolygonCurrents::add(TubeSums& to, std::uint32_t node, const VisiblePart& part, int bounce, CurrentMap* map) {
  to.at(bounce, look_.wavenumbers().size());
  ++to.hits[static_cast<std::size_t>(bounce)];
  radiate(to, node, part, bounce, map);
  if (line_of_sight_)
    for (ScreenedPart& screened : line_of_sight_->through_sheets(node, part.outline))
      radiate(to, screened.node, {part.face, std::move(screened.outline)}, bounce, map);
  const Spectrum* const spectrum = beams_.footprint(node).outgoing.spectrum;
  if (spectrum && look_.surfaces.any_rough()) to.add_incoherent(*spectrum, area(part.outline));
}

void PolygonCurrents::radiate(TubeSums& to, std::uint32_t node, const VisiblePart& part, int bounce, CurrentMap* map) {
  if (look_.spherical) return radiate_spherical(to, node, part, bounce, map);
  const Footprint& footprint = beams_.footprint(node);
  phase_integrals(footprint, band_, part.outline, integrals_);
  std::vector<ScatteringMatrix>& sums = to.at(bounce, look_.wavenumbers().size());
  for (std::size_t f = 0; f < sums.size(); ++f) add_far_field(sums[f], footprint, f, look_.wavenumbers()[f], integrals_[f]);
  if (map) map->add(bounce, footprint, part.outline, part.face);
}

void PolygonCurrents::radiate_spherical(TubeSums& to, std::uint32_t node, const VisiblePart& part, int bounce, CurrentMap* map) {
  const Beam& beam = beams_.beam(node);
  const Patch& plane = beams_.patch(node);
  if (!map) return look_.spherical->add({to, band_}, bounce, beam, plane, part.outline);
  const std::size_t f = map->frequency_index();
  const auto sum = [&] { return to.at(bounce, look_.wavenumbers().size())[f]; };
  const ScatteringMatrix before = sum();
  look_.spherical->add({to, band_}, bounce, beam, plane, part.outline);
  const SphericalLook at_frequency = look_.spherical->at_frequency(f);
  Band one(at_frequency.wavenumbers());
  map->add(bounce, beam, part.outline, part.face, sum() - before, [&](const ConvexPolygon& of) {
    TubeSums alone;
    at_frequency.add({alone, one}, 0, beam, plane, of);
    return alone.bounces[0][0];
  });
}

}  // namespace raytube
