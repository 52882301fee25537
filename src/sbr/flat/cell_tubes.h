// Tubes of one cell of the launch grid each, followed by single rays.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "sbr/beams/beam_tree.h"
#include "sbr/beams/far_fields.h"
#include "sbr/beams/tube_look.h"
#include "sbr/beams/tube_sums.h"
#include "sbr/launch/lattice.h"
#include "sbr/launch/tile.h"
#include "sbr/visible/line_of_sight.h"

namespace raytube {

/// Tubes under way, all after the same number of bounces. Beams and sums are their owner's.
class CellTubes {
 public:
  /// Keeps references to all it is given.
  CellTubes(const TubeLook& look, BeamTree& beams, TubeSums& sums);

  bool empty() const { return tubes_.empty(); }
  void clear() {
    tubes_.clear();
    rays_.clear();
  }

  /// Tubes as launched, of the cells [column_begin, column_end) of a row. Those that meet a curved surface of the look first are
  /// left to whoever traces such surfaces.
  void launch(std::uint32_t row, std::uint32_t column_begin, std::uint32_t column_end);
  /// A tube that travels in `beam`, just reflected by `patch`.
  void add(std::uint32_t column, std::uint32_t row, std::uint32_t beam, std::uint32_t patch);

  /// Sends every tube to the next surface and integrates the currents there as those of bounce `bounce`, counted from 0. Tubes
  /// that meet none end; all do if the next one would be bounce `max_bounces` of the look.
  void advance(int bounce);

  /// From here on the cells of `block` are also taken in the groups of the coarse grids. A group that the block divides has the
  /// middle cell's ray, or its only one's. Needs all tubes of the block, rows one after the other.
  void sample_coarse_grids(const CellBlock& block) {
    coarse_block_ = block;
    for (std::vector<ScatteringMatrix>& sums : coarse_sums_) sums.assign(frequencies_, {});
  }
  /// Sums over all bounces so far; [grid][frequency].
  const std::array<std::vector<ScatteringMatrix>, coarse_grids>& coarse_sums() const { return coarse_sums_; }

 private:
  struct Tube {
    std::uint32_t column, row, beam;
  };
  // Neighbouring cells of a row whose tubes share a footprint: together one wider tube, integrated in one closed form.
  struct Run {
    std::uint32_t node;
    CellBlock cells;
    dvec2 ray_at;  // launch coordinates of its first tube's ray
  };

  Ray reflected_ray(std::uint32_t column, std::uint32_t row, std::uint32_t beam, std::uint32_t patch) const;
  void reflect(int bounce);
  void send_on();
  void end_weakest();
  void truncate();
  void integrate(int bounce);
  void find_screened_tubes();
  void find_runs(std::span<const Tube> tubes);
  void find_coarse_runs(std::span<const Tube> tubes, std::uint32_t grid);
  void extend(const Run& next);
  void integrate_runs(std::vector<ScatteringMatrix>& sums);
  void add_to_map(const Tube& tube, std::uint32_t triangle);
  void add_incoherent();

  const Tracer& tracer_;
  const LaunchGrid& grid_;
  const SphericalLook* spherical_;
  const SmoothSurfaces* smooth_;
  CurrentMap* map_;
  int max_bounces_;
  std::size_t frequencies_;
  FarFields far_fields_;
  BeamTree& beams_;
  TubeSums& sums_;
  std::optional<RayLineOfSight> line_of_sight_;
  std::vector<Tube> tubes_;
  std::vector<Tube> screened_;  // their currents again, for every sheet between them and the receiver
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;  // of each ray, then of each tube
  std::vector<Run> runs_;
  CellBlock coarse_block_{};
  std::array<std::vector<ScatteringMatrix>, coarse_grids> coarse_sums_;
};

}  // namespace raytube
