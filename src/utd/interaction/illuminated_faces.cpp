#include "utd/interaction/illuminated_faces.h"

#include <algorithm>

#include "core/work.h"
#include "math/chebyshev.h"
#include "utd/interaction/azimuth_cuts.h"

namespace raytube {

namespace {

// Paths that a few rays show lie between somewhat wider bounds.
constexpr double wider = 1.25;

AzimuthDensity density_of(EdgeIllumination& illumination, double most_work) {
  return {[&](double azimuth, std::vector<ScatteringMatrix>& density) { illumination.at(azimuth, density); },
          [&](double azimuth) { return illumination.survey(azimuth); },
          [&illumination, most_work] { return illumination.work() > most_work; }};
}

bool reaches(std::span<const AzimuthRange> wanted, double from, double to) {
  return wanted.empty() ||
         std::ranges::any_of(wanted, [&](const AzimuthRange& range) { return range.from < to && range.to > from; });
}

// Exponents over k of the rays at some azimuths [m]; none if they meet nothing.
std::optional<PhaseRange> paths(EdgeIllumination& illumination, std::span<const double> cuts,
                                std::span<const AzimuthRange> wanted, double wavenumber) {
  std::optional<PhaseRange> all;
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    if (!reaches(wanted, cuts[i - 1], cuts[i])) continue;
    for (const double share : {0.03, 0.5, 0.97})
      if (const auto here = illumination.survey(cuts[i - 1] + share * (cuts[i] - cuts[i - 1])))
        all = all ? PhaseRange{std::min(all->low, here->low), std::max(all->high, here->high)} : *here;
  }
  if (all) *all = {all->low / wavenumber, all->high / wavenumber};
  return all;
}

std::vector<ScatteringMatrix> interpolated(std::vector<ScatteringMatrix> samples, const ChebyshevNodes& nodes,
                                           std::span<const double> wavenumbers, double path) {
  for (std::size_t n = 0; n < samples.size(); ++n) samples[n] *= std::polar(1.0, -nodes.at[n] * path);
  std::vector<ScatteringMatrix> values(wavenumbers.size());
  auto weight = nodes.weights.begin();
  for (std::size_t f = 0; f < values.size(); ++f) {
    for (const ScatteringMatrix& sample : samples) values[f] += ScatteringMatrix(sample) *= *weight++;
    values[f] *= std::polar(1.0, wavenumbers[f] * path);
  }
  return values;
}

ChannelErrors worst_of(const std::vector<ChannelErrors>& errors) {
  ChannelErrors worst{};
  for (const ChannelErrors& error : errors)
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) worst[p][q] = std::max(worst[p][q], error[p][q]);
  return worst;
}

}  // namespace

// A single wavenumber needs no others that stand for it.
IlluminatedFaces illuminated_faces(const ReceivingFaces& faces, const LookVectors& look, std::span<const double> wavenumbers,
                                   const LitEdgePiece& source, const IlluminationLimits& limits) {
  EdgeIllumination illumination(faces, look, wavenumbers, source, limits.reflections);
  const std::vector<double> cuts = azimuth_cuts(faces.tree.mesh(), faces.corners, source, limits.wanted);
  const double cutting = work::azimuth_cut * static_cast<double>(faces.corners.size() + cuts.size());
  Band band(wavenumbers);
  const ChebyshevNodes* nodes = nullptr;
  std::optional<PhaseRange> range;
  if (wavenumbers.size() > 1) {
    range = paths(illumination, cuts, limits.wanted, std::ranges::max(wavenumbers));
    if (!range) return {std::vector<ScatteringMatrix>(wavenumbers.size()), {}, cutting + illumination.work()};
    nodes = band.nodes_of_fresnel(wider * (range->high - range->low) / 2);
  }
  if (!nodes) {
    AzimuthIntegral all =
        integrate_over_azimuth(density_of(illumination, limits.work), wavenumbers.size(), cuts, limits.tolerance, limits.wanted);
    return {std::move(all.value), worst_of(all.error), cutting + illumination.work(), all.complete};
  }
  EdgeIllumination few(faces, look, nodes->at, source, limits.reflections);
  AzimuthIntegral at_nodes =
      integrate_over_azimuth(density_of(few, limits.work), nodes->at.size(), cuts, limits.tolerance, limits.wanted);
  return {interpolated(std::move(at_nodes.value), *nodes, wavenumbers, (range->low + range->high) / 2), worst_of(at_nodes.error),
          cutting + illumination.work() + few.work(), at_nodes.complete};
}

}  // namespace raytube
