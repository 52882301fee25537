// Uniform diffraction coefficients of a perfectly conducting wedge: geometrical-optics rays plus these give the total field.
#pragma once

#include "core/field.h"

namespace raytube {

/// One diffracted ray. Angles are measured from face 0 through free space, both in [0, n pi] [rad].
struct DiffractedRay {
  double n = 2.0;                   // exterior angle / pi
  double source_angle = 0.0;        // phi': towards the source
  double observation_angle = 0.0;   // phi: towards the observer
  double sin_cone = 1.0;            // sin(beta0), beta0 between the edge and either ray
  double distance_parameter = 0.0;  // L [m]: s sin^2(beta0) for a plane wave seen at distance s
};

/// Soft (E along the edge) and hard (H along the edge) coefficients [sqrt(m)].
struct WedgeCoefficients {
  Complex soft;
  Complex hard;
};

/// Kouyoumjian and Pathak (1974), Proc. IEEE 62, 1448. Valid when k L is not below about 1 (error of the total field
/// 0.02 to 0.1 over k rho) and, for n < 1, when every multiply reflected geometrical-optics ray is added.
/// Tie rule: exactly on a shadow or reflection boundary (to 1e-12 rad) the half that changes sign there is dropped, and the
/// geometrical-optics ray of that boundary must be given the weight 1/2. Any other pairing is wrong by the whole incident field.
WedgeCoefficients wedge_coefficients(const DiffractedRay& ray, double wavenumber);

}  // namespace raytube
