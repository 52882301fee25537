// What a file holds, by its first bytes: for the sentence about a file that is not what its name says.
#pragma once

#include <string>
#include <string_view>

namespace raytube {

/// The ending under which a mesh of such contents is read: ".stl", ".obj", ".glb" and so on; empty if they look like none of
/// these.
std::string_view mesh_ending_of(std::string_view bytes);

/// What contents that are no mesh of these formats are, as a sentence goes on about them, with the remedy: "is a PNG image; ...".
/// Empty if nothing is known about them.
std::string other_contents(std::string_view bytes);

/// True for what gzip has written (RFC 1952, section 2.3.1).
bool is_gzip(std::string_view bytes);

}  // namespace raytube
