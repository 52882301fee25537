// Fringe currents of a wedge: exact current minus the physical-optics one, integrated across each face to infinity.
//
// Notation in the files of this folder:
//   s', s           directions of incidence and of scattering, unit; k the wavenumber
//   n               exterior angle of the wedge over pi: 2 half plane, 1.5 outer edge of a cube
//   x_f, n_f, t     of one face: into the face, out of the metal, and x_f x n_f along the edge, opposite for the two faces
//   beta'           angle between t and s' (beta0 where both rays lie on Keller's cone)
//   phi', phi       angles towards source and observer, from the face through free space, in [0, n pi]
//   U               1 on a lit face (phi' < pi), 0 on a dark one
//   sigma           sin(beta') x_f + cos(beta') t, the grazing diffracted ray: the one that leaves along the face
//   mu              1 - |s - sigma|^2 / (2 sin^2 beta'), never above 1; cos(phi) for an observer on the cone
//   g, h            the observer against sigma: g = pi - arccos(mu), h = cos(g/2) = |s - sigma| / (2 sin beta')
//   G_s, G_h, G_x   kernels of the current for unit E (soft) or eta H (hard) along the edge, see FringeKernels
//   F(X), W(x)      transition function of Kouyoumjian and Pathak (1974), and W(x) = e^{jx^2} erfc(e^{j pi/4} x), which is F
//                   without its root: F(X) = sqrt(pi) e^{j pi/4} x W(x), X = x^2
//   eps             angular distance to the shadow or reflection boundary of a wave
//   L, A            distance parameter and spreading factor of a diffracted ray
//
//   incidence             which faces a wave lights, at what angles
//   edge_currents         first-order currents: the kernels of semi-infinite faces, their moment and S
//   transition   F; W is in math/erfc_ray.h
//   edge_wave, edge_wave_integral   the uniform wave that leaves an edge, and integrals of it over rows of rays
//   wedge_coefficients, ray_source, diffracted_field   rays: coefficients, sources, the field at any distance
//
// Sources: Ufimtsev (1957), Sov. Phys. Tech. Phys. 2, 1708, for the idea; Michaeli (1986), IEEE Trans. AP-34, 912, for strips
// along the grazing diffracted ray and finite values on every shadow and reflection boundary.
// Valid for straight edges and planar faces of about a wavelength or more. First order: the part of the current that crosses
// the face to its next edge radiates as if the face went on; it matters for the hard polarisation (H along the edge).
#pragma once

#include "scene/sweep.h"
#include "utd/wedge/incidence.h"

