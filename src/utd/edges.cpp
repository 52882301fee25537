#include "utd/edges.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "utd/edge_currents.h"
#include "utd/visibility.h"

namespace raytube {

namespace {

/// A straight lit piece of an edge in the phase of a look: integral of e^{jq.r} = length sinc(k half_span) e^{jk middle}.
struct Piece {
  double length;     // [m]
  double half_span;  // (s - s') . l / 2 [m]
  double middle;     // (s - s') . c [m], c the piece's midpoint
};

Complex phase_integral(std::span<const Piece> pieces, double wavenumber) {
  Complex sum = 0.0;
  for (const Piece& piece : pieces)
    sum += piece.length * sinc(wavenumber * piece.half_span) * std::polar(1.0, wavenumber * piece.middle);
  return sum;
}

void add_product(ScatteringMatrix& sum, const ScatteringMatrix& amplitude, Complex phase) {
  for (int receive = 0; receive < 2; ++receive)
    for (int transmit = 0; transmit < 2; ++transmit) sum.at(receive, transmit) += amplitude.at(receive, transmit) * phase;
}

/// One look: adds wedge after wedge, keeping its buffers between them.
class EdgePass {
 public:
  EdgePass(const Tracer& tracer, const Look& look, std::span<const double> frequencies)
      : tracer_(tracer), look_(look_vectors(look)), frequencies_(frequencies) {
    shortest_wavelength_ = wavelength(*std::ranges::max_element(frequencies));
    result_.scattering.resize(frequencies.size());
    result_.windowed.resize(frequencies.size());
  }

  void add(const Wedge& wedge) {
    const WedgeIncidence incidence = incidence_on(wedge, look_.incident);
    find_lit_intervals(wedge, incidence, -look_.incident, shortest_wavelength_, tracer_, lit_);
    if (lit_.empty()) return;
    ++result_.wedges_lit;
    clip(wedge);
    radiate(edge_amplitude(wedge, incidence, look_));
  }

  EdgeLookResult take() { return std::move(result_); }

 private:
  void clip(const Wedge& wedge) {
    const dvec3 difference = look_.scattered - look_.incident, edge = wedge.end - wedge.start;
    const double length = wedge.length(), slope = glm::dot(difference, edge), start = glm::dot(difference, wedge.start);
    pieces_.clear();
    for (const LitInterval& part : lit_) {
      const double share = part.end - part.begin;
      pieces_.push_back({share * length, share * slope / 2, start + slope * (part.begin + part.end) / 2});
    }
  }

  void radiate(const EdgeAmplitude& amplitude) {
    for (std::size_t index = 0; index < frequencies_.size(); ++index) {
      const double k = wavenumber(frequencies_[index]);
      bool windowed = false;
      add_product(result_.scattering[index], amplitude_at(amplitude, k, windowed), phase_integral(pieces_, k));
      if (windowed) result_.windowed[index] = true;
    }
  }

  const Tracer& tracer_;
  LookVectors look_;
  std::span<const double> frequencies_;
  double shortest_wavelength_ = 0.0;
  std::vector<LitInterval> lit_;
  std::vector<Piece> pieces_;
  EdgeLookResult result_;
};

}  // namespace

EdgeLookResult fringe_scattering(std::span<const Wedge> wedges, const Tracer& tracer, const Look& look,
                                 std::span<const double> frequencies) {
  assert(!frequencies.empty());
  EdgePass pass(tracer, look, frequencies);
  for (const Wedge& wedge : wedges)
    if (wedge.convex()) pass.add(wedge);
  return pass.take();
}

}  // namespace raytube
