// The scattering centres of a look of a case.
#pragma once

#include <functional>

#include "case/data/case.h"
#include "imaging/centres.h"
#include "plan/target.h"

namespace raytube {

struct LookCentres {
  ScatteringCentres found;
  std::vector<ScatteringPiece> pieces;  // of the look
  ScatteringMatrix s;                   // their sum, S of the look [m]
  Direction direction;                  // towards the radar
  double frequency;                     // in the middle of the case's list [Hz]
  double side;                          // of the cubes that are resolved [m]
};

/// What is asked of them.
struct CentresAsked {
  std::size_t look = 0, count = 50;
  double resolution = 0.0;  // [m]; 0: that of the case's band, c / 2B; without one a sixtieth of the target, or two wavelengths
};

/// Pieces to a resolution cell of even weights: over a band their phase turns by a quarter of a turn and less.
inline constexpr double pieces_to_a_cell = 4.0;

/// Throws InputError, which names the case, for a look that is not there, and as scattering_pieces and scattering_centres do.
LookCentres centres_of_look(const Target& target, const Case& c, const CentresAsked& asked, int threads,
                            const std::function<bool(double)>& progress);

}  // namespace raytube
