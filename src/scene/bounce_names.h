// Names of what S is made of: in files, on the command line and in Python. Mechanisms beside the tubes have theirs from the list
// of the solver (plan/mechanism.h).
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace raytube {

/// Pieces of the tubes' currents: where tubes arrive first, after one reflection, and after two or more. The pieces of
/// mechanisms are numbered behind these, in the order of the mechanisms.
inline constexpr std::array tube_pieces{"bounce_1", "bounce_2", "bounce_3_on"};

/// The name of one bounce, counted from 0.
inline std::string bounce_name(std::size_t bounce) { return "bounce_" + std::to_string(bounce + 1); }

}  // namespace raytube
