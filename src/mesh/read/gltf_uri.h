// What a glTF file names as a buffer: data in the text itself, or a file beside it (RFC 2397, RFC 3986, RFC 4648).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace raytube {

/// The bytes that a `data:` address in base64 stands for; nothing if they are damaged or written in another way.
std::optional<std::string> data_of_uri(std::string_view uri);

/// The relative path that an address stands for, `%20` and the like decoded; nothing if it leads out of the folder or is no path.
std::optional<std::string> path_of_uri(std::string_view uri);

}  // namespace raytube
