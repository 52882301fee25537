#include "utd/sheet/sheet_edges.h"

#include <algorithm>

#include "scene/frequency_bands.h"
#include "utd/shadow/edge_phase.h"
#include "utd/wedge/work.h"

namespace raytube {

SheetEdges::SheetEdges(const SheetScene& scene, const LookVectors& look, std::span<const double> frequencies, int order)
    : scene_(scene),
      look_(look),
      frequencies_(frequencies),
      order_(order),
      strips_(scene, look, wavelength(greatest_frequency(frequencies)), half_planes_) {}

ScatteringMatrix SheetEdges::fringe(const RimLook& rim, double c, const SheetPair& pair, double shortest) {
  ScatteringMatrix sum;
  for (const bool electric : {true, false}) {
    if ((electric ? pair.electric : pair.magnetic).empty()) continue;
    const SheetHalfPlane& sheet = half_planes_.at(pair, electric, rim.sin_cone, shortest);
    for (int transmit = 0; transmit < 2; ++transmit) {
      const SheetVector incident = driving_field(rim, look_, electric, transmit);
      const Received s = received(sheet_fringe(sheet, rim.nu, c, rim.b, incident), rim, look_, electric);
      for (int receive = 0; receive < 2; ++receive) sum.at(receive, transmit) += pair.current_share * s[receive];
    }
  }
  return sum;
}

void SheetEdges::add(std::uint32_t index, const WedgeIncidence& incidence, std::span<const LitInterval> lit,
                     std::span<ScatteringMatrix> first, std::span<ScatteringMatrix> higher) {
  const Wedge& wedge = scene_.wedges[index];
  const WedgeFace& face = wedge.faces[0];
  const FaceIncidence& arriving = incidence.faces[0];
  const RimLook rim(face, arriving, look_.scattered);
  const double c = apart_from_normal(-glm::dot(look_.incident, face.into_face), rim.b);
  const auto pair_at = [&](double frequency) -> const SheetPair& { return scene_.table.at(face.material, frequency); };
  if (std::ranges::all_of(frequencies_, [&](double frequency) { return pair_at(frequency).current_share == 0.0; })) return;
  const bool goes_on = order_ > 1 && arriving.sin_cone > sin_cone_floor;
  if (goes_on) strips_.lay(index, arriving, lit, order_);
  std::vector<EdgePhase> pieces;
  find_phases(wedge, lit, look_, pieces);
  for (std::size_t f = 0; f < frequencies_.size(); ++f) {
    const SheetPair& pair = pair_at(frequencies_[f]);
    if (pair.current_share == 0.0) continue;
    const double k = wavenumber(frequencies_[f]);
    const double shortest = goes_on ? strips_.shortest(k) : 1.0;  // any, without strips
    add_product(first[f], fringe(rim, c, pair, shortest), phase_integral(pieces, k));
    work_ += work::sheet_rim;
    if (goes_on) strips_.add(rim, c, pair, k, higher[f]);
  }
}

double SheetEdges::work() const {
  return work_ + strips_.work() + work::sheet_half_plane * static_cast<double>(half_planes_.made());
}

}  // namespace raytube
