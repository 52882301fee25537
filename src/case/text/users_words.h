// What users of other programs call things, and what raytube has for them.
#pragma once

#include <string>
#include <string_view>

namespace raytube {

/// For the dotted name of an unknown key, a remedy that says what raytube has in its place: "look.phi_deg is the azimuth ...".
/// Empty if it is no word known here.
std::string_view remedy_for_word(std::string_view key);

/// Theta of an elevation [deg], without the binary dust of the subtraction.
double theta_of_elevation(double elevation_deg);

/// The sentence about an elevation outside -90...90 degrees.
std::string elevation_outside(std::string_view name, double elevation_deg);

/// The sentence about a theta outside 0...180 degrees; `name` is how it calls the angle.
std::string theta_outside(std::string_view name, double theta_deg);

}  // namespace raytube
