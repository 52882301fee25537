// What one edge sends over a face of impedance to another one. Notation in impedance_wedge.h.
//
// What an edge sends along a face is a spectrum of plane waves at the angles a from it, and each is diffracted by the far edge:
//   P2 = 1/(2 pi) INT P1(-a) P2(a) e^{-jk l sin^2(beta') cos a} da     over the path of steepest descent through a = 0,
// -a for an observer behind the face and a for a source in front of it, so that near grazing the wave counts half. The pole of
// the wave that the coat guides, a = -theta, adds its residue where the path leaves it on the other side, and the one at a =
// theta as much. H along the edges only: E along them dies out along the face, and what the far edge makes of it was found to
// change nothing. (Clemmow 1966, The plane wave spectrum representation, ch. 3; Senior & Volakis 1995, ch. 3, 5.)
#pragma once

#include "utd/impedance/impedance_fringe.h"
#include "utd/multiple/wave_tree.h"

namespace raytube {

/// Of Maliuzhinets' function, as good as second order wants it.
inline constexpr double strip_digits = 14.0;

/// One of the edges, and its face that the strip runs over.
struct StripEdge {
  const Wedge& wedge;
  int face;
  std::array<FaceIncidence, 2> incidence;  // of the far edge all but the angle of the source
  const MaliuzhinetsFunction& psi;
};

/// What unit eta H along the first edge makes over its strips.
class StripEcho {
 public:
  struct Wave {
    Complex growth;                   // by k l
    std::array<Complex, 2> received;  // S per length of the first edge, per receive polarisation
  };
  void add(const Wave& wave) { waves_.push_back(wave); }

  /// S [m] of strips side by side, with their phase.
  std::array<Complex, 2> over(const StripBundle& strips, double wavenumber) const;

 private:
  std::vector<Wave> waves_;
};

/// All of the way from edge to edge that no material changes. Keeps references to its arguments.
class ImpedanceStrip {
 public:
  /// `electrical_length` k l is that of strips it is made for, about.
  ImpedanceStrip(const StripEdge& from, const StripEdge& to, const LookVectors& look, double electrical_length);

  StripEcho echo(const std::array<SurfaceImpedance, 2>& from, const std::array<SurfaceImpedance, 2>& to) const;

 private:
  /// One plane wave of the spectrum.
  struct Passing {
    Complex weight;
    Complex growth;                      // by k l
    std::array<WedgePoint, 2> leaving;   // as the strip's face sees it, and the other one
    std::array<Complex, 2> sent;         // over the ratio of faces_at, by the first edge's faces
    std::array<Complex, 2> met;          // the same of the far edge
    Complex at_edge;                     // half of the field there, times faces_at of the source
    MaliuzhinetsPoint at_own, at_other;  // there, as at a source
  };
  struct Ends;
  Passing passing(Complex angle, Complex weight) const;
  Complex sent(const Ends& ends, const Passing& wave) const;
  std::array<Complex, 2> received(const Ends& ends, const Passing& wave) const;
  void add(const Ends& ends, const Passing& wave, StripEcho& sum) const;

  StripEdge from_, to_;
  const LookVectors& look_;
  double cones_;  // sines of the edges' cones, divided
  WedgePoint source_;
  std::array<WedgeObserver, 2> observers_;  // of the far edge's faces: that of the strip, the other one
  std::vector<Passing> path_;
};

}  // namespace raytube
