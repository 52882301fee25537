// Fock's currents on surfaces of an impedance (Fock 1946; Wait 1967, Radio Sci. 2, 927).
#pragma once

#include "utd/fock/face_impedances.h"
#include "utd/fock/fock.h"

namespace raytube {

/// At a distance xi from the shadow boundary in units of its width 1 / (m kappa), m = (k / 2 kappa)^(1/3), as fock_in_the_dark in
/// the dark and without e^{-j xi^3/3} in the light, down to xi = -5. With W(tau) = Ai(tau e^{-j 2 pi/3}), on the contour of
/// fock_in_the_dark,
///   hard (e^{j pi/6} / 2 pi) integral e^{-j xi tau} / (W' + j m Z_hard W) dtau,      H along the binormal,
///   soft (e^{j pi/6} / 2 pi) integral e^{-j xi tau} m / (Z_soft W' + j m W) dtau,    m eta J for E along it:
/// dH/dn = j k Z_hard H and dE/dn = j k E / Z_soft; E along the surface is eta Z J. Valid when nothing is gained, Re Z >= 0, with
/// Z the same for all waves within 1/m of grazing. Error 5e-5 of the current of physical optics there.
FockCurrents impedance_fock(double xi, double m, const FaceImpedance& impedance);

}  // namespace raytube
