// An antenna at a finite distance as plane mirrors show it.
#pragma once

#include "scene/antenna.h"

namespace raytube {

/// Keeps a reference to the antenna.
class ImageAntenna {
 public:
  explicit ImageAntenna(const Antenna& antenna) : antenna_(&antenna) {}

  /// As a conducting plane shows this one.
  ImageAntenna reflected(const dvec3& normal, double offset) const {
    ImageAntenna image(*this);
    image.turn_ = turn_ * (glm::dmat3(1.0) - 2.0 * glm::outerProduct(normal, normal));
    image.shift_ = shift_ + turn_ * (2.0 * offset * normal);
    image.sign_ = -sign_;
    return image;
  }

  AntennaRay ray_to(const dvec3& point) const {
    AntennaRay ray = antenna_->ray_to(turn_ * point + shift_);
    ray.direction = ray.direction * turn_;
    for (dvec3& field : ray.field) field = sign_ * (field * turn_);
    return ray;
  }

  dvec3 position() const { return (antenna_->position() - shift_) * turn_; }
  dvec3 radial() const { return antenna_->radial() * turn_; }  // unit, towards it from where rays come in parallel
  const Antenna& antenna() const { return *antenna_; }

 private:
  const Antenna* antenna_;
  glm::dmat3 turn_{1.0};  // a point is to the antenna itself where turn point + shift is
  dvec3 shift_{0.0};      // [m]
  double sign_ = 1.0;     // sign of E, turned by each conductor
};

/// The transmitter as mirrors show it, and the receiver.
struct NearAntennas {
  ImageAntenna transmit;
  const Antenna* receive;
};

/// Refers to the antennas of the pair.
inline NearAntennas near_antennas(const AntennaPair& pair) { return {ImageAntenna(pair.transmit), &pair.receive}; }

}  // namespace raytube
