// A look as edges meet it: from antennas at infinity or at a finite distance.
#pragma once

#include <optional>

#include "mesh/model/triangle_mesh.h"
#include "scene/frequency_bands.h"
#include "utd/fringe/near_pieces.h"
#include "utd/shadow/viewpoint.h"

namespace raytube {

/// Plane waves: the same everywhere, or those that the waves of antennas at a finite distance are at each point.
class EdgeLook {
 public:
  /// From antennas at infinity.
  EdgeLook(const Look& look) : look_(look), everywhere_(look_vectors(look)) {}
  /// From where the look says; `frequencies` [Hz] must not be empty.
  EdgeLook(const Look& look, const Radar& radar, const TriangleMesh& mesh, std::span<const double> frequencies);
  EdgeLook(const EdgeLook&) = delete;

  bool far() const { return !near_; }

  /// Fields with their amplitudes there, without phase.
  LookVectors at(const dvec3& point) const { return near_ ? near_->at(point) : everywhere_; }
  dvec3 incident(const dvec3& point) const { return near_ ? near_->incident(point) : everywhere_.incident; }

  /// Phases over k, less those at the reference: of the wave that comes to a point, and of what it sends on [m].
  double arriving(const dvec3& point) const { return near_ ? -near_->path_in(point) : -glm::dot(everywhere_.incident, point); }
  double leaving(const dvec3& point) const { return near_ ? -near_->path_out(point) : glm::dot(everywhere_.scattered, point); }

  /// Where the transmitter is, and the receiver; none if that is the same place.
  Viewpoint transmitter() const;
  std::optional<Viewpoint> receiver() const;

  /// In which a point sees their polarisations.
  SphericalBasis transmit_basis(const dvec3& point) const;
  SphericalBasis receive_basis(const dvec3& point) const;

  /// The wedge in pieces along which the waves are plane; whole from infinity.
  std::vector<NearPiece> pieces(const Wedge& wedge) const;

 private:
  const Look& look_;
  LookVectors everywhere_{};               // from infinity
  std::optional<AntennaPair> antennas_{};  // at a finite distance
  std::optional<NearLook> near_{};         // refers to them
  double wavenumber_ = 0.0;
};

}  // namespace raytube
