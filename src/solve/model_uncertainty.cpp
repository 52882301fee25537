#include "solve/model_uncertainty.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include "mesh/features/thin_plates.h"
#include "scene/frequency_bands.h"
#include "utd/sheet/sheet_admittance.h"

namespace raytube {

namespace {

// How much of a conductor's edge currents the edge of such a material has: what it takes from a wave of normal incidence, in
// front or behind.
double edge_strength(const Material& material, std::size_t frequency, double wavenumber) {
  if (!material.transmits()) return 1.0;
  const SurfaceResponse response = smooth_response(material, frequency, wavenumber, 1.0, false);
  return std::min(1.0, std::max(std::abs(response.reflected.te), std::abs(1.0 - response.transmitted.te)));
}

EdgeCurrents edge_currents(const SolvePlan& plan, std::size_t frequency) {
  const bool of_materials = plan.fringe() && plan.edges.materials != MaterialEdgeMethod::none;
  EdgeCurrents currents{plan.fringe(), of_materials, {}, {}, plan.state("surface_waves").on};
  const double k = wavenumber(plan.sweep.frequencies[frequency]);
  for (const Material& material : plan.sweep.materials) {
    currents.material_strengths.push_back(edge_strength(material, frequency, k));
    // Of a thick sheet next to nothing, so that it is a sheet still.
    currents.sheet_shares.push_back(material.transmits() ? std::max(sheet_share(material, frequency, k), 1e-6) : 0.0);
  }
  return currents;
}

EdgeFeatures edge_features(const SolvePlan& plan, const CurvedParts& curved, std::size_t frequency, double wavelength) {
  std::vector<Wedge> wedges = *set_of(plan.wedge_sets, frequency).wedges;
  std::erase_if(wedges, &Wedge::flat);
  return find_edge_features(wedges, curved, edge_currents(plan, frequency), wavelength);
}

}  // namespace

ModelUncertainty::ModelUncertainty(const SolvePlan& plan)
    : plan_(plan),
      curved_(find_curved_parts(plan.target.mesh, plan.target.options.min_wedge_angle)),
      at_(plan.sweep.frequencies.size()),
      rim_dent_(rim_dent(plan.target.wedges, plan.target.options.min_wedge_angle)) {
  const TriangleMesh& mesh = plan.target.mesh;
  const double max_crease = doubtful_crease(plan.target.options.min_wedge_angle);
  const SmoothSurfaces meant =
      plan.known_surfaces ? SmoothSurfaces(*plan.known_surfaces, max_crease) : SmoothSurfaces(mesh, max_crease);
  for (const BandPlan& body : plan.bands) {
    for (const std::size_t index : body.indices) at_[index].body = dents_.size();
    dents_.emplace_back(mesh, body.smooth.get(), meant);
  }
  std::map<std::tuple<std::size_t, double, double>, std::size_t> known;
  for (std::size_t f = 0; f < at_.size(); ++f) {
    const double frequency = plan.sweep.frequencies[f], middle = middle_of_band(band_of(frequency));
    at_[f].penumbras = penumbra_shares(curved_.faces, wavelength(frequency), plan.sweep.materials);
    const std::size_t thin = count_thin(plan.thin_plate_edges, frequency);
    const auto [found, is_new] = known.try_emplace({thin, middle, plan.sweep.materials.empty() ? 0.0 : frequency}, edges_.size());
    if (is_new) edges_.push_back(edge_features(plan, curved_, f, wavelength(middle)));
    const Band band{middle, found->second};
    at_[f].band = static_cast<std::size_t>(std::ranges::find(bands_, band) - bands_.begin());
    if (at_[f].band == bands_.size()) bands_.push_back(band);
  }
}

std::vector<LookFeatures> ModelUncertainty::features(const Look& look) const {
  std::vector<LookFeatures> features;
  for (const Band& band : bands_)
    features.push_back(find_look_features({plan_.target.mesh, curved_, edges_[band.edges]}, look, band.frequency));
  return features;
}

// What tubes show of a row, which stands at this place in their sums.
RowEvidence ModelUncertainty::evidence(const Look& look, std::size_t frequency, const TubeSums& tubes, std::size_t at,
                                       const std::vector<double>& met, const std::vector<ScatteringMatrix>& bounces) const {
  RowEvidence row{.facets = dents_[at_[frequency].body].relative_error(look, bands_[at_[frequency].band].frequency),
                  .rim_dent = rim_dent_,
                  .half_extent = plan_.target.mesh.radius,
                  .bounces = bounces,
                  .met = met,
                  .penumbras = at_[frequency].penumbras,
                  .edge_order = plan_.fringe() ? plan_.edges.order : 0,
                  .wavelength = wavelength(plan_.sweep.frequencies[frequency])};
  if (!tubes.inside.empty()) row.inside = tubes.inside[at].s, row.left_solids = tubes.inside[at].left;
  return row;
}

std::vector<OmissionErrors> ModelUncertainty::of(const Look& look, const LookResult& result) const {
  const std::vector<LookFeatures> found = features(look);
  std::vector<OmissionErrors> errors;
  for (std::size_t f = 0; f < at_.size(); ++f) {
    const std::vector<ScatteringMatrix> bounces = result.tubes.bounces_at(f);
    RowEvidence row = evidence(look, f, result.tubes, f, result.met[at_[f].body], bounces);
    for (std::size_t i = 0; i < result.mechanisms.size(); ++i)
      if (const auto tell = plan_.mechanisms[i].tell) tell(plan_, result.mechanisms[i], f, row);
    if (plan_.sweep.materials.empty()) row.truncated = result.truncated[at_[f].body];  // else it is in the numerical error
    errors.push_back(estimate_omissions(found[at_[f].band], row));
  }
  return errors;
}

std::vector<ChannelErrors> ModelUncertainty::at_least(const Look& look, std::size_t band, const TubeSums& tubes) const {
  const std::vector<LookFeatures> found = features(look);
  std::vector<ChannelErrors> errors;
  for (const std::size_t f : plan_.bands[band].indices) {
    const std::size_t at = errors.size();
    const std::vector<ScatteringMatrix> bounces = tubes.bounces_at(at);
    RowEvidence row = evidence(look, f, tubes, at, tubes.met, bounces);
    row.has_surface_waves = plan_.state("surface_waves").on, row.has_interaction = plan_.state("interaction").on;
    errors.push_back(root_sum_square(estimate_omissions(found[at_[f].band], row)));
  }
  return errors;
}

}  // namespace raytube
