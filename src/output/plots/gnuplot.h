// Pictures through gnuplot. A picture is a convenience: its absence is told, it is not an error.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace raytube {

/// Text as gnuplot takes it literally.
std::string gnuplot_quoted(const std::string& text);

/// The same of several lines, one under the other.
std::string gnuplot_quoted_lines(const std::string& text);

/// The commands every script begins with: `terminal` is "pngcairo" or "svg", perhaps with options, `canvas` its
/// size "1100,640" in pixels.
std::string gnuplot_preamble(const std::string& terminal, const std::string& canvas, const std::string& file);

/// Draws a PNG, SVG or PDF where none is. Returns an empty text, or why there is no picture. Throws std::runtime_error if the
/// disk did not take all of it.
std::string draw_picture(const std::filesystem::path& picture, const std::string& commands);

/// Draws `name`.png and `name`.svg in `folder`, which holds neither; script(terminal, file) gives the commands that draw `file`.
/// Returns an empty text, or why there is no picture; throws as draw_picture does.
std::string draw_pictures(const std::filesystem::path& folder, const std::string& name,
                          const std::function<std::string(const std::string& terminal, const std::string& file)>& script);

}  // namespace raytube
