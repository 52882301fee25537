#include "utd/surface/surface_waves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "scene/frequency_bands.h"
#include "solve/mechanisms/beside_waves.h"
#include "solve/mechanisms/list.h"
#include "uncertainty/constants.h"
#include "uncertainty/omissions.h"
#include "utd/fock/face_impedances.h"

namespace raytube {

namespace {

// Of sets and vehicles the estimate is larger than what waves add, by three times and more; of a convex body by itself it is good
// to a factor of two (docs/theory/surface_waves_accuracy.md). From so many wavelengths of edges on strips cost more than tubes
// do, and must add the more to be worth it.
constexpr double tolerances_of_sets = 1.5, dear_edges = 200.0;
constexpr double close_antennas = 5.0 * degree;
constexpr double ray_step = 0.1;  // of the wavelength, between points of rays for pictures

// Points between the first and the last one are `step` apart at least.
void keep_points_apart(SurfaceRay& ray, double step) {
  std::vector<SurfaceRayPoint> kept{ray.points.front()};
  for (std::size_t i = 1; i < ray.points.size(); ++i)
    if (i + 1 == ray.points.size() || std::abs(ray.points[i].arc_length - kept.back().arc_length) >= step)
      kept.push_back(ray.points[i]);
  ray.points = std::move(kept);
}

// What waves may add to a look before they are computed: the size of |S| of the co-polar channels, of the correction at shadow
// boundaries, of that where surfaces bend tightly, of sharply bent rims (docs/theory/model_uncertainty.md, B, C and E), as large
// as they are on spheres, and of edges beside curved faces; no bound.
class SurfaceWaveProspect {
 public:
  // Unless the body is convex it has so many edges that the changes from their strips over curved faces add up at random. The
  // longest wavelength of the band tells which of their faces are narrow.
  explicit SurfaceWaveProspect(const BandScene& scene)
      : mesh_(scene.plan.target.mesh),
        curved_(scene.curved_parts),
        edges_(find_edge_features(scene.plan.target.wedges, curved_, {.over_curved = !scene.band.convexity.no_reflection},
                                  wavelength(least_frequency(scene.band.frequencies)))) {}

  // Root mean square over a little more than a band, so that no chance of phases decides.
  double amplitude(const Look& look, long band) const {
    constexpr int samples = 5;
    constexpr double beside = 0.05;
    double squares = 0.0;
    for (int i = 0; i < samples; ++i)
      squares += std::pow(at(look, middle_of_band(band) * (1.0 + beside * (2.0 * i / (samples - 1) - 1.0))), 2);
    return std::sqrt(squares / samples);
  }

 private:
  double at(const Look& look, double frequency) const {
    const LookFeatures features = find_look_features({mesh_, curved_, edges_}, look, frequency);
    const double boundaries = std::max(features.shadow_boundaries[0][0], features.shadow_boundaries[1][1]);
    return std::hypot(std::hypot(boundaries, features.tight_curves, features.rims), uncertainty::edge_amplitude * features.edges);
  }

  const TriangleMesh& mesh_;
  const CurvedParts& curved_;
  EdgeFeatures edges_;
};

class WavesOverSurfaces : public Mechanism {
 public:
  explicit WavesOverSurfaces(const BandScene& scene)
      : scene_(scene), frequencies_(scene.band.frequencies), cones_(scene.round_tips.begin(), scene.round_tips.end()) {
    if (!scene.plan.surfaces.waves.forced()) prospect_.emplace(scene);
  }

  // Forward of grazing the estimate has lobes of its own: looks whose antennas stand apart take waves in any case. Close together
  // they take what either would by itself.
  Prospect prospect(const TracedLook& traced) const override {
    if (!prospect_ || !close_together(traced.look)) return {};
    Prospect result{.tolerances = tolerances()};
    std::map<long, double> known;
    for (const double frequency : frequencies_) {
      const auto [found, is_new] = known.try_emplace(band_of(frequency));
      if (is_new) found->second = band_amplitude(traced.look, found->first);
      result.amplitude.push_back(found->second);
    }
    return result;
  }

