#include "sbr/look_parts.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <functional>
#include <memory>

#include "core/threads.h"
#include "sbr/curved/curved_cells.h"
#include "sbr/curved/curved_tubes.h"
#include "sbr/curved/near_facets.h"
#include "sbr/flat/polygon_tubes.h"
#include "sbr/flat/tile_tracer.h"
#include "sbr/solid/solid_tubes.h"
#include "scene/frequency_bands.h"

namespace raytube {

namespace {

// Bounds memory however large the grid is. Fewer tiles where their sums are large, with many frequencies, but enough for a few
// threads.
constexpr std::size_t most_tiles_per_batch = 128, least_tiles_per_batch = 8;
constexpr double bytes_per_batch = 64e6;

// A flat face takes as long as so many cells. Cells of this density are estimated to leave this share of S (1.5 dB) on vehicles,
// and less in proportion to their width.
constexpr double cells_per_face = 20.0, cells_per_wavelength = 20.0, error_of_cells = 0.19;

// What the tiles of a part are: so many, each traced by itself.
struct Tiles {
  std::size_t count;
  std::function<TubeSums(std::size_t)> trace;
};

Tiles uniform_tiles(const TubeLook& look) {
  using Tracers = tbb::enumerable_thread_specific<TileTracer>;
  const auto tracers = std::make_shared<Tracers>([&look] { return TileTracer(look); });
  const Tiling tiling(look.grid);
  return {tiling.count(), [tracers, tiling](std::size_t i) { return tracers->local().trace(tiling[i]); }};
}

// Items [0, count), so many to a tile.
template <class Trace>
Tiles tiles_of_range(std::uint32_t count, std::uint32_t together, Trace trace) {
  return {(count + together - 1) / together, [=](std::size_t i) {
            const auto begin = static_cast<std::uint32_t>(i) * together;
            return trace(begin, std::min(begin + together, count));
          }};
}

Tiles polygon_tiles(const TubeLook& look) {
  using Visibilities = tbb::enumerable_thread_specific<BeamVisibility>;
  const auto visible = std::make_shared<Visibilities>([&look] { return BeamVisibility(look.faces, look.tracer); });
  return tiles_of_range(
      static_cast<std::uint32_t>(look.faces.faces().size()), look.sheets ? faces_per_tile_with_sheets : faces_per_tile,
      [&look, visible](std::uint32_t begin, std::uint32_t end) { return trace_faces(look, visible->local(), begin, end); });
}

// Cells of single rays where faces are dearer than cells that do as well.
bool cells_are_cheaper(const TubeLook& look) {
  const auto is_flat = [&](const Face& face) { return !look.smooth || look.smooth->region(face.triangle) == no_index; };
  const auto flat = static_cast<double>(std::ranges::count_if(look.faces.faces(), is_flat));
  if (flat <= faces_per_tile) return false;
  const double wavelength = 2.0 * pi / sampling_wavenumber(look.wavenumbers()),
               good_cell = wavelength / cells_per_wavelength * look.tolerance / error_of_cells;
  return cells_per_face * flat > static_cast<double>(look.grid.cells()) * look.grid.du * look.grid.dv / (good_cell * good_cell);
}

// No tubes: facet by facet.
Tiles near_facet_tiles(const TubeLook& look) {
  if (look.convexity.no_reflection)
    return tiles_of_range(static_cast<std::uint32_t>(look.tracer.mesh().triangles.size()), faces_per_tile,
                          [&look](std::uint32_t begin, std::uint32_t end) { return light_convex_facets(look, begin, end); });
  return tiles_of_range(static_cast<std::uint32_t>(look.faces.faces().size()), faces_per_tile,
                        [&look](std::uint32_t begin, std::uint32_t end) { return light_visible_facets(look, begin, end); });
}

Tiles tiles_of(PartKind kind, bool polygons, const TubeLook& look) {
  switch (kind) {
    case PartKind::uniform:
      return uniform_tiles(look);
    case PartKind::flat:
      return polygons ? polygon_tiles(look) : uniform_tiles(look);
    case PartKind::curved: {
      const auto curved = std::make_shared<const CurvedLook>(look);
      return {CurvedLook::blocks, [curved](std::size_t i) { return curved->trace(i); }};
    }
    case PartKind::curved_near:
      return near_facet_tiles(look);
    case PartKind::solid:
      return tiles_of_range(static_cast<std::uint32_t>(look.tracer.mesh().triangles.size()), triangles_per_solid_tile,
                            [&look](std::uint32_t begin, std::uint32_t end) { return trace_solids(look, begin, end); });
    case PartKind::curved_bounces:
      break;
  }
  const CurvedBounces bounces(look);
  return {bounces.blocks(), [bounces](std::size_t i) { return bounces.trace(i); }};
}

int bounces_of(const TubeLook& look) { return look.convexity.no_reflection ? 1 : look.max_bounces; }

// A tile, and to which of the chosen blocks' sums it belongs.
struct TileOfBlock {
  std::size_t tile, sum;
};

std::vector<TileOfBlock> tiles_of_blocks(std::size_t tiles, std::size_t blocks, std::span<const std::size_t> chosen) {
  std::vector<TileOfBlock> result;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    for (std::size_t tile = chosen[i] * tiles / blocks; tile < (chosen[i] + 1) * tiles / blocks; ++tile)
      result.push_back({tile, i});
  return result;
}

}  // namespace

double tile_sum_bytes(int bounces, std::size_t frequencies) {
  return static_cast<double>(frequencies) *
         (static_cast<double>(bounces) * sizeof(ScatteringMatrix) + coarse_grids * sizeof(ErrorSum));
}

std::size_t tiles_per_batch(int bounces, std::size_t frequencies) {
  const double most = bytes_per_batch / tile_sum_bytes(bounces, frequencies);
  return most > most_tiles_per_batch ? most_tiles_per_batch : std::max(least_tiles_per_batch, static_cast<std::size_t>(most));
}

Division divide(PartKind kind, const TubeLook& look) {
  if (kind != PartKind::flat || cells_are_cheaper(look)) return {};
  return {true, std::clamp<std::size_t>(polygon_tiles(look).count, 1, most_blocks)};
}

std::vector<TubeSums> trace_blocks(PartKind kind, const Division& division, const TubeLook& look,
                                   std::span<const std::size_t> blocks, Progress& progress, double share) {
  const Tiles tiles = tiles_of(kind, division.polygons, look);
  const std::vector<TileOfBlock> chosen = tiles_of_blocks(tiles.count, division.blocks, blocks);
  if (chosen.empty()) progress.add(share);
  std::vector<TubeSums> sums(blocks.size());
  const std::size_t together = tiles_per_batch(bounces_of(look), look.wavenumbers().size());
  for (std::size_t first = 0; first < chosen.size(); first += together) {
    std::vector<TubeSums> batch(std::min(together, chosen.size() - first));
    const auto trace = [&](std::size_t i) {
      batch[i] = tiles.trace(chosen[first + i].tile);
      progress.add(share / static_cast<double>(chosen.size()));
    };
    if (look.map)
      for (std::size_t i = 0; i < batch.size(); ++i) trace(i);
    else
      tbb::parallel_for(std::size_t{0}, batch.size(), trace);
    stop_if_cancelled();
    for (std::size_t i = 0; i < batch.size(); ++i) sums[chosen[first + i].sum].add(batch[i]);
  }
  return sums;
}

}  // namespace raytube
