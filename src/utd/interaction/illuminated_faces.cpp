#include "utd/interaction/illuminated_faces.h"

#include <algorithm>

#include "math/node_waves.h"
#include "scene/frequency_bands.h"
#include "utd/interaction/azimuth_cuts.h"
#include "utd/interaction/near_illumination.h"
#include "utd/wedge/work.h"

namespace raytube {

namespace {

// Three rays show the paths of a panel: those of all its rays are taken to spread by this factor more.
constexpr double wider = 1.25;
// Waves over an end of the edge turn by no more than this phase against the rays beside it before they have faded [rad].
constexpr double turn_at_ends = edge_row::most_root_detour * edge_row::most_root_detour;

template <class Illumination>
AzimuthDensity density_of(Illumination& illumination) {
  return {[&](double azimuth, std::vector<ScatteringMatrix>& density) { illumination.at(azimuth, density); },
          [&](double azimuth) { return illumination.survey(azimuth); }};
}

bool reaches(std::span<const AzimuthRange> wanted, double from, double to) {
  return wanted.empty() ||
         std::ranges::any_of(wanted, [&](const AzimuthRange& range) { return range.from < to && range.to > from; });
}

// Paths of the rays at some azimuths; none if they meet nothing.
template <class Illumination>
std::optional<PathSpan> paths(Illumination& illumination, const AzimuthRange& panel, double wavenumber) {
  std::optional<PathSpan> all;
  for (const double share : {0.03, 0.5, 0.97})
    if (const auto here = illumination.survey(panel.from + share * (panel.to - panel.from))) {
      const double low = (here->low - turn_at_ends) / wavenumber, high = here->high / wavenumber;
      all = all ? PathSpan{std::min(all->low, low), std::max(all->high, high)} : PathSpan{low, high};
    }
  return all;
}

ChannelErrors worst_of(const std::vector<ChannelErrors>& errors) {
  ChannelErrors worst{};
  for (const ChannelErrors& error : errors)
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) worst[p][q] = std::max(worst[p][q], error[p][q]);
  return worst;
}

// The density for many wavenumbers: panel by panel, each with as few as the paths in it ask for.
template <class Illumination>
class BandIllumination {
 public:
  BandIllumination(const ReceivingFaces& faces, const LookVectors& look, std::span<const double> wavenumbers,
                   const LitEdgePiece& source, const IlluminationLimits& limits)
      : faces_(faces),
        look_(look),
        source_(source),
        limits_(limits),
        band_(wavenumbers),
        all_(faces, look, band_.wavenumbers(), source, limits.reflections) {
    result_.scattering.resize(wavenumbers.size());
  }

  // `share` of the tolerance.
  void add(const AzimuthRange& panel, double share) {
    const std::optional<PathSpan> span = paths(all_, panel, sampling_wavenumber(band_.wavenumbers()));
    if (!span) return;
    const ChebyshevNodes* nodes = faces_.materials.any() ? nullptr : band_.nodes_of_fresnel(wider * span->half(), node_error);
    if (!nodes) {
      const AzimuthIntegral sum = integral(all_, band_.wavenumbers().size(), panel, share);
      for (std::size_t f = 0; f < sum.value.size(); ++f) result_.scattering[f] += sum.value[f];
      return;
    }
    Illumination few(faces_, look_, nodes->at, source_, limits_.reflections);
    const AzimuthIntegral sum = integral(few, nodes->at.size(), panel, share);
    add_interpolated(sum.value, *nodes, band_.wavenumbers(), span->middle(), result_.scattering);
    few_work_ += few.work();
  }

  IlluminatedFaces take() {
    result_.work = all_.work() + few_work_;
    return std::move(result_);
  }

 private:
  AzimuthIntegral integral(Illumination& illumination, std::size_t count, const AzimuthRange& panel, double share) {
    AzimuthIntegral sum =
        integrate_over_azimuth(density_of(illumination), count, {panel.from, panel.to}, limits_.tolerance * share);
    const ChannelErrors worst = worst_of(sum.error);
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) result_.error[p][q] += worst[p][q];
    return sum;
  }

  const ReceivingFaces& faces_;
  const LookVectors& look_;
  const LitEdgePiece& source_;
  const IlluminationLimits& limits_;
  Band band_;
  Illumination all_;
  double few_work_ = 0.0;
  IlluminatedFaces result_;
};

template <class Illumination>
IlluminatedFaces over_band(const ReceivingFaces& faces, const LookVectors& look, std::span<const double> wavenumbers,
                           const LitEdgePiece& source, const IlluminationLimits& limits, const std::vector<double>& cuts) {
  BandIllumination<Illumination> illumination(faces, look, wavenumbers, source, limits);
  for (std::size_t i = 1; i < cuts.size(); ++i)
    if (reaches(limits.wanted, cuts[i - 1], cuts[i]))
      illumination.add({cuts[i - 1], cuts[i]}, (cuts[i] - cuts[i - 1]) / (cuts.back() - cuts.front()));
  return illumination.take();
}

template <class Illumination>
IlluminatedFaces at_one(const ReceivingFaces& faces, const LookVectors& look, std::span<const double> wavenumbers,
                        const LitEdgePiece& source, const IlluminationLimits& limits, const std::vector<double>& cuts) {
  Illumination illumination(faces, look, wavenumbers, source, limits.reflections);
  AzimuthDensity density = density_of(illumination);
  std::vector<ImageEdge> pieces;
  std::optional<EdgeIllumination> apart;
  if (limits.place) {
    apart.emplace(faces, look, wavenumbers, source, limits.reflections);
    density.counted = [&](double azimuth, double weight) { apart->take_apart(azimuth, weight, *limits.place, pieces); };
  }
  AzimuthIntegral all = integrate_over_azimuth(density, 1, cuts, limits.tolerance, limits.wanted);
  return {std::move(all.value), all.error[0], illumination.work(), std::move(pieces)};
}

}  // namespace

IlluminatedFaces illuminated_faces(const ReceivingFaces& faces, const LookVectors& look, std::span<const double> wavenumbers,
                                   const LitEdgePiece& source, const IlluminationLimits& limits) {
  const std::vector<double> cuts = azimuth_cuts(faces.tree.mesh(), faces.corners, source, limits.wanted);
  const bool one = wavenumbers.size() == 1, near = source.wave->antennas.has_value();
  const auto solve = near  ? one ? at_one<NearIllumination> : over_band<NearIllumination>
                      : one ? at_one<EdgeIllumination>
                           : over_band<EdgeIllumination>;
  IlluminatedFaces result = solve(faces, look, wavenumbers, source, limits, cuts);
  for (std::size_t f = 0; f < result.scattering.size(); ++f)
    result.scattering[f] = source.of_transmitter(result.scattering[f], f);
  for (ImageEdge& piece : result.pieces) piece.s = source.of_transmitter(piece.s, 0);
  result.work += work::azimuth_cut * static_cast<double>(faces.corners.size() + cuts.size());
  return result;
}

}  // namespace raytube