namespace raytube {

/// The look as vectors.
struct LookVectors {
  dvec3 incident;                 // s'
  dvec3 scattered;                // s
  std::array<dvec3, 2> electric;  // E of a unit incident wave, transmit V and H
  std::array<dvec3, 2> magnetic;  // eta H of that
  std::array<dvec3, 2> receive;   // unit, receive V and H
};
LookVectors look_vectors(const Look& look);

/// The observer relative to the grazing diffracted ray of one face: g, sin(g), cos(g) = -mu.
struct GrazingRay {
  Complex angle;
  Complex sine;
  Complex cosine;
};

/// `half_cosine` is cos(g/2) = |s - sigma| / (2 sin beta') >= 0, which keeps its digits when s is close to sigma.
/// Above 1 (observer far off the Keller cone) g is imaginary; both signs give the same kernels.
GrazingRay grazing_ray_at(double half_cosine);

/// h of the observer in direction s = `scattered`; `into_face` is x_f.
double grazing_half_cosine(const dvec3& into_face, const FaceIncidence& incidence, const dvec3& scattered);
inline double grazing_half_cosine(const WedgeFace& face, const FaceIncidence& incidence, const dvec3& scattered) {
  return grazing_half_cosine(face.into_face, incidence, scattered);
}

/// Half-line integrals of the fringe current across one face, for unit E or eta H along the edge:
/// G_s of the soft (E_z), G_h of the hard (H_z) current, and G_x = U - 1/n + mu G_h of d(H_z)/dx.
struct FringeKernels {
  Complex soft;
  Complex hard;
  Complex axial;
};

/// Michaeli (1986) as a difference taken term by term, so that nothing cancels at the pole mu = -cos(phi') which the exact and
/// the physical-optics current share. Singular only where source and observer both graze the face, forward (see below).
FringeKernels fringe_kernels(double n, const FaceIncidence& incidence, const GrazingRay& ray);

/// G_h of a wave that grazes the face itself (phi' = 0) or the other one (phi' = n pi), as fringe_kernels gives it; real, and G_s
/// = 0.
double grazing_hard_kernel(double n, bool own_face, const GrazingRay& ray);

/// y of the forward-grazing pole: -(angle of the observer to the grazing diffracted ray + that of the source to the face's
/// plane).
double grazing_pole_angle(const FaceIncidence& incidence, double half_cosine);

/// The kernels with their forward-grazing pole set apart: kernels = regular + cot(y/2) pole, with
/// y = g + phi' - 2 pi on a lit face, g - phi' on a dark one. `active` when |y| < 1 rad; else y and pole are zero.
struct SplitKernels {
  FringeKernels regular;
  FringeKernels pole;
  double angle = 0.0;  // y, in (-1, 0] [rad]
  bool active = false;
};
SplitKernels split_kernels(double n, const FaceIncidence& incidence, double half_cosine);

/// Forward-grazing window: cot(y/2) of a half-infinite face becomes d(y) cot(y/2), d = y^2 / (y^2 + delta^2 (1 - y^2)^2) for
/// |y| < 1 and 1 beyond (the support must be compact or the cancellation at the other boundaries is lost),
/// delta = sqrt(2 / (k l)) / 2, l the width of the face. An engineering bound for faces of finite width, not a theory: on a strip
/// of 5 wavelengths lit from 3 degrees elevation the soft error falls from 0.91 to 0.37 of the rms amplitude (physical optics
/// alone 0.87), hard stays no better than physical optics. Never active in monostatic looks at a convex wedge.
struct WindowedPole {
  double value;  // d(y) cot(y/2)
  bool touched;  // d differs from 1 by more than 1e-6: ten times less than a change of 1e-4 dB
};
WindowedPole windowed_pole(double angle, double wavenumber, double face_width);

/// Vector moment of the face current, K_f = (2j/(k eta)) (across x_f + along t), for incident fields E_z and eta H_z along t.
struct FaceMoment {
  Complex across;
  Complex along;
};
FaceMoment face_moment(const FringeKernels& kernels, const FaceIncidence& incidence, double electric, double magnetic);

/// S per unit length of edge that the currents of one face with these kernels make, both polarisations (no unit).
ScatteringMatrix face_amplitude(const FringeKernels& kernels, const WedgeFace& face, const FaceIncidence& incidence,
                                const LookVectors& look);

/// S per unit length of edge for a look, both polarisations: S_pq = -(jk eta/4 pi) p_hat . (K_0 + K_1), in which k cancels, so
/// amplitude(k) = regular + sum over faces of d(y) cot(y/2) pole depends on k only through the window. S of a straight piece [m]
/// is the amplitude times the integral of e^{jq.r} along it.
struct EdgeAmplitude {
  struct Pole {
    ScatteringMatrix amplitude;
    double angle = 0.0;
    double face_width = 0.0;
    bool active = false;
  };
  ScatteringMatrix regular;
  std::array<Pole, 2> poles;
};
EdgeAmplitude edge_amplitude(const Wedge& wedge, const WedgeIncidence& incidence, const LookVectors& look);

/// The amplitude at one wavenumber; sets `windowed` if the forward-grazing window touched it, leaves it alone otherwise.
ScatteringMatrix amplitude_at(const EdgeAmplitude& amplitude, double wavenumber, bool& windowed);

}  // namespace raytube
