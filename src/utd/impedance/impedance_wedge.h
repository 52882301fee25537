// The exact current of a wedge with impedance faces, as seen from one of them, less the physical-optics one.
//
// Notation of utd/wedge/edge_currents.h, and
//   u          what is along the edge: E (soft) or eta H (hard)
//   theta      of a face: sin(theta) = 1/Z (soft) or Z (hard), Z its impedance over eta; where the plane reflects none of u
//   r          reflection of u by the face at phi': (sin phi' - sin theta) / (sin phi' + sin theta)
//   T(g)       what a face radiates of u towards phi = pi - g; from behind it g < 0. The even part is of the current that u
//              drives along the edge (electric if soft), the odd one of that across it (magnetic if soft)
// T is s(-Phi - g) of Maliuzhinets' integral; at a conductor G_s of the soft one and -sin(g) G_h of the hard one.
// Sources: Maliuzhinets (1958), Sov. Phys. Dokl. 3, 752; Senior & Volakis (1995), Approximate boundary conditions, ch. 3.
#pragma once

#include <optional>

#include "utd/impedance/maliuzhinets.h"
#include "utd/wedge/edge_currents.h"

namespace raytube {

enum class EdgeField { soft, hard };

/// theta of a face.
struct FaceAngle {
  Complex angle;           // not used of a conductor
  bool conductor = false;  // perfect
};
FaceAngle face_angle(EdgeField field, Complex impedance, double sin_cone);

/// Kernels of the fringe current of one face for one field, as FringeKernels are of a conductor: of the current along the edge
/// that u drives, of that across it, and what the current across adds along the edge where it is met obliquely.
struct ImpedanceKernels {
  Complex along, across, axial;
};

/// Kernels with their forward-grazing pole set apart, see SplitKernels.
struct SplitImpedanceKernels {
  ImpedanceKernels regular, pole;
};

/// Faces of one angle theta at wedges of one n, in the field that it is of.
class ImpedanceFace {
 public:
  ImpedanceFace(EdgeField field, double n, const MaliuzhinetsFunction& psi, const FaceAngle& face);

  /// psi(w + pi/2 - theta) psi(w - pi/2 + theta) / psi(pi/2)^2 and its limits for conductors.
  Complex factor(const MaliuzhinetsPoint& w) const;
  /// r at the sine of phi'.
  Complex reflection(Complex sine) const;
  bool conductor() const { return !pair_; }

 private:
  EdgeField field_;
  double n_;
  Complex sine_;                          // sin(theta)
  std::optional<MaliuzhinetsPair> pair_;  // none of a conductor
};

/// g, and where the factors of the face and of the other one are taken there.
struct WedgePoint {
  Complex g;
  MaliuzhinetsPoint own, other;
};
WedgePoint wedge_point(double n, const MaliuzhinetsFunction& psi, Complex g);

/// The source, as one face sees it: g = -phi'.
WedgePoint source_point(double n, const MaliuzhinetsFunction& psi, const FaceIncidence& incidence);

/// The observer, in front of a face and behind it, whatever the faces are.
struct WedgeObserver {
  GrazingRay ray;
  WedgePoint front, behind;
};
WedgeObserver wedge_observer(double n, const MaliuzhinetsFunction& psi, const GrazingRay& ray);

/// Psi(-Phi - g) of Maliuzhinets; Psi(phi' - Phi) of the source is its value at g = -phi'.
inline Complex faces_at(const WedgePoint& point, const ImpedanceFace& own, const ImpedanceFace& other) {
  return own.factor(point.own) * other.factor(point.other);
}

/// T(g) of the whole current for a source at phi', by the ratio of faces_at(g) to what it is at the source; even in g.
inline Complex whole_wave(double n, Complex g, Complex source) {
  return std::sin(source / n) / (n * (std::cos(source / n) - std::cos(g / n)));
}

/// Kernels of the whole current, not less physical optics, from T(g) and T(-g); `at_edge` is half of u there. For |g| not below
/// 1e-3.
ImpedanceKernels whole_kernels(const GrazingRay& ray, Complex front, Complex behind, Complex at_edge);

/// A wave at a wedge as one face sees it. Keeps references to its arguments.
class ImpedanceWedge {
 public:
  /// `at_source` is faces_at there, the same for both faces.
  ImpedanceWedge(EdgeField field, double n, const MaliuzhinetsFunction& psi, const ImpedanceFace& own, const ImpedanceFace& other,
                 const FaceIncidence& incidence, Complex at_source);

  SplitImpedanceKernels kernels(const WedgeObserver& observer, bool pole_active) const;

 private:
  struct Pole {
    double angle;   // g
    Complex ratio;  // there
  };

  Complex ratio(const WedgePoint& at) const { return faces_at(at, own_, other_) / at_source_; }
  Complex ratio(Complex g) const { return ratio(wedge_point(n_, psi_, g)); }
  Complex ratio_slope(Complex g) const;
  Complex term(Complex g, Complex at, const Pole& pole, bool taken_off) const;
  Complex fringe(const WedgePoint& at, bool minus, bool plus) const;
  Complex odd_fringe(double g, bool minus, bool plus) const;
  ImpedanceKernels regular_kernels(const WedgeObserver& observer, bool pole_active) const;
  Complex value_at_edge() const;

  EdgeField field_;
  double n_;
  const MaliuzhinetsFunction& psi_;
  const ImpedanceFace &own_, &other_;
  double source_;
  bool lit_;
  Complex at_source_, reflection_;  // r, of a dark face at grazing
};

}  // namespace raytube
