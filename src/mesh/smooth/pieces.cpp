#include "mesh/smooth/pieces.h"

#include <algorithm>
#include <functional>

namespace raytube {

std::vector<SmoothPiece> smooth_pieces(const TriangleMesh& mesh, const SmoothSurfaces& surfaces) {
  std::vector<SmoothPiece> pieces(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (surfaces.region(t) == no_index) continue;
    SmoothPiece& piece = pieces[surfaces.region(t)];
    ++piece.facets;
    piece.rise = std::max(piece.rise, surfaces.rise(t));
  }
  std::erase_if(pieces, [](const SmoothPiece& piece) { return piece.facets == 0; });
  std::ranges::stable_sort(pieces, std::ranges::greater{}, &SmoothPiece::facets);
  return pieces;
}

}  // namespace raytube
