#include "utd/fringe/material_edges.h"

#include <algorithm>

#include "utd/fringe/edge_pass.h"
#include "utd/impedance/impedance_fringe.h"
#include "utd/shadow/lit_edges.h"

namespace raytube {

namespace {

bool is_opaque(const Wedge& wedge, std::span<const Material> materials) {
  return std::ranges::none_of(
      wedge.faces, [&](const WedgeFace& face) { return face.material != no_index && materials[face.material].transmits(); });
}

class MaterialEdges {
 public:
  MaterialEdges(EdgeLookResult& sum, std::span<const Material> materials, const LookVectors& look,
                std::span<const double> frequencies)
      : sum_(sum), materials_(materials), look_(look), frequencies_(frequencies) {
    sum.scattering.resize(frequencies.size());
    sum.windowed.resize(frequencies.size());
  }

  void add(const Wedge& wedge, const WedgeIncidence& incidence, std::span<const LitInterval> lit) {
    sum_.lit = true;
    ++sum_.wedges_lit;
    find_phases(wedge, lit, look_, pieces_);
    for (std::size_t f = 0; f < frequencies_.size(); ++f) {
      const double k = wavenumber(frequencies_[f]);
      bool windowed = false;
      add_product(sum_.scattering[f], impedance_edge_amplitude(wedge, incidence, impedances(wedge, f, k), look_, k, windowed),
                  phase_integral(pieces_, k));
      if (windowed) sum_.windowed[f] = true;
    }
  }

 private:
  std::array<SurfaceImpedance, 2> impedances(const Wedge& wedge, std::size_t frequency, double k) const {
    const auto of = [&](const WedgeFace& face) {
      return face.material == no_index ? SurfaceImpedance{} : surface_impedance(materials_[face.material], frequency, k);
    };
    return {of(wedge.faces[0]), of(wedge.faces[1])};
  }

  EdgeLookResult& sum_;
  std::span<const Material> materials_;
  const LookVectors& look_;
  std::span<const double> frequencies_;
  std::vector<EdgePhase> pieces_;
};

}  // namespace

bool is_material_edge(const Wedge& wedge) { return wedge.convex() && !wedge.conducting(); }

void add_material_edges(EdgeLookResult& sum, const EdgeScene& scene, std::span<const Material> materials, const Look& look,
                        std::span<const double> frequencies, bool receiver_shadow) {
  const LookVectors vectors = look_vectors(look);
  LitEdges light(scene.wedges, scene.tracer, vectors, shortest_wavelength(frequencies), receiver_shadow);
  MaterialEdges edges(sum, materials, vectors, frequencies);
  for (std::uint32_t index = 0; index < scene.wedges.size(); ++index) {
    const Wedge& wedge = scene.wedges[index];
    if (!is_material_edge(wedge) || !is_opaque(wedge, materials)) continue;
    const WedgeIncidence incidence = incidence_on(wedge, vectors.incident);
    if (incidence.weight != 0.0 && light.find(index, incidence)) edges.add(wedge, incidence, light.lit());
  }
}

}  // namespace raytube
