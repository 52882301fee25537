#include <fmt/format.h>

#include "mesh/model/triangle_mesh.h"

namespace raytube {

std::vector<MeshNote> MeshReport::notes() const {
  const std::string together = fmt::format("vertices welded to another one (closer than {:.2g} m)", weld_distance);
  std::vector<MeshNote> notes = {
      {"facets left out: fewer than three different corners", facets_unusable},
      {"curves and surfaces of free form left out: only polygons are read; export the mesh as polygons", free_forms_read},
      {together, vertices_welded},
      {"open edges in the file, once vertices are welded", open_edges_read},
      {"edges in the file where more than two facets meet", non_manifold_edges_read},
      {"edges in the file whose two facets are wound against each other", badly_wound_edges_read},
      {"edges split at a vertex that lies on them (T-junctions, flat facets)", t_junctions_split},
      {"facets added by these splits", triangles_added},
      {"facets left out: no area", triangles_degenerate},
      {"facets left out: another one has the same corners", triangles_duplicate},
      {"of these, made of another material than the one that stays: leave one of them out of the file",
       duplicates_of_other_material},
      {"facets left out: wall inside, where two closed bodies touch", triangles_internal},
      {"facets turned over, so that all face outward or alike", triangles_flipped},
      {"open edges left: the border of an open surface, or a gap in a body", open_edges},
      {"edges left where more than two facets meet", non_manifold_edges},
      {"parts that are closed except for a small gap, so traced on both sides", components_nearly_closed},
      {"parts that are closed, but partly of sheets: seen from both sides", components_penetrable},
      {"open parts, traced on both sides", components - components_closed - components_penetrable},
  };
  std::erase_if(notes, [](const MeshNote& note) { return note.count == 0; });
  return notes;
}

}  // namespace raytube
