// What of a target is too small for the methods, at the lowest frequency of a sweep.
#pragma once

#include <cstddef>

#include "core/field.h"

namespace raytube {

/// Features smaller than a wavelength, and their share of the surface.
struct SmallFeatures {
  std::size_t count = 0;
  double share = 0.0;
};

struct Validity {
  double frequency;     // the lowest [Hz]
  double extent;        // of the target, the largest [m]
  SmallFeatures parts;  // components; none where there is only one
  SmallFeatures faces;  // between edges
  SmallFeatures radii;  // triangles of curved surfaces with a smaller radius of curvature
};

/// Physical optics and edge diffraction are asymptotic: from some wavelengths on they are good to about a decibel.
inline constexpr double least_wavelengths = 3.0;
inline bool too_small(const Validity& v) { return v.extent < least_wavelengths * wavelength(v.frequency); }

/// A ship of 150 m is 5 000 wavelengths wide at 10 GHz, a car as many at 300 GHz; a target of five wavelengths becomes as wide
/// where millimetres are taken for metres. Metres taken for millimetres make a car at 10 GHz
/// narrower than half a wavelength, where an asymptotic method has nothing to say.
inline constexpr double widest_plausible = 5000.0, narrowest_plausible = 0.5;  // [wavelengths]
inline bool plausible(const Validity& v) {
  const double wavelengths = v.extent / wavelength(v.frequency);
  return wavelengths >= narrowest_plausible && wavelengths <= widest_plausible;
}

/// A bolt on a truck does not count; a hundredth of the surface can outshine the rest of it where that turns away.
inline constexpr double least_share = 0.01;
inline bool matters(const SmallFeatures& features) { return features.share >= least_share; }

}  // namespace raytube
