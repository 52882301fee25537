// raytube check --wedges: every wedge of a target as a table, or as lines.
#pragma once

#include <filesystem>
#include <span>

#include "mesh/features/wedges.h"
#include "scene/sweep.h"

namespace raytube {

/// Lines for ParaView where the name ends in .vtp, else a table. Lit: by the transmitter of the first look. Written beside and
/// renamed; throws InputError where that cannot be.
void write_wedge_list(const std::filesystem::path& file, const TriangleMesh& mesh, std::span<const Wedge> wedges,
                      const Sweep& sweep);

/// Throws InputError if there can be no list of that name.
void check_wedges_file(const std::filesystem::path& file);

}  // namespace raytube
