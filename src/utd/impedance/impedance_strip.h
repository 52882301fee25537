// What one edge sends over a face of impedance to another one. Notation in impedance_wedge.h.
//
// What an edge sends along a face is a spectrum of plane waves at the angles a from it, and each is diffracted by the far edge:
//   P2 = 1/(2 pi) INT P1(-a) P2(a) e^{-jk l sin^2(beta') cos a} da
// -a for an observer behind the face and a for a source in front of it, so that near grazing the wave counts half. At the far
// edge a is the a' of sin(a'/2) = cones sin(a/2), cones = sin(beta') of the first edge over that of the far one. The path is that
// of steepest descent, sin(a/2) = e^{j pi/4} tau / sqrt(2), cos a = 1 - j tau^2. As P(w) = r(w) P(-w), r = (sin w - sin theta) /
// (sin w + sin theta), half of it gives the rest, and the waves that the coat guides are known: P1 has its pole at a = theta of
// the first edge, P2 at a' = -theta of the far one. Those lie beside the path at any distance, and what a rule of few points
// makes of their poles is replaced by the integral in closed form. H along the edges only: E along them dies out along the face,
// and what the far edge makes of it was found to change nothing. (Clemmow 1966, The plane wave spectrum representation, ch. 3;
// Senior & Volakis 1995, ch. 3, 5.)
#pragma once

#include "utd/impedance/impedance_fringe.h"
#include "utd/multiple/wave_tree.h"

namespace raytube {

inline constexpr int strip_nodes = 18;

/// Digits of Maliuzhinets' function, as good as second order wants it.
inline constexpr double strip_digits = 14.0;

/// One of the edges, and its face that the strip runs over.
struct StripEdge {
  const Wedge& wedge;
  int face;
  std::array<FaceIncidence, 2> incidence;  // for the far edge all but the angle of the source
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
  /// `electrical_length` k l is that of strips it is made for, within a factor of 2 or so.
  ImpedanceStrip(const StripEdge& from, const StripEdge& to, const LookVectors& look, double electrical_length,
                 int nodes = strip_nodes);

  StripEcho echo(const std::array<SurfaceImpedance, 2>& from, const std::array<SurfaceImpedance, 2>& to) const;

 private:
  /// One plane wave of the spectrum.
  struct Passing {
    Complex weight;
    Complex growth;                      // by k l
    std::array<WedgePoint, 2> leaving;   // as the strip's face sees it, and the other one
    std::array<Complex, 2> sent;         // values over the ratio of faces_at, by the first edge's faces
    std::array<Complex, 2> met;          // values over the ratio of faces_at, by the far edge's faces
    Complex at_edge;                     // half of the field there, times faces_at of the source
    MaliuzhinetsPoint at_own, at_other;  // there, as at a source
    Complex leaving_sine, arriving_sine, arriving_cosine;
  };
  struct Ends;
  void lay_path(int nodes);
  /// How a wave at a passes from edge to edge, each of which may be asked for it at another angle.
  Passing passing(Complex at, Complex leaving, Complex arriving, Complex weight) const;
  Complex arriving(Complex angle) const;
  Complex sent(const Ends& ends, const Passing& wave) const;
  ImpedanceKernels beyond(const Ends& ends, const Passing& wave) const;
  std::array<Complex, 2> received(const Ends& ends, const Passing& wave) const;
  void add(const Ends& ends, const Passing& wave, Complex weight, StripEcho& sum) const;
  Complex rule_error(Complex angle) const;
  void add_pole(const Ends& ends, Complex at, Complex leaving, Complex arriving, Complex residue, StripEcho& sum) const;
  void add_poles(const Ends& ends, StripEcho& sum) const;

  StripEdge from_, to_;
  const LookVectors& look_;
  double cones_;  // sines of the edges' cones, divided
  WedgePoint source_;
  std::array<WedgeObserver, 2> observers_;  // on the far edge's faces: that of the strip, the other one
  double off_cone_;
  Complex end_;  // sin(a/2) at the end of the path
  std::vector<Passing> path_;
  std::vector<std::array<Complex, 2>> points_;  // sin(a/2) and its step
};

}  // namespace raytube
