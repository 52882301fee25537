#include "utd/fringe/edge_look.h"

namespace raytube {

EdgeLook::EdgeLook(const Look& look, const Radar& radar, const TriangleMesh& mesh, std::span<const double> frequencies)
    : look_(look), everywhere_(look_vectors(look)), wavenumber_(raytube::wavenumber(sampling_frequency(frequencies))) {
  if (look.far()) return;
  antennas_.emplace(look, radar, mesh.center);
  near_.emplace(near_antennas(*antennas_), wavenumber_, mesh.radius);
}

Viewpoint EdgeLook::transmitter() const {
  return near_ ? Viewpoint::at(antennas_->transmit.position()) : Viewpoint(-everywhere_.incident);
}

std::optional<Viewpoint> EdgeLook::receiver() const {
  if (!near_)
    return everywhere_.scattered == -everywhere_.incident ? std::nullopt : std::optional<Viewpoint>(everywhere_.scattered);
  const dvec3 position = antennas_->receive.position();
  return position == antennas_->transmit.position() ? std::nullopt : std::optional(Viewpoint::at(position));
}

SphericalBasis EdgeLook::transmit_basis(const dvec3& point) const {
  return near_ ? antennas_->transmit.basis_at(point) : spherical_basis(look_.transmit);
}

SphericalBasis EdgeLook::receive_basis(const dvec3& point) const {
  return near_ ? antennas_->receive.basis_at(point) : spherical_basis(look_.receive);
}

std::vector<NearPiece> EdgeLook::pieces(const Wedge& wedge) const {
  if (!near_) return {{0.0, 1.0, wedge.at(0.5), everywhere_, 0.0}};
  std::vector<NearPiece> pieces;
  PieceCutter(*near_, wavenumber_).cut(wedge, 0.0, 1.0, pieces);
  return pieces;
}

}  // namespace raytube
