// Words of a case file for the solver's own choices.
#pragma once

#include <array>
#include <string_view>

#include "scene/options.h"

namespace raytube {

struct TransitionName {
  std::string_view name;
  TransitionTier tier;
};
inline constexpr std::array<TransitionName, 3> transition_names = {{{"exact", TransitionTier::exact},
                                                                    {"kouyoumjian-pathak", TransitionTier::kouyoumjian_pathak},
                                                                    {"as-printed", TransitionTier::as_printed}}};

constexpr std::string_view transition_name(TransitionTier tier) { return transition_names[static_cast<std::size_t>(tier)].name; }

struct EdgeMethodName {
  std::string_view name;
  EdgeMethod method;
};
inline constexpr std::array<EdgeMethodName, 3> edge_method_names = {
    {{"none", EdgeMethod::none}, {"fringe", EdgeMethod::fringe}, {"utd", EdgeMethod::utd}}};

constexpr std::string_view edge_method_name(EdgeMethod method) {
  return edge_method_names[static_cast<std::size_t>(method)].name;
}

struct MaterialEdgeName {
  std::string_view name;
  MaterialEdgeMethod method;
};
inline constexpr std::array<MaterialEdgeName, 2> material_edge_names = {
    {{"none", MaterialEdgeMethod::none}, {"fringe", MaterialEdgeMethod::fringe}}};

constexpr std::string_view material_edge_name(MaterialEdgeMethod method) {
  return material_edge_names[static_cast<std::size_t>(method)].name;
}

struct CurvedName {
  std::string_view name;
  CurvedSurfaces where;
};
inline constexpr std::array<CurvedName, 3> curved_names = {
    {{"never", CurvedSurfaces::never}, {"convex", CurvedSurfaces::convex}, {"always", CurvedSurfaces::always}}};

constexpr std::string_view curved_name(CurvedSurfaces where) { return curved_names[static_cast<std::size_t>(where)].name; }

}  // namespace raytube
