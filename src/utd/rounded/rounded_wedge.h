// A wedge whose edge is an arc: the field that it scatters beside the field of the sharp wedge.
//
// Notation in the files of this folder, beside that of utd/wedge/edge_currents.h:
//   alpha           angle of the metal, n = 2 - alpha / pi
//   rho, t          radius of the arc, tangent to both faces; distance of its ends from the virtual apex, rho / tan(alpha/2)
//   virtual apex    where the planes of the faces meet, in the air; all phases and distances are from there
//   nu, C           order m / n of a mode, and cos (hard, m >= 0) or sin (soft, m >= 1)
//   T               outgoing modes that the section makes of unit regular ones, m = 0 normalised
//
//   section_modes   T of any section, by a boundary integral         conic_section   sections of rims, arcs among them
//   rounded_wedge   S between fields along the edge                  rounded_edge    S per unit length of edge
//   nose_table      modes of the conics that rims take               rims            bends of curved bodies
#pragma once

#include <array>

#include "utd/rounded/section_modes.h"

namespace raytube {

/// Beyond the arc a plane wave finds the field of the sharp wedge and that of a line source in the virtual apex, a sum of few
/// modes without shadow boundaries (Sommerfeld's regular and outgoing modes of a wedge; T as in Waterman 1965, Proc. IEEE 53,
/// 805). Valid for faces that are plane for a wavelength or so beyond the section.
class RoundedWedge {
 public:
  /// alpha in (0, pi) [rad], and the modes of the section, with k sin(beta) for a wave that is not normal to the edge.
  RoundedWedge(double interior_angle, SoftHardModes modes);

  /// S per unit length of edge between fields along the edge, unit E (soft) or eta H (hard): S = P sqrt(k/2 pi) e^{j pi/4} of
  /// a two-dimensional field P e^{-jkr} / sqrt(r). Angles from a face through free space, in [0, n pi] [rad].
  Complex soft(double observation_angle, double source_angle) const {
    return strength(modes_.soft, false, observation_angle, source_angle);
  }
  Complex hard(double observation_angle, double source_angle) const {
    return strength(modes_.hard, true, observation_angle, source_angle);
  }

 private:
  Complex strength(const ModeMatrix& modes, bool hard, double observation_angle, double source_angle) const;

  double n_;
  SoftHardModes modes_;  // times what plane waves have of them, but for their angles
};

}  // namespace raytube
