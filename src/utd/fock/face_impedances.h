// Impedances of curved faces that waves run over.
#pragma once

#include <span>
#include <vector>

#include "mesh/model/triangle_mesh.h"
#include "scene/material.h"
#include "utd/wedge/face_impedance.h"

namespace raytube {

/// Whether waves run over faces of it: over perfect conductors (no_index, or rough), coats on them and half-spaces of
/// |eps mu| >= 2. An absorber returns nothing at any angle, which no impedance does.
bool carries_waves(std::span<const Material> materials, std::uint32_t material);

/// The impedances of materials that waves run over, at the frequencies of a sweep.
class FaceImpedances {
 public:
  /// `materials` at `frequencies`; refers to both.
  FaceImpedances(std::span<const Material> materials, std::span<const double> frequencies);

  /// At grazing incidence, where waves along the face leave it; at other wavenumbers than those of the frequencies between the
  /// next ones, linear. `material` is none of a perfect conductor.
  FaceImpedance at(std::uint32_t material, double wavenumber) const;

 private:
  std::vector<double> wavenumbers_;                   // ascending
  std::vector<std::vector<FaceImpedance>> at_faces_;  // [material][ascending]
};

}  // namespace raytube
