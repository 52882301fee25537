#include "utd/fringe/material_edges.h"

#include "utd/fringe/edge_pass.h"
#include "utd/shadow/lit_edges.h"

namespace raytube {

namespace {

// How a face passes and reflects E along the edge (soft) and H along it (hard); by default as a perfect conductor.
struct FaceCoefficients {
  Complex blocked_soft = 1.0, blocked_hard = 1.0;  // of the wave behind it, what is missing there: 1 - T
  Complex reflected_soft = -1.0, reflected_hard = 1.0;
};

// At the angle of incidence on the face, of a dark one at the same angle behind its plane.
FaceCoefficients coefficients_of(const WedgeFace& face, std::span<const Material> materials, std::size_t frequency_index,
                                 double k, const dvec3& incident) {
  if (face.material == no_index) return {};
  const double cosine = std::max(std::abs(glm::dot(incident, face.normal)), lit_threshold);
  const auto [reflected, transmitted] = response(materials[face.material], frequency_index, k, cosine, face.back);
  return {1.0 - transmitted.te, 1.0 - transmitted.tm, reflected.te, reflected.tm};
}

// A conductor's kernels are G_s = (A- - A+) / 2 and G_h = (A- + A+) / (2 sin g), g = |pi - phi| (edge_currents.h). In front of
// the face A- belongs to the reflection boundary, phi = pi - phi', and A+ to that of the shadow, phi = pi + phi'; behind it the
// other way round. So what the coefficients have in common multiplies a conductor's currents, and what they differ by exchanges
// A- - A+ and A- + A+, with the sign of sin(phi).

// S of the exchange where H is along the edge: on the cone the moment is parallel to sin(phi) phi_hat, whose sine cancels.
void add_hard_exchange(ScatteringMatrix& sum, Complex kernel, const FaceIncidence& arriving, const LookVectors& look) {
  const dvec3 across = glm::cross(arriving.tangent, look.scattered);
  const double length = glm::length(across);
  if (length == 0.0) return;
  const Complex factor = kernel / (2 * pi * arriving.sin_cone * length);
  for (const int receive : {0, 1})
    for (const int transmit : {0, 1})
      sum.at(receive, transmit) +=
          factor * glm::dot(look.magnetic[transmit], arriving.tangent) * glm::dot(look.receive[receive], across);
}

// face_amplitude by coefficients. Off the cone s . n_f / sin(beta') stands for sin(phi).
ScatteringMatrix amplitude_by(const FaceCoefficients& by, const FringeKernels& conductor, const WedgeFace& face,
                              const FaceIncidence& arriving, const LookVectors& look) {
  const Complex soft = 0.5 * (by.blocked_soft - by.reflected_soft), hard = 0.5 * (by.blocked_hard + by.reflected_hard);
  const Complex soft_exchange = 0.5 * (by.blocked_soft + by.reflected_soft),
                hard_exchange = 0.5 * (by.blocked_hard - by.reflected_hard);
  const double sine = glm::dot(look.scattered, face.normal) / arriving.sin_cone;
  const FringeKernels kernels{soft * conductor.soft - soft_exchange * conductor.hard * sine, hard * conductor.hard,
                              hard * conductor.axial};
  ScatteringMatrix result = face_amplitude(kernels, face, arriving, look);
  add_hard_exchange(result, hard_exchange * conductor.soft, arriving, look);
  return result;
}

// S of one face per length of edge.
ScatteringMatrix face_part(const Wedge& wedge, int side, const WedgeIncidence& incidence, const LookVectors& look, double k,
                           const FaceCoefficients& by, bool& windowed) {
  const WedgeFace& face = wedge.faces[side];
  const FaceIncidence& arriving = incidence.faces[side];
  const double half_cosine = grazing_half_cosine(face, arriving, look.scattered);
  const SplitKernels kernels = split_kernels(wedge.n, arriving, half_cosine);
  ScatteringMatrix part = amplitude_by(by, kernels.regular, face, arriving, look);
  if (kernels.active) {
    const WindowedPole window = windowed_pole(kernels.angle, k, face.width);
    ScatteringMatrix pole = amplitude_by(by, kernels.pole, face, arriving, look);
    part += (pole *= window.value);
    windowed = windowed || window.touched;
  }
  return part *= incidence.weight;
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
      for (const int side : {0, 1}) {
        const FaceCoefficients by = coefficients_of(wedge.faces[side], materials_, f, k, look_.incident);
        add_product(sum_.scattering[f], face_part(wedge, side, incidence, look_, k, by, windowed), phase_integral(pieces_, k));
      }
      if (windowed) sum_.windowed[f] = true;
    }
  }

 private:
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
    if (!is_material_edge(wedge)) continue;
    const WedgeIncidence incidence = incidence_on(wedge, vectors.incident);
    if (incidence.weight != 0.0 && light.find(index, incidence)) edges.add(wedge, incidence, light.lit());
  }
}

}  // namespace raytube