  Contribution solve(const TracedLook& traced, const std::vector<bool>& wanted, LookSink& sink) const override {
    std::vector<std::size_t> indices;
    std::vector<double> frequencies;
    for (std::size_t f = 0; f < wanted.size(); ++f)
      if (wanted[f]) indices.push_back(f), frequencies.push_back(frequencies_[f]);
    std::optional<StripPlaces> places = places_in_image(traced.look, wanted, sink);
    if (places)
      places->wavenumber = static_cast<std::size_t>(std::ranges::find(indices, sink.image->frequency_index) - indices.begin());
    const LookFromAntennas look(scene_, traced.look);
    SurfaceWaveResult found =
        surface_wave_scattering(*scene_.curved, look.local, frequencies, places ? &*places : nullptr, nullptr, cones_);
    if (places) std::ranges::move(places->pieces, std::back_inserter(sink.image->pieces));
    for (SurfaceArrival& arrival : found.arrivals) {
      arrival.magnetic = spread(arrival.magnetic, indices);
      sink.arrivals.push_back(std::move(arrival));
    }
    sink.waves_run = wanted;
    return {.s = {spread(found.scattering, indices)},
            .work = found.work,
            .counts = {{.what = "surface_strips", .count = found.strips}}};
  }

  void trace(const Look& look, std::vector<SurfaceArrival>& arrivals, std::vector<SurfaceRay>& rays) const override {
    const std::size_t first = rays.size();
    SurfaceWaveResult waves =
        surface_wave_scattering(*scene_.curved, LookFromAntennas(scene_, look).local, frequencies_, nullptr, &rays, cones_);
    arrivals = std::move(waves.arrivals);
    for (std::size_t i = first; i < rays.size(); ++i) keep_points_apart(rays[i], ray_step * wavelength(frequencies_.front()));
  }

 private:
  bool is_convex() const { return scene_.band.convexity.no_reflection; }

  static bool close_together(const Look& look) {
    const double cosine = glm::dot(spherical_basis(look.transmit).radial, spherical_basis(look.receive).radial);
    return cosine > std::cos(close_antennas) && look.transmit_range == look.receive_range;
  }

  // The same whichever of two antennas transmits.
  double band_amplitude(const Look& look, long band) const {
    Look from_transmitter = look, from_receiver = look;
    from_transmitter.receive = look.transmit, from_receiver.transmit = look.receive;
    const double amplitude = prospect_->amplitude(from_transmitter, band);
    return look.transmit == look.receive ? amplitude : std::max(amplitude, prospect_->amplitude(from_receiver, band));
  }

  double tolerances() const {
    if (is_convex()) return 1.0;
    const double edges = scene_.band.wave_surfaces->boundary_length() / wavelength(sampling_frequency(frequencies_));
    return tolerances_of_sets * std::max(1.0, edges / dear_edges);
  }

  // Nothing at the other frequencies.
  template <class Value>
  std::vector<Value> spread(const std::vector<Value>& values, const std::vector<std::size_t>& indices) const {
    std::vector<Value> all(frequencies_.size());
    for (std::size_t i = 0; i < indices.size(); ++i) all[indices[i]] = values[i];
    return all;
  }

