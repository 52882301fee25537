#include "sbr/beams/far_fields.h"

#include <algorithm>
#include <cmath>

namespace raytube {

namespace {

// S = -(jk / 4 pi) p_hat . eta J * integral (Stratton & Chu 1939), the phase reference moved from `path` to zero.
template <class Amplitudes>
void add_scaled(ScatteringMatrix& sum, const Amplitudes& amplitudes, double k, double path) {
  const Complex factor = Complex(0.0, -k / (4.0 * pi)) * std::polar(1.0, k * path);
  for (std::size_t c = 0; c < 4; ++c) sum.s[c / 2][c % 2] += factor * Complex(amplitudes.re[c], amplitudes.im[c]);
}

Reals scaled(const Reals& x, double factor, double shift = 0.0) {
  Reals result;
  for (std::size_t i = 0; i < lanes; ++i) result[i] = factor * (x[i] - shift);
  return result;
}

}  // namespace

void FarFields::add(const Footprint& f, const dvec2& center, const dvec2& size) {
  const dvec2 offset = center - f.outgoing.anchor;
  const double phase = f.phase + f.phase_u * offset.x + f.phase_v * offset.y, half_u = 0.5 * f.phase_u * size.x,
               half_v = 0.5 * f.phase_v * size.y, half = std::abs(half_u) + std::abs(half_v);
  if (f.outgoing.spectrum) {
    spectral_.push_back({f.outgoing.spectrum, phase, half_u, half_v, f.area * size.x * size.y});
    return;
  }
  const std::size_t lane = count_++ % lanes;
  if (lane == 0) blocks_.push_back({});
  Block& block = blocks_.back();
  nearest_ = count_ == 1 ? phase - half : std::min(nearest_, phase - half);
  farthest_ = count_ == 1 ? phase + half : std::max(farthest_, phase + half);
  block.phase[lane] = phase;
  block.half_u[lane] = half_u;
  block.half_v[lane] = half_v;
  const double area = f.area * size.x * size.y;
  for (std::size_t c = 0; c < 4; ++c) block.weight[lane][c] = f.weight[c / 2][c % 2] * area;
}

// Lanes that no tube has filled weigh nothing.
FarFields::Amplitudes FarFields::at(double k, double path) const {
  Amplitudes sum;
  for (const Block& block : blocks_) {
    const Complexes phasors = unit_phasors(scaled(block.phase, k, path));
    const Reals across = sincs(scaled(block.half_u, k)), down = sincs(scaled(block.half_v, k));
    for (std::size_t i = 0; i < lanes; ++i) {
      const double magnitude = across[i] * down[i], re = phasors.re[i] * magnitude, im = phasors.im[i] * magnitude;
      for (std::size_t c = 0; c < 4; ++c) sum.re[c] += block.weight[i][c] * re;
      for (std::size_t c = 0; c < 4; ++c) sum.im[c] += block.weight[i][c] * im;
    }
  }
  return sum;
}

void FarFields::add_up(std::vector<ScatteringMatrix>& sums) {
  if (count_ > 0 || spectral_.empty()) add_up_blocks(sums);
  for (std::size_t f = 0; f < sums.size(); ++f) {
    const double k = band_.wavenumbers()[f];
    for (const Spectral& tube : spectral_) {
      const double magnitude = k / (4.0 * pi) * tube.area * sinc(k * tube.half_u) * sinc(k * tube.half_v);
      const Complex factor = Complex(0.0, -magnitude) * std::polar(1.0, k * tube.phase);
      const auto& weight = (*tube.spectrum)[f].weight;
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q) sums[f].at(p, q) += factor * weight[p][q];
    }
  }
  spectral_.clear();
}

void FarFields::add_up_blocks(std::vector<ScatteringMatrix>& sums) {
  const double middle = 0.5 * (nearest_ + farthest_);
  if (const ChebyshevNodes* nodes = band_.nodes(0.5 * (farthest_ - nearest_)))
    interpolate(*nodes, middle, sums);
  else
    for (std::size_t f = 0; f < sums.size(); ++f)
      add_scaled(sums[f], at(band_.wavenumbers()[f], 0.0), band_.wavenumbers()[f], 0.0);
  blocks_.clear();
  count_ = 0;
}

// The sum over the tubes of e^{jk (exponent - path)} is a function of k that a few nodes determine; the factor k is not part of
// it.
void FarFields::interpolate(const ChebyshevNodes& nodes, double path, std::vector<ScatteringMatrix>& sums) {
  samples_.clear();
  for (const double k : nodes.at) samples_.push_back(at(k, path));
  auto weight = nodes.weights.begin();
  for (std::size_t f = 0; f < sums.size(); ++f) {
    Amplitudes value;
    for (const Amplitudes& sample : samples_) {
      const double w = *weight++;
      for (std::size_t c = 0; c < 4; ++c) value.re[c] += w * sample.re[c];
      for (std::size_t c = 0; c < 4; ++c) value.im[c] += w * sample.im[c];
    }
    add_scaled(sums[f], value, band_.wavenumbers()[f], path);
  }
}

}  // namespace raytube
