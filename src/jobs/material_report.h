// What is told of the materials of a target.
#pragma once

#include <string>
#include <vector>

#include "case/data/case.h"
#include "solve/solve.h"

namespace raytube {

/// Lines of `check`: a heading, what each material covers, reflects and transmits, and what no facet uses. Empty if the case
/// defines none.
std::vector<std::string> material_lines(const Case& c, const Target& target);

/// How many pairs of facets of different materials lie upon one another in one plane, with an example and the remedy.
struct OverlapNote {
  std::uint64_t pairs = 0;
  std::string sentence;  // empty: there are none
};
OverlapNote overlap_note(const Case& c, const Target& target);

/// Facets that were left out though made of something else than the one in their place; empty: there are none.
std::string duplicates_sentence(const MeshReport& report);

}  // namespace raytube
