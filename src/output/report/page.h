// A report: one page of HTML with all that it needs inside, for any browser without a network.
//
//     page           the page from its data
//     sweep_json     rows of a result; imaging_json: profiles and images; scene_json: the target in space; words_json: sentences
//     shown_mesh, blocks, packed: data made small
//     assets/        page, style and scripts, which the build makes strings of (cmake/embed_assets.cmake)
#pragma once

#include <string>
#include <string_view>

#include "core/json.h"

namespace raytube {

/// The first line of a page.
inline constexpr std::string_view report_head = "<!DOCTYPE html><!-- report of raytube -->\n";

/// `three`: the library three.js; empty: no view in space.
std::string report_page(const JsonValue& data, std::string_view title, std::string_view three);

}  // namespace raytube
