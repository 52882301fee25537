#include "utd/shadow/edge_phase.h"

namespace raytube {

void find_phases(const Wedge& wedge, std::span<const LitInterval> lit, const LookVectors& look, std::vector<EdgePhase>& pieces) {
  const dvec3 difference = look.scattered - look.incident, edge = wedge.end - wedge.start;
  const double length = wedge.length(), slope = glm::dot(difference, edge), start = glm::dot(difference, wedge.start);
  pieces.clear();
  for (const LitInterval& part : lit) {
    const double share = part.end - part.begin;
    pieces.push_back({share * length, share * slope / 2, start + slope * (part.begin + part.end) / 2});
  }
}

Complex phase_integral(std::span<const EdgePhase> pieces, double wavenumber) {
  Complex sum = 0.0;
  for (const EdgePhase& piece : pieces)
    sum += piece.length * sinc(wavenumber * piece.half_span) * std::polar(1.0, wavenumber * piece.middle);
  return sum;
}

void add_product(ScatteringMatrix& sum, const ScatteringMatrix& amplitude, Complex phase) {
  for (int receive = 0; receive < 2; ++receive)
    for (int transmit = 0; transmit < 2; ++transmit) sum.at(receive, transmit) += amplitude.at(receive, transmit) * phase;
}

}  // namespace raytube
