#include "utd/impedance/impedance_strips.h"

#include <algorithm>
#include <cmath>

#include "utd/wedge/work.h"

namespace raytube {

namespace {

FaceIncidence arriving_at(const WedgeFace& face, const dvec3& direction, double sine) {
  const dvec3 tangent = glm::cross(face.into_face, face.normal);
  return {.tangent = tangent, .cos_cone = glm::dot(direction, tangent), .sin_cone = sine};
}

// The least electrical length of strips whose current is one of waves.
constexpr double shortest = 0.3;

// What a wave counts from whose reflection boundary lies along the strips: its pole is on the path of integration then. Less than
// 1 within some distance of the path's points, an engineering bound as that of forward grazing (edge_currents.h). Strips that are
// shorter than any wave count as little.
double boundary_window(const FaceIncidence& incidence, double electrical_length) {
  constexpr double width = 0.3;
  const double y = 2.0 * std::sin(0.5 * (pi - incidence.source_angle)), x = electrical_length * std::pow(incidence.sin_cone, 2);
  return y * y / (y * y + width * width / x) * x * x / (x * x + shortest * shortest);
}

// The length that the path of integration is laid for: the next power of 2, so that a row of a sweep is what it is alone.
double step_of_length(double electrical_length) {
  return std::exp2(std::round(std::log2(std::max(electrical_length, shortest))));
}

// From the edges of the mesh to those of the planes where the impedances hold, there and back [m].
double lag(const StripEdge& from, const StripEdge& to, const std::array<SurfaceImpedance, 2>& of_from,
           const std::array<SurfaceImpedance, 2>& of_to, const LookVectors& look) {
  return glm::dot(look.scattered, edge_below(to.wedge, of_to)) - glm::dot(look.incident, edge_below(from.wedge, of_from));
}

}  // namespace

ImpedanceStrips::ImpedanceStrips(std::span<const Wedge> wedges, const Outlines& outlines, const ImpedanceTable& table,
                                 const LookVectors& look, std::span<const double> frequencies)
    : wedges_(wedges),
      table_(table),
      look_(look),
      frequencies_(frequencies),
      tree_(wedges, outlines, nullptr, look.incident, look.scattered, false) {}

void ImpedanceStrips::add(std::uint32_t index, const WedgeIncidence& incidence, std::span<const LitInterval> lit,
                          std::span<ScatteringMatrix> sums) {
  const Wedge& wedge = wedges_[index];
  for (const int face : {0, 1}) {
    tree_.grow(first_wave(wedges_, index, face, incidence.faces[face], look_.incident, 1), lit);
    work_ += tree_.work();
    const StripEdge from{wedge, face, incidence.faces, functions_.at(wedge.n)};
    const TreeWave& wave = tree_.waves()[0];
    for (std::uint32_t b = wave.first_bundle; b < wave.end_bundle; ++b) arrive(from, incidence.weight, tree_.bundles()[b], sums);
  }
}

void ImpedanceStrips::arrive(const StripEdge& from, double weight, const StripBundle& bundle, std::span<ScatteringMatrix> sums) {
  if (!bundle.edge || bundle.edge->any_wedge == no_index) return;
  const Wedge& far = wedges_[bundle.edge->any_wedge];
  const dvec3& direction = tree_.waves()[0].wave.direction;
  const double sine = -glm::dot(direction, bundle.edge->into_face), length = bundle.length_at((bundle.from + bundle.to) / 2);
  if (!table_.known(far) || sine < along_edge || !(length > 0.0)) return;
  const auto met = [&](int face) { return arriving_at(far.faces[face], direction, sine); };
  const StripEdge to{far, bundle.edge->wedge_face, {met(0), met(1)}, functions_.at(far.n)};
  std::optional<ImpedanceStrip> strip;
  double made_for = 0.0;
  for (std::size_t f = 0; f < frequencies_.size(); ++f) {
    const double k = wavenumber(frequencies_[f]);
    if (const double step = step_of_length(k * length); step != made_for) strip.emplace(from, to, look_, made_for = step);
    const auto of_from = table_.at(from.wedge, f), of_to = table_.at(far, f);
    const StripEcho echo = strip->echo(of_from, of_to);
    const std::array<Complex, 2> sum = echo.over(bundle, k);
    const double counted = weight * skew_window(sine) * boundary_window(from.incidence[from.face], k * length);
    const Complex turned = std::polar(counted, k * lag(from, to, of_from, of_to, look_));
    for (const int transmit : {0, 1})
      for (const int receive : {0, 1})
        sums[f].at(receive, transmit) +=
            turned * glm::dot(look_.magnetic[transmit], from.incidence[from.face].tangent) * sum[receive];
  }
  work_ += work::impedance_strip * static_cast<double>(frequencies_.size());
}

}  // namespace raytube
