#include "math/node_waves.h"

#include "math/lanes.h"

namespace raytube {

namespace {

// Channels beside one another: real parts, then imaginary ones.
using Channels = std::array<double, lanes>;

Channels channels_of(const ScatteringMatrix& s) {
  Channels result;
  for (int c = 0; c < 4; ++c) {
    result[c] = s.at(c / 2, c % 2).real();
    result[c + 4] = s.at(c / 2, c % 2).imag();
  }
  return result;
}

}  // namespace

void add_waves(std::span<const ScatteringMatrix> amplitudes, const ChebyshevNodes& nodes, std::span<const double> wavenumbers,
               double path, std::span<ScatteringMatrix> sums) {
  std::vector<Channels> samples;
  for (const ScatteringMatrix& amplitude : amplitudes) samples.push_back(channels_of(amplitude));
  auto weight = nodes.weights.begin();
  for (std::size_t f = 0; f < wavenumbers.size(); f += lanes) {
    const std::size_t count = std::min(lanes, wavenumbers.size() - f);
    Reals angles{};
    for (std::size_t i = 0; i < count; ++i) angles[i] = wavenumbers[f + i] * path;
    const Complexes phases = unit_phasors(angles);
    for (std::size_t i = 0; i < count; ++i) {
      Channels value{};
      for (std::size_t n = 0; n < amplitudes.size(); ++n) {
        const double share = *weight++;
        for (std::size_t c = 0; c < lanes; ++c) value[c] += share * samples[n][c];
      }
      for (int c = 0; c < 4; ++c)
        sums[f + i].at(c / 2, c % 2) +=
            Complex(phases.re[i] * value[c] - phases.im[i] * value[c + 4], phases.re[i] * value[c + 4] + phases.im[i] * value[c]);
    }
  }
}

void add_interpolated(std::span<const ScatteringMatrix> at_nodes, const ChebyshevNodes& nodes,
                      std::span<const double> wavenumbers, double middle, std::span<ScatteringMatrix> sums) {
  std::vector<ScatteringMatrix> amplitudes(at_nodes.begin(), at_nodes.end());
  for (std::size_t n = 0; n < amplitudes.size(); ++n) amplitudes[n] *= std::polar(1.0, -nodes.at[n] * middle);
  add_waves(amplitudes, nodes, wavenumbers, middle, sums);
}

}  // namespace raytube
