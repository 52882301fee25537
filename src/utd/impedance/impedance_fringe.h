// Fringe currents of edges whose faces have an impedance: coated conductors, media that let nothing through.
#pragma once

#include "utd/impedance/impedance_wedge.h"
#include "utd/impedance/surface_impedance.h"

namespace raytube {

/// One look at one edge. Exact at normal incidence for the impedances given. Obliquely E and H along the edge are taken apart,
/// each with the impedance that belongs to k sin(beta'); off the cone of diffraction g of edge_currents.h stands for pi - phi.
/// First order; no end face of a coat, no wave guided by it. What is taken off as physical optics has the reflection of these
/// impedances, so that S is finite in every direction that it is finite in for conductors. Keeps references to its arguments.
class ImpedanceEdge {
 public:
  /// `psi` of the wedge's n.
  ImpedanceEdge(const Wedge& wedge, const WedgeIncidence& incidence, const MaliuzhinetsFunction& psi, const LookVectors& look);

  /// S per length of edge, as edge_amplitude of conductors gives it; sets `windowed` like amplitude_at.
  ScatteringMatrix amplitude(const std::array<SurfaceImpedance, 2>& of, double wavenumber, bool& windowed) const;

  /// H along the edge where it is, of unit H of the wave.
  Complex hard_at_edge(const std::array<SurfaceImpedance, 2>& of) const;

 private:
  struct Side {
    WedgeObserver observer;
    double pole = 0.0;  // y of the forward-grazing one
    bool pole_active() const { return pole > -1; }
  };
  std::array<SplitImpedanceKernels, 2> kernels(EdgeField field, const std::array<SurfaceImpedance, 2>& of) const;

  const Wedge& wedge_;
  const WedgeIncidence& incidence_;
  const MaliuzhinetsFunction& psi_;
  const LookVectors& look_;
  WedgePoint source_;  // seen from face 0
  std::array<Side, 2> sides_;
};

inline FaceAngle face_angle(EdgeField field, const SurfaceImpedance& of, double sin_cone) {
  return face_angle(field, field == EdgeField::soft ? of.soft : of.hard, sin_cone);
}

/// S per length of edge that unit eta H along it makes with these kernels of one face, per receive polarisation.
std::array<Complex, 2> radiated_by_hard(const ImpedanceKernels& kernels, const WedgeFace& face, const FaceIncidence& incidence,
                                        const LookVectors& look);

/// From the edge of the mesh to that of the planes where the impedances hold [m].
dvec3 edge_below(const Wedge& wedge, const std::array<SurfaceImpedance, 2>& faces);

}  // namespace raytube
