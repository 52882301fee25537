// What a surface does to a wave.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/complex_vector.h"
#include "core/field.h"
#include "scene/layers.h"

namespace raytube {

/// Unit propagation direction after specular reflection at a plane of unit normal n.
inline dvec3 reflected_direction(const dvec3& d, const dvec3& n) { return d - 2.0 * glm::dot(d, n) * n; }

/// Electric field after reflection at a perfect conductor: E_r = -E + 2 (n.E) n  (tangential E vanishes on the surface).
inline dvec3 reflected_field_pec(const dvec3& e, const dvec3& n) { return 2.0 * glm::dot(n, e) * n - e; }

/// eta J on a perfect conductor lit by a plane wave: J = 2 n x H, eta H = d x E; n points to the side of the source.
inline dvec3 surface_current_pec(const dvec3& d, const dvec3& e, const dvec3& n) { return 2.0 * glm::cross(n, glm::cross(d, e)); }

/// Unit, across the plane of incidence: along d x n, or any direction across d at normal incidence.
dvec3 perpendicular_axis(const dvec3& d, const dvec3& n);

/// What a perfect conductor does to a wave.
inline constexpr SurfaceResponse perfect_conductor{{-1.0, 1.0}, {}};

/// What stands behind a surface.
enum class MaterialKind {
  conductor,   // perfect; of interest here where it is rough
  absorber,    // reflects nothing, lets nothing through
  half_space,  // of layers[0], whose thickness does not matter
  solid,       // the same, which fills a closed body: waves go on inside (sbr/solid)
  coated,      // layers on a perfect conductor, the outermost first
  sheet,       // layers in vacuum, from the side that normals point to
  thin_sheet   // resistance and conductance
};

/// Other than a smooth perfect conductor, at every frequency of a sweep.
struct Material {
  std::string name;                                              // of the case file or the program that made it
  MaterialKind kind = MaterialKind::absorber;                    // what it is built of
  double roughness = 0.0;                                        // rms height of the surface [m]
  std::vector<std::vector<Layer>> layers;                        // [frequency][layer]; of kinds without any: empty
  double resistance = std::numeric_limits<double>::infinity();   // thin_sheet [ohm]
  double conductance = std::numeric_limits<double>::infinity();  // thin_sheet [S]

  /// Waves go on behind it.
  bool transmits() const { return kind == MaterialKind::sheet || kind == MaterialKind::thin_sheet; }
};

/// How deep below its surface the conductor of a `coated` material lies, 0 of others [m].
double coat_depth(const Material& material, std::size_t frequency);

/// True if this one of them fills a body; a conductor has no number among them.
bool is_solid(std::span<const Material> materials, std::uint32_t material);
/// True if one of them fills a body.
bool any_solid(std::span<const Material> materials);

/// True if one of them is rough.
bool any_rough(std::span<const Material> materials);

/// For messages: material "name", or a perfect conductor for a number that none of them has.
std::string material_text(std::span<const Material> materials, std::uint32_t material);

/// The materials with the layers of these frequencies only, in their order.
std::vector<Material> at_frequencies(std::vector<Material> materials, std::span<const std::size_t> frequencies);
/// The materials at one frequency alone.
std::vector<Material> at_frequency(std::vector<Material> materials, std::size_t frequency);

/// What a smooth surface of this material does to a plane wave at one of the frequencies, met from the side that normals point
/// to, or `from_behind`: roughness is not in it. `wavenumber` [rad/m], `cosine` of the angle of incidence, above 0.
SurfaceResponse smooth_response(const Material& material, std::size_t frequency, double wavenumber, double cosine,
                                bool from_behind);

/// What roughness leaves of the reflected field: exp(-2 (k s cos theta)^2), the mean over heights of a normal distribution
/// (Ament 1953, Proc. IRE 41, 142). Valid where the surface bends little over a wavelength and does not shade itself.
double coherent_factor(const Material& material, double wavenumber, double cosine);

/// smooth_response with its reflected part times coherent_factor: what the rough surface does to the mean field.
SurfaceResponse response(const Material& material, std::size_t frequency, double wavenumber, double cosine, bool from_behind);

/// A plane wave at a plane, amplitudes at the same point. `electric_current` is eta J, eta that of vacuum; both are what the
/// tangential fields of the two sides differ by, so that they radiate all that the surface adds to the incident wave:
/// J = n x (H_i + H_r - H_t), M = -n x (E_i + E_r - E_t)  (Love's principle: Balanis 2012, section 7.8).
struct SurfaceWaves {
  ComplexVector reflected, transmitted, electric_current, magnetic_current;  // fields; eta J; M
};

/// `n` points to the side that the wave `e`, of direction `d`, comes from.
SurfaceWaves waves_at_surface(const dvec3& d, const dvec3& n, const ComplexVector& e, const SurfaceResponse& response);

/// Factors from each of two polarisations to each.
using ChannelWeights = std::array<std::array<Complex, 2>, 2>;

/// S of a wave whose two fields have these weights [own][transmit] of the transmitter's.
inline ScatteringMatrix times(const ScatteringMatrix& s, const ChannelWeights& weights) {
  ScatteringMatrix result;
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) result.at(p, q) = s.at(p, 0) * weights[0][q] + s.at(p, 1) * weights[1][q];
  return result;
}

/// What the unit waves V and H of an antenna in the direction of this basis are behind a plane that lets waves through: [wave][V
/// or H]. `normal` is that of the plane.
ChannelWeights through_screen(const Material& material, std::size_t frequency, double wavenumber, const dvec3& normal,
                              const SphericalBasis& antenna);

}  // namespace raytube
