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

// A conductor's kernels are G_s = (A- - A+) / 2, G_h = (A- + A+) / (2 sin g) and G_x = constant - cos g G_h (edge_currents.h): A-
// belongs to the shadow boundary, A+ to that of reflection.
FringeKernels by_coefficients(const FringeKernels& conductor, const GrazingRay& ray, const FaceCoefficients& by) {
  const Complex both = ray.sine * conductor.hard, shadow = both + conductor.soft, reflection = both - conductor.soft;
  const Complex soft = 0.5 * (by.blocked_soft * shadow + by.reflected_soft * reflection),
                hard = (by.blocked_hard * shadow + by.reflected_hard * reflection) / (2.0 * ray.sine),
                constant = conductor.axial + ray.cosine * conductor.hard;
  return {soft, hard, 0.5 * (by.blocked_hard + by.reflected_hard) * constant - ray.cosine * hard};
}

// S of one face per length of edge.
ScatteringMatrix face_part(const Wedge& wedge, int side, const WedgeIncidence& incidence, const LookVectors& look, double k,
                           const FaceCoefficients& by, bool& windowed) {
  const WedgeFace& face = wedge.faces[side];
  const FaceIncidence& arriving = incidence.faces[side];
  const double half_cosine = grazing_half_cosine(face, arriving, look.scattered);
  const GrazingRay ray = grazing_ray_at(half_cosine);
  const SplitKernels kernels = split_kernels(wedge.n, arriving, half_cosine);
  ScatteringMatrix part = face_amplitude(by_coefficients(kernels.regular, ray, by), face, arriving, look);
  if (kernels.active) {
    const WindowedPole window = windowed_pole(kernels.angle, k, face.width);
    ScatteringMatrix pole = face_amplitude(by_coefficients(kernels.pole, ray, by), face, arriving, look);
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

void add_material_edges(EdgeLookResult& sum, const EdgeScene& scene, std::span<const Material> materials, const Look& look,
                        std::span<const double> frequencies, bool receiver_shadow) {
  const LookVectors vectors = look_vectors(look);
  LitEdges light(scene.wedges, scene.tracer, vectors, shortest_wavelength(frequencies), receiver_shadow);
  MaterialEdges edges(sum, materials, vectors, frequencies);
  for (std::uint32_t index = 0; index < scene.wedges.size(); ++index) {
    const Wedge& wedge = scene.wedges[index];
    if (!wedge.convex() || wedge.conducting()) continue;
    const WedgeIncidence incidence = incidence_on(wedge, vectors.incident);
    if (incidence.weight != 0.0 && light.find(index, incidence)) edges.add(wedge, incidence, light.lit());
  }
}

}  // namespace raytube
