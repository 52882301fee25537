// The hash by which a file is known again.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace raytube {

/// SHA-256 of a file's bytes, in hexadecimal. Throws std::runtime_error if it cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

/// Of these bytes.
std::string sha256_of(std::string_view bytes);

}  // namespace raytube
