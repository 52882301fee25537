#include "utd/fringe/material_edges.h"

#include <algorithm>

#include "utd/shadow/edge_phase.h"
#include "utd/wedge/work.h"

namespace raytube {

bool is_material_edge(const Wedge& wedge, std::span<const Material> materials) {
  return wedge.stands_alone() && !wedge.conducting() && (is_sheet_rim(wedge, materials) || is_opaque(wedge, materials));
}

MaterialEdges::MaterialEdges(const EdgeScene& scene, const LookVectors& look, std::span<const double> frequencies, int order)
    : known_(scene.materials), wedges_(scene.wedges), look_(look), frequencies_(frequencies) {
  if (known_ == nullptr) return;
  sheets_.emplace(SheetScene{scene.wedges, scene.outlines, known_->materials, known_->sheets}, look, frequencies, order);
  if (order > 1) strips_.emplace(scene.wedges, scene.outlines, known_->impedances, look, frequencies);
  first_.resize(frequencies.size()), windowed_.resize(frequencies.size());
  if (order > 1) higher_.resize(frequencies.size());
}

std::optional<WedgeIncidence> EdgeMaterials::meeting(const Wedge& wedge, const dvec3& incident) const {
  if (!radiates(wedge)) return std::nullopt;
  WedgeIncidence incidence = incidence_on(wedge, incident);
  if (is_sheet_rim(wedge, materials) && incidence.weight < 1.0)
    incidence.weight = 1.0, incidence.free_side = wedge.faces[0].normal;
  return incidence.weight == 0.0 ? std::nullopt : std::optional(incidence);
}

void MaterialEdges::add(std::uint32_t index, const WedgeIncidence& incidence, std::span<const LitInterval> lit) {
  const Wedge& wedge = wedges_[index];
  if (is_sheet_rim(wedge, known_->materials)) return sheets_->add(index, incidence, lit, first_, higher_);
  add_opaque(index, incidence, lit);
}

void MaterialEdges::add_opaque(std::uint32_t index, const WedgeIncidence& incidence, std::span<const LitInterval> lit) {
  const Wedge& wedge = wedges_[index];
  std::vector<EdgePhase> pieces;
  find_phases(wedge, lit, look_, pieces);
  const ImpedanceEdge edge(wedge, incidence, functions_.at(wedge.n), look_);
  for (std::size_t f = 0; f < frequencies_.size(); ++f) {
    const double k = wavenumber(frequencies_[f]);
    const auto of = known_->impedances.at(wedge, f);
    bool windowed = false;
    ScatteringMatrix amplitude = edge.amplitude(of, k, windowed);
    if (wedge.thickness() > 0.0) amplitude += CoatedRim(wedge, incidence, look_, edge).amplitude(rim_faces(wedge, of, f), k);
    add_product(first_[f], amplitude, phase_integral(pieces, k));
    if (windowed) windowed_[f] = true;
  }
  work_ += work::impedance_edge * static_cast<double>(frequencies_.size());
  if (strips_ && incidence.faces[0].sin_cone > sin_cone_floor) strips_->add(index, incidence, lit, higher_);
}

RimFaces MaterialEdges::rim_faces(const Wedge& wedge, const std::array<SurfaceImpedance, 2>& sides, std::size_t frequency) const {
  const ImpedanceTable& table = known_->impedances;
  const double k = wavenumber(frequencies_[frequency]);
  return {sides, table.at_border(wedge, frequency, k, border_cosine(wedge, look_.incident)), table.border_coated(wedge)};
}

void MaterialEdges::add_to(EdgeLookResult& result) {
  if (known_ == nullptr) return;
  for (std::size_t f = 0; f < first_.size(); ++f) result.scattering[f] += first_[f];
  for (std::size_t f = 0; f < windowed_.size(); ++f)
    if (windowed_[f]) result.windowed[f] = true;
  for (std::size_t f = 0; f < higher_.size(); ++f) result.higher[f] += higher_[f];
  result.work += work_ + sheets_->work() + (strips_ ? strips_->work() : 0.0);
}

}  // namespace raytube
