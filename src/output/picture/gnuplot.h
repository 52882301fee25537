// Pictures drawn by gnuplot. A picture is a convenience: when it cannot be drawn the run says so and goes on.
#pragma once

#include <filesystem>
#include <string>

namespace raytube {

/// Text that gnuplot takes literally, line breaks included.
std::string gnuplot_quoted(const std::string& text);

/// Draws `picture` (.png or .svg), which is not there yet, with these commands; they begin after terminal and output have been
/// set. `size` is "1100,640" in pixels. Returns an empty text, or why there is no picture.
std::string draw_picture(const std::filesystem::path& picture, const std::string& size, const std::string& commands);

}  // namespace raytube
