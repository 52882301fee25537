#include "utd/edges.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "utd/lit_edges.h"
#include "utd/strips.h"

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

double shortest_wavelength(std::span<const double> frequencies) { return wavelength(*std::ranges::max_element(frequencies)); }

/// First order, one look: adds wedge after wedge, keeping its buffers between them.
class EndlessPass {
 public:
  EndlessPass(const Look& look, std::span<const double> frequencies) : look_(look_vectors(look)), frequencies_(frequencies) {
    result_.scattering.resize(frequencies.size());
    result_.windowed.resize(frequencies.size());
  }

  const LookVectors& look() const { return look_; }

  void add(const Wedge& wedge, const WedgeIncidence& incidence, std::span<const LitInterval> lit) {
    ++result_.wedges_lit;
    clip(wedge, lit);
    radiate(edge_amplitude(wedge, incidence, look_));
  }

  EdgeLookResult take() { return std::move(result_); }

 private:
  void clip(const Wedge& wedge, std::span<const LitInterval> lit) {
    const dvec3 difference = look_.scattered - look_.incident, edge = wedge.end - wedge.start;
    const double length = wedge.length(), slope = glm::dot(difference, edge), start = glm::dot(difference, wedge.start);
    pieces_.clear();
    for (const LitInterval& part : lit) {
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

  LookVectors look_;
  std::span<const double> frequencies_;
  std::vector<Piece> pieces_;
  EdgeLookResult result_;
};

}  // namespace

EdgeLookResult fringe_scattering(std::span<const Wedge> wedges, const Tracer& tracer, const Look& look,
                                 std::span<const double> frequencies, bool receiver_shadow) {
  assert(!frequencies.empty());
  EndlessPass pass(look, frequencies);
  LitEdges edges(wedges, tracer, pass.look(), shortest_wavelength(frequencies), receiver_shadow);
  for (std::uint32_t index = 0; index < wedges.size(); ++index) {
    if (!wedges[index].convex()) continue;
    const WedgeIncidence incidence = incidence_on(wedges[index], pass.look().incident);
    if (incidence.weight == 0.0 || !edges.find(index, incidence)) continue;
    pass.add(wedges[index], incidence, edges.lit());
  }
  return pass.take();
}

EdgeLookResult fringe_scattering(std::span<const Wedge> wedges, const Outlines& outlines, const Tracer& tracer, const Look& look,
                                 std::span<const double> frequencies, int order, bool receiver_shadow, TransitionTier tier) {
  assert(!frequencies.empty() && order > 1);
  const LookVectors vectors = look_vectors(look);
  LitEdges edges(wedges, tracer, vectors, shortest_wavelength(frequencies), receiver_shadow);
  StripWalk walk(wedges, outlines, vectors, frequencies, order, tier);
  EdgeLookResult result;
  for (std::uint32_t index = 0; index < wedges.size(); ++index) {
    if (!wedges[index].convex()) continue;
    const WedgeIncidence incidence = incidence_on(wedges[index], vectors.incident);
    // An edge that is only grazed, over one face, takes its light from the edge at the other end of that face.
    if (incidence.weight != 1.0 || !edges.find(index, incidence)) continue;
    ++result.wedges_lit;
    walk.add(index, incidence, edges.lit());
  }
  StripSums sums = walk.take();
  result.scattering = std::move(sums.first);
  result.higher = std::move(sums.higher);
  result.windowed = std::move(sums.windowed);
  return result;
}

}  // namespace raytube
