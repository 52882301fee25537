// What is asked of a solve: directions, frequencies, antennas, materials. Plain data only; what comes out stands in results.h.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "scene/antenna.h"
#include "scene/material.h"

namespace raytube {

/// A pair of directions from the target: to the transmitter and to the receiver (equal for a monostatic look), and how far these
/// are from the origin of the mesh's own coordinates [m]: both at a finite distance, or neither.
struct Look {
  Direction transmit;                                               // towards the transmitter
  Direction receive;                                                // towards the receiver
  double transmit_range = std::numeric_limits<double>::infinity();  // of the transmitter [m]
  double receive_range = std::numeric_limits<double>::infinity();   // of the receiver [m]
  /// By which a turntable has turned the target about z, from +x towards +y, under antennas that stand [rad]. Directions count
  /// from the target and know of it; what the antennas are aimed at does not.
  double turn = 0.0;
  /// Height z [m] of the plane that the transmitter is mirrored in, where it is the mirror image of one: AntennaPosition.
  std::optional<double> transmit_mirror{};
  std::optional<double> receive_mirror{};  // of the receiver
  /// By which what the antennas are aimed at has moved with them [m].
  dvec3 aim_way{0.0};

  /// Both are at infinity.
  bool far() const { return std::isinf(transmit_range); }
  AntennaPosition transmitter() const { return {transmit, transmit_range, transmit_mirror}; }  // where it stands
  AntennaPosition receiver() const { return {receive, receive_range, receive_mirror}; }        // where it stands
};

/// The ways from the transmitter of a look to places and from places to its receiver [m]; from infinity, beyond those to the
/// origin.
class Ways {
 public:
  /// Of a look; keeps nothing of it.
  explicit Ways(const Look& look)
      : far_(look.far()),
        transmit_(far_ ? spherical_basis(look.transmit).radial : look.transmitter().point()),
        receive_(far_ ? spherical_basis(look.receive).radial : look.receiver().point()) {}

  /// From the transmitter to a place.
  double to(const dvec3& place) const { return way(transmit_, place); }
  /// From a place to the receiver.
  double from(const dvec3& place) const { return way(receive_, place); }
  /// From the transmitter over a place to the receiver.
  double over(const dvec3& place) const { return to(place) + from(place); }

 private:
  double way(const dvec3& end, const dvec3& place) const { return far_ ? -glm::dot(end, place) : glm::distance(end, place); }

  bool far_;
  dvec3 transmit_, receive_;  // where the antennas are, or the directions to them
};

/// A point that stands while a turntable turns, in the coordinates that turn with it.
inline dvec3 seen_from_turntable(const dvec3& point, double turn) {
  const double c = std::cos(turn), s = std::sin(turn);
  return {c * point.x + s * point.y, c * point.y - s * point.x, point.z};
}

/// Transmitter and receiver of a look from a finite distance, in recentred coordinates. Keeps references to the pattern.
struct AntennaPair {
  /// `mesh_center` in the mesh's own coordinates [m].
  AntennaPair(const Look& look, const Radar& radar, const dvec3& mesh_center)
      : transmit(look.transmitter(), -mesh_center, seen_from_turntable(radar.aim, look.turn) + look.aim_way - mesh_center,
                 radar.pattern),
        receive(look.receiver(), -mesh_center,
                seen_from_turntable(radar.receive_aim.value_or(radar.aim), look.turn) + look.aim_way - mesh_center,
                radar.pattern) {}
  Antenna transmit, receive;  // equal for a monostatic look
};

/// The half space below a plane across z.
struct Ground {
  double height = 0.0;                 // z of the plane in the mesh's own coordinates [m]
  std::optional<Material> material{};  // of the surface; none: a perfect conductor

  /// It is one.
  bool perfect() const { return !material.has_value(); }
};

/// Every look at every frequency. Rows of the result: looks vary slowest, frequency fastest.
struct Sweep {
  std::vector<double> frequencies;  // [Hz], > 0
  std::vector<Look> looks;          // in the order of rows
  bool bistatic = false;  // receive directions were given (they may still coincide); else every look is its own receiver
  Radar radar{};          // of looks from a finite distance
  std::vector<Material> materials{};  // of the target: see Patch::material
  std::vector<double> times{};        // [look] [s] at which it is taken, of a scene that moves; empty: nothing does

  /// How many rows the result has.
  std::size_t rows() const { return frequencies.size() * looks.size(); }
  /// Row of a look and a frequency, by their indices.
  std::size_t row(std::size_t look, std::size_t frequency) const { return look * frequencies.size() + frequency; }
};

}  // namespace raytube
