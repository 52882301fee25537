// Words of a case file for the solver's own choices, in the order of their enumerations.
#pragma once

#include <array>
#include <string_view>

#include "scene/options.h"

namespace raytube {

constexpr std::array<std::string_view, 2> words_of(TubeMode) { return {"uniform", "adaptive"}; }
constexpr std::array<std::string_view, 3> words_of(CurvedSurfaces) { return {"never", "convex", "always"}; }
constexpr std::array<std::string_view, 3> words_of(EdgeMethod) { return {"none", "fringe", "utd"}; }
constexpr std::array<std::string_view, 2> words_of(MaterialEdgeMethod) { return {"none", "fringe"}; }

template <class Choice>
constexpr std::string_view word_of(Choice choice) {
  return words_of(choice)[static_cast<std::size_t>(choice)];
}

}  // namespace raytube
