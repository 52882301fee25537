// What adds to S beside the physical optics of tubes, part by part.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace raytube {

/// The parts of S beside physical optics, in the order in which they are added up.
enum class Part : std::uint8_t {
  interaction,   // currents that edge-diffracted waves excite on other faces
  edges_first,   // fringe currents of the lit wedges
  edges_higher,  // what these currents start at further wedges
  surface_waves  // over curved surfaces
};

/// All of them, in the order of their columns.
inline constexpr std::array all_parts{Part::edges_first, Part::edges_higher, Part::interaction, Part::surface_waves};

/// One value for each part.
template <class Value>
struct ByPart {
  std::array<Value, all_parts.size()> of{};  // [Part]

  /// That of one part.
  constexpr Value& operator[](Part part) { return of[static_cast<std::size_t>(part)]; }
  /// That of one part.
  constexpr const Value& operator[](Part part) const { return of[static_cast<std::size_t>(part)]; }
};

/// How its columns begin in files.
constexpr const char* column_of(Part part) {
  constexpr ByPart<const char*> names{{"between", "edges_first_order", "edges_second_order", "surface"}};
  return names[part];
}

}  // namespace raytube
