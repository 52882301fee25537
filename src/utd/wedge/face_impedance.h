// The impedance of a plane that nothing goes through.
#pragma once

#include "scene/layers.h"

namespace raytube {

/// E along a plane over eta H, for E across the plane of incidence (soft) and in it (hard); a perfect conductor has 0.
struct FaceImpedance {
  Complex soft, hard;
};

/// As good as grazing incidence: Z depends on the square of this cosine, 1e-8 of it, and 1e-12 is lost in 1 + r.
inline constexpr double grazing_cosine = 1e-4;

/// The impedance of a plane with this reflection at this cosine of incidence.
inline FaceImpedance impedance_of(const SurfaceResponse::Polarised& reflected, double cosine) {
  return {(1.0 + reflected.te) / (cosine * (1.0 - reflected.te)), cosine * (1.0 - reflected.tm) / (1.0 + reflected.tm)};
}

}  // namespace raytube
