// raytube check --wedges: every wedge of a target as a table.
#pragma once

#include <filesystem>
#include <span>

#include "mesh/features/wedges.h"
#include "scene/sweep.h"

namespace raytube {

/// One row a wedge: its ends in the mesh's own coordinates [m], length, interior angle, n, the patches of its two faces, the
/// fraction of its length that the transmitter of the first look lights, and the thickness of the sheet whose edge it is [m], 0
/// for a sharp edge. Edges for which a half plane stands have no row. Written beside and renamed; throws
/// InputError where that cannot be.
void write_wedges_csv(const std::filesystem::path& file, const TriangleMesh& mesh, std::span<const Wedge> wedges,
                      const Sweep& sweep);

/// Throws InputError if there can be no list of that name.
void check_wedges_file(const std::filesystem::path& file);

}  // namespace raytube
