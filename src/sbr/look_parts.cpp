#include "sbr/look_parts.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <functional>
#include <memory>

#include "core/threads.h"
#include "sbr/beams/spherical_look.h"
#include "sbr/curved/curved_cells.h"
#include "sbr/curved/curved_tubes.h"
#include "sbr/flat/polygon_tubes.h"
#include "sbr/flat/tile_tracer.h"

namespace raytube {

namespace {

// Bounds memory however large the grid is. Fewer tiles where their sums are large, with many frequencies, but enough for a few
// threads.
constexpr std::size_t most_tiles_per_batch = 128, least_tiles_per_batch = 8;
constexpr double bytes_per_batch = 64e6;

// Between sheets tubes double at every meeting, so that those of few faces are many.
constexpr std::uint32_t faces_per_tile_with_sheets = 8;

// So many cells a flat face is worth: it takes longer than they do, but less long than those that come as close.
constexpr double cells_per_face = 5.0;

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
  return tiles_of_range(static_cast<std::uint32_t>(look.faces.faces().size()),
                        look.sheets ? faces_per_tile_with_sheets : faces_per_tile,
                        [&look](std::uint32_t begin, std::uint32_t end) { return trace_faces(look, begin, end); });
}

// Half the faces of a body look at the radar. Where a face is dearer than the cells it covers, single rays are the cheaper
// sample.
bool cells_are_cheaper(const TubeLook& look) {
  const auto is_flat = [&](const Face& face) { return !look.smooth || look.smooth->region(face.triangle) == no_index; };
  const auto flat = std::ranges::count_if(look.faces.faces(), is_flat);
  const double per_face = look.clip ? cells_per_face : 1.0;
  return flat > faces_per_tile && 0.5 * per_face * static_cast<double>(flat) > static_cast<double>(look.grid.cells());
}

TubeSums light_curved_facets(const TubeLook& look, std::uint32_t begin, std::uint32_t end) {
  TubeSums sums;
  sums.at(0, look.wavenumbers().size());
  for (std::uint32_t t = begin; t < end; ++t) {
    if (look.smooth->region(t) == no_index) continue;
    if (look.spherical->add(sums, look.smooth->facet(t))) ++sums.hits[0];
  }
  sums.tubes = sums.hits[0];
  return sums;
}

// No tubes: facet by facet.
Tiles near_facet_tiles(const TubeLook& look) {
  return tiles_of_range(static_cast<std::uint32_t>(look.tracer.mesh().triangles.size()), faces_per_tile,
                        [&look](std::uint32_t begin, std::uint32_t end) { return light_curved_facets(look, begin, end); });
}

Tiles tiles_of(PartKind kind, const TubeLook& look) {
  switch (kind) {
    case PartKind::uniform:
      return uniform_tiles(look);
    case PartKind::flat:
      return cells_are_cheaper(look) ? uniform_tiles(look) : polygon_tiles(look);
    case PartKind::curved: {
      const auto curved = std::make_shared<const CurvedLook>(look);
      return {CurvedLook::blocks, [curved](std::size_t i) { return curved->trace(i); }};
    }
    case PartKind::curved_near:
      return near_facet_tiles(look);
    case PartKind::curved_bounces:
      break;
  }
  const CurvedBounces bounces(look);
  return {bounces.blocks(), [bounces](std::size_t i) { return bounces.trace(i); }};
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

TubeSums trace_part(PartKind kind, const TubeLook& look, Progress& progress, double share) {
  const Tiles tiles = tiles_of(kind, look);
  if (tiles.count == 0) progress.add(share);
  TubeSums sums;
  const std::size_t together = tiles_per_batch(look.convexity.no_reflection ? 1 : look.max_bounces, look.wavenumbers().size());
  for (std::size_t first = 0; first < tiles.count; first += together) {
    std::vector<TubeSums> batch(std::min(together, tiles.count - first));
    const auto trace = [&](std::size_t i) {
      batch[i] = tiles.trace(first + i);
      progress.add(share / static_cast<double>(tiles.count));
    };
    if (look.map)
      for (std::size_t i = 0; i < batch.size(); ++i) trace(i);
    else
      tbb::parallel_for(std::size_t{0}, batch.size(), trace);
    stop_if_cancelled();
    for (const TubeSums& sum : batch) sums.add(sum);
  }
  return sums;
}

}  // namespace raytube
