#include "sbr/solid/solid_currents.h"

#include "sbr/beams/current_map.h"
#include "sbr/solid/phase_mean.h"

namespace raytube {

namespace {

bool same(const Medium& a, const Medium& b) { return a.permittivity == b.permittivity && a.permeability == b.permeability; }

bool same(const Material& material, std::size_t a, std::size_t b) {
  if (material.kind == MaterialKind::coated || material.roughness > 0.0) return false;
  return material.layers.empty() || same(material.layers[a].front().medium, material.layers[b].front().medium);
}

ChannelWeights operator+(ChannelWeights a, const ChannelWeights& b) {
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) a[p][q] += b[p][q];
  return a;
}

}  // namespace

std::vector<FrequencyGroup> frequency_groups(const SpectralSurfaces& surfaces) {
  std::vector<FrequencyGroup> groups;
  const std::size_t first = surfaces.first_frequency_index;
  for (std::size_t f = 0; f < surfaces.wavenumbers.size(); ++f) {
    const auto as_before = [&](const Material& material) { return same(material, first + f - 1, first + f); };
    if (f > 0 && std::ranges::all_of(surfaces.materials, as_before))
      ++groups.back().end;
    else
      groups.push_back({f, f + 1});
  }
  return groups;
}

void SolidCurrents::add_leaving(const TubePiece& piece, const Rays& rays, const Hits& hits, const Complex& spreading,
                                int bounce) {
  std::array<ChannelWeights, 3> weights;
  for (std::size_t i = 0; i < 3; ++i) weights[i] = radiated(-hits[i].normal, rays[i].ray.direction, rays[i].field, look_.receive);
  const double amplitude = raytube::amplitude(rays[0], lowest_);
  add(piece, hits, weights, spreading, bounce, piece.area() * amplitude * amplitude);
}

void SolidCurrents::add_meeting(const TubePiece& piece, const Hits& hits, const Complex& spreading, int bounce) {
  std::array<ChannelWeights, 3> weights;
  for (std::size_t i = 0; i < 3; ++i) {
    const SolidHit& hit = hits[i];
    weights[i] = radiated(hit.normal, hit.arriving.ray.direction, hit.arriving.field, look_.receive);
    if (const std::optional<SolidRay> ray = waves_.reflected(hit))
      weights[i] = weights[i] + radiated(hit.normal, ray->ray.direction, ray->field, look_.receive);
  }
  add(piece, hits, weights, spreading, bounce, 0.0);
}

void SolidCurrents::add(const TubePiece& piece, const Hits& hits, const std::array<ChannelWeights, 3>& weights,
                        const Complex& spreading, int bounce, double left) {
  const ChannelWeights sum = weights[0] + weights[1] + weights[2];
  const dvec3 side = hits[1].arriving.point - hits[0].arriving.point, other = hits[2].arriving.point - hits[0].arriving.point;
  const double area = 0.5 * glm::length(glm::cross(side, other)) / (piece.probe * piece.probe);
  std::vector<ScatteringMatrix>& sums = sums_.at(bounce, look_.wavenumbers().size());
  for (std::size_t f = frequencies_.begin; f < frequencies_.end; ++f) {
    const double k = look_.wavenumbers()[f];
    const Complex factor = Complex(0.0, -k / (4.0 * pi)) * spreading * (area / 3.0) * mean(piece, hits, k);
    ScatteringMatrix s;
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) s.at(p, q) = factor * sum[p][q];
    sums[f] += s;
    sums_.add_inside(f, sums.size(), {s, left});
    count_error(piece, f, s);
    if (look_.map && look_.map->frequency_index() == f) look_.map->add(bounce, piece.middle(), triangle_, s);
  }
  ++sums_.hits[static_cast<std::size_t>(bounce)];
  sums_.meet(bounce, piece.area(), amplitude(hits[0].arriving, lowest_));
}

// As if the wave were the plane one of its rays all over the piece. Rays of a narrow one stand for corners far off: nowhere in a
// passive body a wave is stronger than without losses.
Complex SolidCurrents::mean(const TubePiece& piece, const Hits& hits, double wavenumber) const {
  std::array<Complex, 3> x;
  for (std::size_t i = 0; i < 3; ++i)
    x[i] = wavenumber *
           Complex(glm::dot(look_.receive.radial, hits[i].arriving.point) - hits[i].arriving.path, hits[i].arriving.loss);
  const Complex middle = (x[0] + x[1] + x[2]) / 3.0;
  for (Complex& corner : x) {
    corner = middle + (corner - middle) / piece.probe;
    corner.imag(std::max(corner.imag(), 0.0));
  }
  return triangle_phase_mean(x);
}

// An edge may run anywhere through a narrow piece.
void SolidCurrents::count_error(const TubePiece& piece, std::size_t f, const ScatteringMatrix& s) {
  if (!piece.narrow()) return;
  sums_.pieces.resize(look_.wavenumbers().size());
  ScatteringMatrix error = s;
  sums_.pieces[f].add(error *= 0.5);
}

}  // namespace raytube
