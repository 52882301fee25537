#include "solve/model_uncertainty.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include "mesh/features/resolved_wedges.h"

namespace raytube {

namespace {

// Features of looks are found at powers of this, in hertz: an estimate of size need not follow every lobe of a wide sweep. Which
// other frequencies a sweep has changes nothing.
constexpr double band_ratio = 1.1;

double middle_of_band(double frequency) { return std::pow(band_ratio, std::round(std::log(frequency) / std::log(band_ratio))); }

// How much of a conductor's edge currents the edge of such a material has: what it takes from a wave of normal incidence, in
// front or behind.
double edge_strength(const Material& material, std::size_t frequency, double wavenumber) {
  if (!material.transmits()) return 1.0;
  const SurfaceResponse response = smooth_response(material, frequency, wavenumber, 1.0, false);
  return std::min(1.0, std::max(std::abs(response.reflected.te), std::abs(1.0 - response.transmitted.te)));
}

}  // namespace

ModelUncertainty::ModelUncertainty(const SolvePlan& plan)
    : plan_(plan),
      curved_(find_curved_parts(plan.target.mesh, plan.target.options.min_wedge_angle)),
      dents_(plan.target.mesh, plan.smooth.get(), plan.target.options.min_wedge_angle),
      rim_dent_(rim_dent(plan.target.wedges, plan.target.options.min_wedge_angle)) {
  std::map<std::tuple<std::size_t, double, double>, std::size_t> known;
  for (std::size_t f = 0; f < plan.sweep.frequencies.size(); ++f) {
    const double frequency = plan.sweep.frequencies[f], middle = middle_of_band(frequency);
    penumbra_shares_.push_back(penumbra_share(curved_.faces, wavelength(frequency)));
    const std::size_t thin = count_thin(plan.target.thin_plate_edges, frequency);
    const auto [found, is_new] = known.try_emplace({thin, middle, plan.sweep.materials.empty() ? 0.0 : frequency}, edges_.size());
    if (is_new) find_edges(f, wavelength(middle));
    const Band band{middle, found->second};
    band_of_.push_back(static_cast<std::size_t>(std::ranges::find(bands_, band) - bands_.begin()));
    if (band_of_.back() == bands_.size()) bands_.push_back(band);
  }
}

void ModelUncertainty::find_edges(std::size_t frequency, double wavelength) {
  const Target& target = plan_.target;
  const double here = plan_.sweep.frequencies[frequency];
  std::vector<Wedge> wedges = merge_thin_plate_edges(target.wedges, target.thin_plate_edges, thin_limit(here));
  if (plan_.mechanisms.fringe) resolve_details(target.mesh, wedges, detail_limit(here), target.options.min_wedge_angle);
  std::erase_if(wedges, [](const Wedge& wedge) { return wedge.flat; });
  edges_.push_back(find_edge_features(wedges, curved_, edge_currents(frequency), wavelength));
}

EdgeCurrents ModelUncertainty::edge_currents(std::size_t frequency) const {
  EdgeCurrents currents{plan_.mechanisms.fringe, plan_.mechanisms.material_edges, {}, plan_.mechanisms.surface_waves};
  for (const Material& material : plan_.sweep.materials)
    currents.material_strengths.push_back(edge_strength(material, frequency, wavenumber(plan_.sweep.frequencies[frequency])));
  return currents;
}

RowEvidence ModelUncertainty::evidence(const Look& look, const LookResult& result, std::size_t frequency,
                                       std::vector<ScatteringMatrix>& bounces) const {
  bounces.clear();
  for (const std::vector<ScatteringMatrix>& bounce : result.tubes.bounces) bounces.push_back(bounce[frequency]);
  RowEvidence row{.facets = dents_.relative_error(look, bands_[band_of_[frequency]].frequency),
                  .rim_dent = rim_dent_,
                  .half_extent = plan_.target.mesh.radius,
                  .bounces = bounces,
                  .met = result.tubes.met,
                  .penumbra_share = penumbra_shares_[frequency]};
  if (!result.edges.scattering.empty()) row.edges = result.edges.scattering[frequency];
  if (!result.edges.higher.empty()) row.higher = result.edges.higher[frequency];
  if (!result.interaction.scattering.empty()) row.interaction = result.interaction.scattering[frequency];
  if (!result.surface.scattering.empty()) row.surface_waves = result.surface.scattering[frequency];
  const bool some_left_out = result.interaction.skipped.pairs > 0 || result.interaction.unreached;
  const bool none_afforded = some_left_out && frobenius_norm(row.interaction) == 0.0;
  row.has_surface_waves = !result.surface.scattering.empty() && plan_.sweep.materials.empty();  // they run on conductors
  row.has_interaction = !result.interaction.scattering.empty() && !none_afforded;
  if (!result.interaction.left_out.empty()) row.left_out = result.interaction.left_out[frequency];
  row.edge_order = plan_.mechanisms.fringe ? plan_.edges.order : 0;
  row.truncated = plan_.sweep.materials.empty() ? result.tubes.truncated.sigma() : 0.0;  // else it is in the numerical error
  row.wavelength = wavelength(plan_.sweep.frequencies[frequency]);
  return row;
}

std::vector<OmissionErrors> ModelUncertainty::of(const Look& look, const LookResult& result) const {
  std::vector<LookFeatures> features;
  for (const Band& band : bands_)
    features.push_back(find_look_features({plan_.target.mesh, curved_, edges_[band.edges]}, look, band.frequency));
  std::vector<OmissionErrors> errors;
  std::vector<ScatteringMatrix> bounces;
  for (std::size_t f = 0; f < plan_.sweep.frequencies.size(); ++f)
    errors.push_back(estimate_omissions(features[band_of_[f]], evidence(look, result, f, bounces)));
  return errors;
}

}  // namespace raytube
