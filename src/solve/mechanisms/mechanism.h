// The contract of mechanisms for running: what every piece of physics that adds to S beside the tubes answers in a look. First
// what it may add, and whether its budget reaches far enough; then its sum at all frequencies. How each is told of is in
// plan/mechanism.h, and all of them are in list.cpp.
#pragma once

#include <vector>

#include "plan/mechanism.h"
#include "sbr/beams/tube_sums.h"
#include "scene/contribution.h"
#include "scene/image.h"
#include "scene/surface_rays.h"
#include "scene/sweep.h"
#include "utd/surface/surface_arrival.h"

namespace raytube {

/// A look whose tubes are done.
struct TracedLook {
  const Look& look;
  const TubeSums& tubes;  // done; at all frequencies of the band
};

/// Least share of the squares expected of a mechanism that its budget must reach for it to begin: a part of a sum whose terms are
/// out of phase is no better than none.
inline constexpr double least_reach = 0.5;

/// What is known of a mechanism in a look before it begins.
struct Prospect {
  std::vector<double> amplitude{};  // [frequency] what it may add to |S_pp|, an estimate [m]; empty: it runs in any case
  double tolerances = 1.0;          // tolerances of a row that this must reach for the mechanism to run
  double reach = 1.0;               // share of the squares expected of it that its budget allows
};

/// Where the pieces of an image go.
struct ImageRequest {
  std::size_t frequency_index;  // among those of the look
  const ImageLattice& lattice;  // in recentred coordinates
  bool by_path = false;         // pieces stand where their paths have their place (scene/scattering_piece.h); of one frequency
  std::vector<ImageEdge> pieces{};
  std::vector<std::size_t> mechanisms{};  // of the pieces, in the order of the plan
};

/// What mechanisms leave to those behind them, and where pieces of an image go.
struct LookSink {
  std::vector<SurfaceArrival> arrivals{};  // waves over curved surfaces at wedges, which edge currents carry on
  std::vector<bool> waves_run{};           // [frequency] at which these run; empty: at none
  ImageRequest* image = nullptr;           // null: none is asked for
};

/// One mechanism at the frequencies of one band. Thread-safe.
class Mechanism {
 public:
  virtual ~Mechanism() = default;

  /// Cheap beside the tubes; not asked for if it follows another mechanism.
  virtual Prospect prospect(const TracedLook&) const { return {}; }

  /// What it adds at the frequencies that are `wanted`; it may clear further flags of `ran`, which are these. Where an
  /// image is asked for it adds its pieces there, and S need not be told.
  virtual Contribution solve(const TracedLook& look, const std::vector<bool>& wanted, LookSink& sink) const = 0;

  /// Appends its rays over curved surfaces, for pictures; `arrivals` as of LookSink.
  virtual void trace(const Look&, std::vector<SurfaceArrival>& /*arrivals*/, std::vector<SurfaceRay>& /*rays*/) const {}
};

}  // namespace raytube
