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

/// A wave at a wedge as one face sees it.
class ImpedanceWedge {
 public:
  /// `psi` of this n must outlive it.
  ImpedanceWedge(EdgeField field, double n, const MaliuzhinetsFunction& psi, const FaceAngle& own, const FaceAngle& other,
                 const FaceIncidence& incidence);

  /// T(g) of the whole current.
  Complex exact(Complex g) const;

  SplitImpedanceKernels kernels(const GrazingRay& ray, bool pole_active) const;

 private:
  struct Pole {
    double angle;   // g
    Complex ratio;  // there
  };

  Complex face_factor(Complex w, const FaceAngle& face) const;
  Complex faces_at(Complex g) const;
  Complex ratio(Complex g) const { return faces_at(g) / at_source_; }
  Complex ratio_slope(Complex g) const;
  Complex term(Complex g, Complex at, const Pole& pole, bool taken_off) const;
  Complex fringe(Complex g, bool minus, bool plus) const;
  ImpedanceKernels regular_kernels(const GrazingRay& ray, bool pole_active) const;
  Complex value_at_edge() const;

  EdgeField field_;
  double n_;
  const MaliuzhinetsFunction& psi_;
  FaceAngle own_, other_;
  double source_;
  bool lit_;
  Complex at_source_, reflection_;  // r, of a dark face at grazing
};

}  // namespace raytube
