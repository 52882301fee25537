// The tubes of a look, then one mechanism after the other.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/progress.h"
#include "plan/plan.h"
#include "scene/image.h"
#include "scene/scattering_piece.h"
#include "scene/surface_rays.h"
#include "solve/look_result.h"
#include "solve/model_uncertainty.h"

namespace raytube {

/// Share of a look's progress in a band that the first pass of its tubes reports. The rest is told in equal steps: one
/// when the tubes are refined, one for each mechanism.
inline constexpr double first_tubes_share = 0.5;

/// The share of the progress of a look in a band that is left when a mechanism of the plan begins, by its index.
inline double share_left(const SolvePlan& plan, std::size_t mechanism) {
  const auto steps = static_cast<double>(plan.mechanisms.size() + 1),
             left = static_cast<double>(plan.mechanisms.size() - mechanism);
  return (1.0 - first_tubes_share) * left / steps;
}

/// What computes looks at the frequencies of one band.
class BandSolver;

/// Computes the looks of a plan. What all looks share is made once. Refers to the plan. Thread-safe.
class LookSolver {
 public:
  explicit LookSolver(const SolvePlan& plan);
  ~LookSolver();

  /// All mechanisms of look `index` of the sweep at every frequency, phase reference at the centre of the mesh (at a finite
  /// distance: the origin of its coordinates). Adds `share` to `progress` by and by.
  LookResult solve(std::size_t index, Progress& progress, double share) const;

  /// Fills an image of look `index` with what adds to it at one of the sweep's frequencies: tubes in cells and triangles, all
  /// others in pieces within a cell of the lattice each. Recentred coordinates, phase reference as of solve().
  void solve_image(std::size_t index, std::size_t frequency_index, const ImageLattice& lattice, Progress& progress,
                   LookImage& image) const;

  /// Everything that adds to S of look `index` of a plan with one frequency: currents in pieces within a cell of one lattice, all
  /// others in pieces within a cell of the other one. Recentred coordinates; `mirror`: of the plane across z in which the
  /// receiver is seen mirrored, if it is the mirror image of the transmitter: then currents alone have the places of their paths.
  void solve_pieces(std::size_t index, const ImageLattice& currents, const ImageLattice& edges, Progress& progress,
                    const PieceSink& sink, const std::optional<double>& mirror) const;

  /// How long all edges that may add to S are together, per frequency [m].
  std::vector<double> edge_lengths() const;

  const ModelUncertainty& model_uncertainty() const { return model_; }

  /// The rays over curved surfaces of a look at the first frequency of each band, in the mesh's own coordinates; none if no waves
  /// run over any. Their points are a tenth of the wavelength apart, or more.
  std::vector<SurfaceRay> surface_rays(const Look& look) const;

 private:
  const SolvePlan& plan_;
  ModelUncertainty model_;
  std::vector<std::unique_ptr<const BandSolver>> bands_;
};

}  // namespace raytube
