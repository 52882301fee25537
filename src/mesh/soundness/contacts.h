// Bodies that touch or run through one another.
#pragma once

#include <functional>
#include <optional>

#include "mesh/model/face_tree.h"

namespace raytube {

/// Two triangles, of different bodies.
struct Contact {
  std::uint32_t first, second;  // `second` is a triangle of what was asked for
};

/// The first triangle that comes within rounding of one of another component for which `wanted(component)` holds; where they have
/// a corner in common, one that also goes on beyond it.
std::optional<Contact> find_contact(const FaceTree& faces, const std::function<bool(std::uint32_t)>& wanted);

}  // namespace raytube
