// Hits of tubes on the facets of the target, for ParaView.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string_view>

#include "scene/tube_paths.h"

namespace raytube {

/// The first line of such a file.
inline constexpr std::string_view facet_hits_head =
    "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\"><!-- facet hits of raytube -->\n";

/// A VTK unstructured grid (XML, .vtu) of the target's triangles. Cell data: hits at all bounces, hits_1, hits_2, ... at each.
/// Vertices in the mesh's own coordinates [m].
void write_facet_hits_vtu(const std::filesystem::path& file, std::span<const dvec3> vertices,
                          std::span<const std::array<std::uint32_t, 3>> triangles, const FacetHits& hits);

}  // namespace raytube
