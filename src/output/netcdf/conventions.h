// What a netCDF file says of itself, beside what the result brings along.
#pragma once

#include <array>
#include <cstddef>

namespace raytube {

struct FixedAttribute {
  const char *name, *text;
};

/// In words; the lines of rcs.csv, in the attribute `conventions`, have the formulas.
inline constexpr std::array<FixedAttribute, 5> convention_attributes = {
    {{"time_convention", "exp(+j omega t); a wave travels as exp(-j k r)"},
     {"phase_reference", "origin of the coordinates of the mesh"},
     {"amplitude_convention", "E_p(scattered) = S_pq E_q(incident) exp(-j k r) / r, p receive, q transmit; sigma = 4 pi |S|^2"},
     {"polarisation_convention",
      "v is theta-hat and h is phi-hat of each one's own direction, for transmitter and receiver alike"},
     {"direction_convention",
      "directions point from the target; theta from +z, phi from +x towards +y; theta_deg, phi_deg to the transmitter, rx_ to "
      "the "
      "receiver"}}};

inline constexpr const char* comment_attribute = "conventions";  // the comment lines of rcs.csv
inline constexpr const char* geometry_attribute = "geometry";    // monostatic or bistatic

/// HDF5 takes no attribute of 64 kB. A longer text is a variable of letters in its place, with a dimension of its own.
inline constexpr std::size_t longest_attribute = 60'000;
inline constexpr const char* letters_suffix = "_letters";

}  // namespace raytube
