#include "utd/fringe/material_edges.h"

namespace raytube {

bool is_material_edge(const Wedge& wedge, std::span<const Material> materials) {
  return wedge.stands_alone() && is_sheet_rim(wedge, materials);
}

MaterialEdges::MaterialEdges(const EdgeScene& scene, const LookVectors& look, std::span<const double> frequencies, int order)
    : known_(scene.materials), wedges_(scene.wedges), look_(look) {
  if (known_ == nullptr) return;
  sheets_.emplace(SheetScene{scene.wedges, scene.outlines, known_->materials, known_->sheets}, look, frequencies, order);
  first_.resize(frequencies.size());
  if (order > 1) higher_.resize(frequencies.size());
}

std::optional<WedgeIncidence> MaterialEdges::meeting(std::uint32_t index) const {
  const Wedge& wedge = wedges_[index];
  if (known_ == nullptr || !known_->radiates(wedge)) return std::nullopt;
  WedgeIncidence incidence = incidence_on(wedge, look_.incident);
  if (incidence.weight < 1.0) incidence.weight = 1.0, incidence.free_side = wedge.faces[0].normal;
  return incidence;
}

void MaterialEdges::add(std::uint32_t index, const WedgeIncidence& incidence, std::span<const LitInterval> lit) {
  sheets_->add(index, incidence, lit, first_, higher_);
}

void MaterialEdges::add_to(EdgeLookResult& result) {
  if (known_ == nullptr) return;
  for (std::size_t f = 0; f < first_.size(); ++f) result.scattering[f] += first_[f];
  for (std::size_t f = 0; f < higher_.size(); ++f) result.higher[f] += higher_[f];
  result.work += sheets_->work();
}

}  // namespace raytube