  const BandScene& scene_;
  std::span<const double> frequencies_;
  std::vector<ConicalTip> cones_;                // that narrow strips
  std::optional<SurfaceWaveProspect> prospect_;  // unless they run in any case
};

// Facets of curved surfaces over which waves run.
std::size_t wave_facets(const SolvePlan& plan, const BandPlan& band) {
  if (!band.wave_surfaces) return 0;
  const TriangleMesh& mesh = plan.target.mesh;
  std::size_t count = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    count += band.wave_surfaces->region(t) != no_index && carries_waves(plan.sweep.materials, mesh.patch_of(t).material);
  return count;
}

MechanismState state_of_waves(const SolvePlan& plan) {
  if (!plan.surfaces.waves.possible()) return without("surfaces.waves is false");
  if (!plan.fringe()) return without("they need edge currents (edges.method = \"fringe\")");
  if (!plan.tubes.refines() || plan.tubes.curved == CurvedSurfaces::never)
    return without("with tubes.curved = \"never\", or uniform tubes, facets are the surface itself");
  const auto is_curved = [](const BandPlan& band) { return band.wave_surfaces != nullptr; };
  if (std::ranges::none_of(plan.bands, is_curved)) return without("no curved surface");
  const auto count = [&](const BandPlan& band) { return wave_facets(plan, band); };
  const BandPlan& most = *std::ranges::max_element(plan.bands, {}, count);
  const std::size_t facets = count(most), others = most.wave_surfaces ? most.wave_surfaces->facets() - facets : 0;
  if (facets == 0) return without("no curved surface is a conductor, coated or bare, or a half-space");
  return {.on = true,
          .forced = plan.surfaces.waves.forced(),
          .what = fmt::format("over {} facets{}", facets,
                              others == 0 ? "" : fmt::format(", not over {} more of other materials", others)),
          .when = "in looks where they can change a row by accuracy.tolerance_db"};
}

std::unique_ptr<Mechanism> make_waves(const BandScene& scene) {
  return scene.curved ? std::make_unique<WavesOverSurfaces>(scene) : nullptr;
}

// Whether waves run over curved surfaces of every material there is.
bool waves_run_over_all_materials(const SolvePlan& plan) {
  const std::vector<Material>& materials = plan.sweep.materials;
  for (std::uint32_t m = 0; m < materials.size(); ++m)
    if (!carries_waves(materials, m)) return false;
  return true;
}

void tell_waves(const SolvePlan& plan, const Contribution& waves, std::size_t frequency, RowEvidence& row) {
  tell_beside_waves(plan, waves, frequency, row);
  row.has_surface_waves = waves.ran_at(frequency) && waves_run_over_all_materials(plan);
}

// The curvatures at corners, and the area that each is a mean over.
double bytes_of_waves(const SolvePlan& plan) {
  double bytes = 0.0;
  for (const BandPlan& band : plan.bands)
    if (has_surface_waves(plan, band))
      bytes += static_cast<double>(band.wave_surfaces->normals() * (CurvatureField::bytes_per_normal() + sizeof(double)));
  return bytes;
}

std::string remedy_of_smooth_surfaces(const SolvePlan& plan, const MechanismShown& shown) {
  const std::string none = text_of(Omission::smooth_surfaces).remedy, facets = remedy_of_flat_facets(plan.tubes);
  if (!plan.sweep.materials.empty()) return none;
  if (!plan.fringe()) return more_edge_currents;
  if (!plan.surfaces.waves.possible()) return more_surface_waves;
  if (!facets.empty()) return facets;
  return shown.looks_without > 0 ? more_surface_waves : none;
}

}  // namespace

bool has_surface_waves(const SolvePlan& plan, const BandPlan& band) {
  return plan.state("surface_waves").on && wave_facets(plan, band) > 0;
}

MechanismEntry surface_waves_entry() {
  return {.name = "surface_waves",
          .label = "waves over curved surfaces",
          .key = "surfaces.waves",
          .budget_key = nullptr,
          .columns = {{"surface_waves", "waves over curved surfaces (surfaces.waves)", bound_on_curved_surfaces}},
          .counts = {"surface_strips"},
          .state = state_of_waves,
          .make = make_waves,
          .bytes = bytes_of_waves,
          .tell = tell_waves,
          .remedies = {{Omission::smooth_surfaces, remedy_of_smooth_surfaces}}};
}

}  // namespace raytube
