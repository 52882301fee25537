// Files of other kinds that are given as a case.
#pragma once

#include <filesystem>
#include <string_view>

namespace raytube {

/// Throws InputError if the name of the file says that it is a mesh.
void refuse_mesh_as_case(const std::filesystem::path& file);

/// Throws InputError if text that is no TOML is a mesh, or bytes that are no text.
void refuse_other_kinds(const std::filesystem::path& file, std::string_view bytes);

}  // namespace raytube
