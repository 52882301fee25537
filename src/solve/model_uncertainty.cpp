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

void add_inside(const TubeSums& tubes, std::size_t frequency, RowEvidence& row) {
  if (tubes.inside.empty()) return;
  row.inside = tubes.inside[frequency].s;
  row.left_solids = tubes.inside[frequency].left;
}

}  // namespace

ModelUncertainty::ModelUncertainty(const SolvePlan& plan)
    : plan_(plan),
      curved_(find_curved_parts(plan.target.mesh, plan.target.options.min_wedge_angle)),
      body_of_(plan.sweep.frequencies.size()),
      rim_dent_(rim_dent(plan.target.wedges, plan.target.options.min_wedge_angle)) {
  find_dents();
  std::map<std::tuple<std::size_t, double, double>, std::size_t> known;
  for (std::size_t f = 0; f < plan.sweep.frequencies.size(); ++f) {
    const double frequency = plan.sweep.frequencies[f], middle = middle_of_band(raytube::band_of(frequency));
    penumbra_shares_.push_back(penumbra_shares(curved_.faces, wavelength(frequency), plan.sweep.materials));
    const std::size_t thin = count_thin(plan.thin_plate_edges, frequency);
    const auto [found, is_new] = known.try_emplace({thin, middle, plan.sweep.materials.empty() ? 0.0 : frequency}, edges_.size());
    if (is_new) find_edges(f, wavelength(middle));
    const Band band{middle, found->second};
    band_of_.push_back(static_cast<std::size_t>(std::ranges::find(bands_, band) - bands_.begin()));
    if (band_of_.back() == bands_.size()) bands_.push_back(band);
  }
}

void ModelUncertainty::find_dents() {
  const TriangleMesh& mesh = plan_.target.mesh;
  const double max_crease = doubtful_crease(plan_.target.options.min_wedge_angle);
  const SmoothSurfaces meant =
      plan_.known_surfaces ? SmoothSurfaces(*plan_.known_surfaces, max_crease) : SmoothSurfaces(mesh, max_crease);
  for (const BandPlan& body : plan_.bands) {
    for (const std::size_t index : body.indices) body_of_[index] = dents_.size();
    dents_.emplace_back(mesh, body.smooth.get(), meant);
  }
}

void ModelUncertainty::find_edges(std::size_t frequency, double wavelength) {
  std::vector<Wedge> wedges = *set_of(plan_.wedge_sets, frequency).wedges;
  std::erase_if(wedges, &Wedge::flat);
  edges_.push_back(find_edge_features(wedges, curved_, edge_currents(frequency), wavelength));
}

EdgeCurrents ModelUncertainty::edge_currents(std::size_t frequency) const {
  const bool of_materials = plan_.fringe() && plan_.edges.materials != MaterialEdgeMethod::none;
  EdgeCurrents currents{plan_.fringe(), of_materials, {}, {}, plan_.state("surface_waves").on};
  const double k = wavenumber(plan_.sweep.frequencies[frequency]);
  for (const Material& material : plan_.sweep.materials) {
    currents.material_strengths.push_back(edge_strength(material, frequency, k));
    // Of a thick sheet next to nothing, so that it is a sheet still.
    currents.sheet_shares.push_back(material.transmits() ? std::max(sheet_share(material, frequency, k), 1e-6) : 0.0);
  }
  return currents;
}

std::vector<LookFeatures> ModelUncertainty::features(const Look& look) const {
  std::vector<LookFeatures> features;
  for (const Band& band : bands_)
    features.push_back(find_look_features({plan_.target.mesh, curved_, edges_[band.edges]}, look, band.frequency));
  return features;
}

RowEvidence ModelUncertainty::evidence_of_tubes(const Look& look, std::size_t frequency,
                                                std::span<const ScatteringMatrix> bounces) const {
  return {.facets = dents_[body_of_[frequency]].relative_error(look, bands_[band_of_[frequency]].frequency),
          .rim_dent = rim_dent_,
          .half_extent = plan_.target.mesh.radius,
          .bounces = bounces,
          .penumbras = penumbra_shares_[frequency],
          .edge_order = plan_.fringe() ? plan_.edges.order : 0,
          .wavelength = wavelength(plan_.sweep.frequencies[frequency])};
}

RowEvidence ModelUncertainty::evidence(const Look& look, const LookResult& result, std::size_t frequency,
                                       std::vector<ScatteringMatrix>& bounces) const {
  bounces = result.tubes.bounces_at(frequency);
  RowEvidence row = evidence_of_tubes(look, frequency, bounces);
  row.met = result.met[body_of_[frequency]];
  add_inside(result.tubes, frequency, row);
  for (std::size_t i = 0; i < result.mechanisms.size(); ++i)
    if (const auto tell = plan_.mechanisms[i].tell) tell(plan_, result.mechanisms[i], frequency, row);
  row.truncated =
      plan_.sweep.materials.empty() ? result.truncated[body_of_[frequency]] : 0.0;  // else it is in the numerical error
  return row;
}

std::vector<OmissionErrors> ModelUncertainty::of(const Look& look, const LookResult& result) const {
  const std::vector<LookFeatures> found = features(look);
  std::vector<OmissionErrors> errors;
  std::vector<ScatteringMatrix> bounces;
  for (std::size_t f = 0; f < plan_.sweep.frequencies.size(); ++f)
    errors.push_back(estimate_omissions(found[band_of_[f]], evidence(look, result, f, bounces)));
  return errors;
}

std::vector<ChannelErrors> ModelUncertainty::at_least(const Look& look, std::size_t band, const TubeSums& tubes) const {
  const std::vector<LookFeatures> found = features(look);
  const bool waves = plan_.state("surface_waves").on, interaction = plan_.state("interaction").on;
  std::vector<ChannelErrors> errors;
  const std::vector<std::size_t>& frequencies = plan_.bands[band].indices;
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    const std::vector<ScatteringMatrix> bounces = tubes.bounces_at(i);
    RowEvidence row = evidence_of_tubes(look, frequencies[i], bounces);
    row.met = tubes.met;
    add_inside(tubes, i, row);
    row.has_surface_waves = waves, row.has_interaction = interaction;
    errors.push_back(root_sum_square(estimate_omissions(found[band_of_[frequencies[i]]], row)));
  }
  return errors;
}

}  // namespace raytube
