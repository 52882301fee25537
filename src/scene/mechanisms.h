// The mechanisms that S is made of, and their names: in files, on the command line and in Python.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace raytube {

/// What scatters. Bounces from the third on are one, and the orders of edges, too.
enum class ScatteringMechanism : std::uint8_t {
  first_bounce,   // physical optics where tubes arrive first
  second_bounce,  // where they arrive after one reflection
  later_bounces,  // and after two and more
  edges,          // fringe currents of all orders
  interaction,    // currents that edge-diffracted waves excite on other faces
  surface_waves   // over curved surfaces
};

/// All of them, by their names.
inline constexpr std::array scattering_mechanisms{"bounce_1", "bounce_2", "bounce_3_on", "edges", "interaction", "surface_waves"};

/// That of one.
constexpr const char* name_of(ScatteringMechanism mechanism) {
  return scattering_mechanisms[static_cast<std::size_t>(mechanism)];
}

/// That of one bounce, counted from 0.
inline std::string bounce_name(std::size_t bounce) { return "bounce_" + std::to_string(bounce + 1); }

/// The parts of S beside the physical optics of tubes, in the order in which they are added up.
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

/// The name of one part.
constexpr const char* name_of(Part part) {
  constexpr ByPart<const char*> names{{name_of(ScatteringMechanism::interaction), "edges_order_1", "edges_order_2_on",
                                       name_of(ScatteringMechanism::surface_waves)}};
  return names[part];
}

}  // namespace raytube
