// Tubes of one cell of the launch grid each, followed by single rays, a tile at a time.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "sbr/beams/beam_tree.h"
#include "sbr/beams/far_fields.h"
#include "sbr/beams/tube_look.h"
#include "sbr/beams/tube_sums.h"
#include "sbr/launch/tile.h"
#include "sbr/visible/line_of_sight.h"

namespace raytube {

/// Traces tile after tile of one look; kept from one to the next is only memory. For one thread.
class TileTracer {
 public:
  /// Keeps a reference to the look. Where it has curved surfaces, tubes that meet one of these first are left to whoever traces
  /// such surfaces.
  explicit TileTracer(const TubeLook& look);
  TileTracer(const TileTracer&) = delete;

  /// Traces every tube of the tile through up to `max_bounces` reflections and integrates the currents of every bounce, over the
  /// cells and over those of a grid three times as coarse: a group of cells that the tile divides has the middle cell's ray, or
  /// its only one's. The tile begins at a column and a row divisible by three.
  TubeSums trace(const CellBlock& tile);

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

  void launch();
  void clear();
  void advance(int bounce);
  Ray reflected_ray(std::uint32_t column, std::uint32_t row, std::uint32_t beam, std::uint32_t patch) const;
  void reflect(int bounce);
  void send_on();
  void end_weakest();
  void truncate();
  void integrate(int bounce);
  void find_screened_tubes(int bounce);
  void find_runs(std::span<const Tube> tubes);
  void find_coarse_runs(std::span<const Tube> tubes, std::uint32_t grid);
  void extend(const Run& next);
  void integrate_runs(std::vector<ScatteringMatrix>& sums);
  void add_to_map(int bounce, const Tube& tube, std::uint32_t triangle);
  void add_incoherent();

  const TubeLook& look_;
  const LaunchGrid& grid_;
  BeamTree beams_;
  FarFields far_fields_;
  std::optional<RayLineOfSight> line_of_sight_;
  CellBlock tile_{};
  TubeSums sums_;
  std::vector<Tube> tubes_;     // all after the same number of bounces
  std::vector<Tube> screened_;  // their currents again, for every sheet between them and the receiver
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;  // of each ray, then of each tube
  std::vector<Run> runs_;
  std::array<std::vector<ScatteringMatrix>, coarse_grids> coarse_sums_;  // [grid][frequency] over all bounces so far
};

}  // namespace raytube
