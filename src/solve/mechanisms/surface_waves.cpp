#include "solve/mechanisms/surface_waves.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "scene/frequency_bands.h"
#include "solve/mechanisms/states.h"
#include "uncertainty/omissions.h"
#include "uncertainty/surface_wave_prospect.h"
#include "utd/rounded/rims.h"
#include "utd/surface/surface_waves.h"
#include "utd/tip/flat_tip_waves.h"
#include "utd/tip/tip_waves.h"

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

// Root mean square over a little more than a band, so that no chance of phases decides.
double band_amplitude(const SurfaceWaveProspect& prospect, const Look& look, long band) {
  constexpr int samples = 5;
  constexpr double beside = 0.05;
  double squares = 0.0;
  for (int i = 0; i < samples; ++i)
    squares += std::pow(prospect.amplitude(look, middle_of_band(band) * (1.0 + beside * (2.0 * i / (samples - 1) - 1.0))), 2);
  return std::sqrt(squares / samples);
}

class WavesOverSurfaces : public Mechanism {
 public:
  explicit WavesOverSurfaces(const BandScene& scene)
      : scene_(scene), frequencies_(scene.band.frequencies), tips_(find_tips(*scene.curved)), cones_(tips_.begin(), tips_.end()) {
    std::map<double, std::vector<Nose>> noses;
    for (const double frequency : frequencies_) {
      const auto [found, is_new] = noses.try_emplace(longest_nose(frequency));
      if (is_new) found->second = scene.curved->short_noses(found->first);
      rims_.push_back(rim_pieces(found->second, wavenumber(frequency)));
      const long band = band_of(frequency);
      if (!flat_tips_.contains(band))
        flat_tips_.try_emplace(band, find_flat_tips(*scene.curved, wavelength(middle_of_band(band))));
    }
    const Target& target = scene.plan.target;
    if (!scene.plan.surfaces.waves.forced())
      prospect_.emplace(target.mesh, target.wedges, target.options.min_wedge_angle,
                        wavelength(least_frequency(scene.band.frequencies)), !is_convex());
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
    const bool in_image = sink.image != nullptr && wanted[sink.image->frequency_index];
    StripPlaces places{};
    if (in_image && sink.image->by_path) places.by_path = PathPlace{look_vectors(traced.look).scattered};
    if (in_image)
      places.wavenumber = static_cast<std::size_t>(std::ranges::find(indices, sink.image->frequency_index) - indices.begin());
    const std::optional<AntennaPair> antennas = antennas_of(traced.look);
    SurfaceWaveResult found = surface_wave_scattering(*scene_.curved, local(traced.look, antennas), frequencies,
                                                      in_image ? &places : nullptr, nullptr, cones_);
    LocalLook rim_look = local(traced.look, antennas);
    for (std::size_t i = 0; i < indices.size(); ++i) {
      const double k = wavenumber(frequencies[i]);
      StripPlaces* of_image = in_image && places.wavenumber == i ? &places : nullptr;
      found.scattering[i] += rim_scattering(*scene_.curved, rims_[indices[i]], rim_look, k, of_image);
      found.scattering[i] += flat_tips_.at(band_of(frequencies[i])).scattering(*scene_.curved, rim_look, k, of_image);
    }
    add_tips(rim_look, frequencies, in_image ? &places : nullptr, found.scattering);
    if (in_image) std::ranges::move(places.pieces, std::back_inserter(sink.image->pieces));
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
    const std::optional<AntennaPair> antennas = antennas_of(look);
    SurfaceWaveResult waves =
        surface_wave_scattering(*scene_.curved, local(look, antennas), frequencies_, nullptr, &rays, cones_);
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
    const double amplitude = raytube::band_amplitude(*prospect_, from_transmitter, band);
    return look.transmit == look.receive ? amplitude
                                         : std::max(amplitude, raytube::band_amplitude(*prospect_, from_receiver, band));
  }

  std::optional<AntennaPair> antennas_of(const Look& look) const {
    if (look.far()) return {};
    return AntennaPair(look, scene_.plan.sweep.radar, scene_.plan.target.mesh.center);
  }

  void add_tips(LocalLook& look, std::span<const double> frequencies, StripPlaces* places,
                std::vector<ScatteringMatrix>& scattering) const {
    std::vector<double> wavenumbers;
    for (const double f : frequencies) wavenumbers.push_back(wavenumber(f));
    const std::vector<ScatteringMatrix> s = tip_scattering(*scene_.curved, tips_, look, wavenumbers, places);
    for (std::size_t i = 0; i < s.size(); ++i) scattering[i] += s[i];
  }

  // Refers to the antennas.
  LocalLook local(const Look& look, const std::optional<AntennaPair>& antennas) const {
    if (!antennas) return look_vectors(look);
    return NearLook(near_antennas(*antennas), wavenumber(sampling_frequency(frequencies_)), scene_.plan.target.mesh.radius);
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
  std::vector<Tip> tips_;
  std::vector<ConicalTip> cones_;
  std::map<long, FlatTipWaves> flat_tips_;       // by band_of()
  std::vector<std::vector<RimPiece>> rims_;      // [frequency]
  std::optional<SurfaceWaveProspect> prospect_;  // unless they run in any case
};

}  // namespace

std::unique_ptr<Mechanism> make_surface_waves(const BandScene& scene) {
  return scene.curved ? std::make_unique<WavesOverSurfaces>(scene) : nullptr;
}

void tell_surface_waves(const SolvePlan& plan, const Contribution& waves, std::size_t frequency, RowEvidence& row) {
  row.surface_waves = waves.at(0, frequency);
  row.has_surface_waves = waves.ran_at(frequency) && waves_run_over_all_materials(plan);
}

// The curvatures at corners.
double surface_waves_bytes(const SolvePlan& plan) {
  double bytes = 0.0;
  for (const BandPlan& band : plan.bands)
    if (has_surface_waves(plan, band))
      bytes += static_cast<double>(band.wave_surfaces->normals()) * (sizeof(glm::dmat3) + sizeof(double));
  return bytes;
}

}  // namespace raytube
