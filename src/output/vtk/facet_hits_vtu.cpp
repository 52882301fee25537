#include "output/vtk/facet_hits_vtu.h"

#include "output/vtk/vtk_file.h"

namespace raytube {

void write_facet_hits_vtu(const std::filesystem::path& file, std::span<const dvec3> vertices,
                          std::span<const std::array<std::uint32_t, 3>> triangles, const FacetHits& hits) {
  write_surface_vtu(file, facet_hits_head, {vertices, triangles}, [&](OutputFile& out) {
    write_array(out, "Int64", "hits", hits.at_any_bounce(), std::identity{});
    for (std::size_t bounce = 0; bounce < hits.at_bounce.size(); ++bounce)
      write_array(out, "Int64", fmt::format("hits_{}", bounce + 1), hits.at_bounce[bounce], std::identity{});
  });
}

}  // namespace raytube
