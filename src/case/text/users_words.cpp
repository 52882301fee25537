#include "case/text/users_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "core/decimal.h"
#include "core/text.h"

namespace raytube {

namespace {

struct Remedy {
  std::string_view words;  // between blanks
  std::string_view says;
};

constexpr std::array<Remedy, 15> remedies = {
    {{" clip ", "adaptive tubes always end exactly at edges; remove it, or write tubes.mode = \"uniform\""},
     {" azimuth azimuth_deg az az_deg aspect aspect_deg ", "write look.azimuth_deg (or look.phi_deg), from +x towards +y"},
     {" elevation elevation_deg el el_deg ", "write look.elevation_deg, or look.theta_deg = 90 - elevation, the angle from +z"},
     {" scale scaling scale_factor units mesh_unit mesh_scale ",
      "target.unit is the length of one mesh unit; write \"m\", \"cm\", \"mm\", \"um\", \"in\" or \"ft\" there"},
     {" polarization polarisation polarizations polarisations pol tx_pol rx_pol vv vh hv hh channel channels ",
      "all four channels, VV, VH, HV and HH, are always computed; remove it"},
     {" freq freq_ghz frequency_ghz f ", "write frequency.ghz"},
     {" hz khz mhz freq_hz freq_mhz frequency_hz frequency_mhz ", "frequencies are in gigahertz; write frequency.ghz"},
     {" wavelength wavelength_mm wavelength_m lambda ", "write frequency.ghz = 299.792458 / wavelength in mm"},
     {" start stop step count ", "a range is one value; write for example phi_deg = { start = 0, stop = 90, step = 1 }"},
     {" bounces max_reflections reflections num_bounces ", "write tubes.max_bounces"},
     {" rays num_rays ray_density rays_per_wavelength ", "write tubes.per_wavelength, tubes along one side of a wavelength"},
     {" bistatic monostatic ", "looks are monostatic, and bistatic with a [receive] section; write that or remove it"},
     {" threads cores ", "it is an option of the command line; write --threads N there"},
     {" folder directory out_dir output_dir ", "it is an option of the command line; write -o DIR there"},
     {" file filename mesh_file geometry stl obj model ", "write target.mesh"}}};

bool has_word(const Remedy& remedy, const std::string& word) {
  return remedy.words.find(" " + word + " ") != std::string_view::npos;
}

}  // namespace

// The key tells better than its section what was meant, so the parts are asked from the last on.
std::string_view remedy_for_word(std::string_view key) {
  for (std::size_t end = key.size(); end != std::string_view::npos && end > 0;) {
    const std::size_t dot = key.rfind('.', end - 1);
    const std::size_t begin = dot == std::string_view::npos ? 0 : dot + 1;
    const std::string word = lower_case(key.substr(begin, end - begin));
    const auto found = std::ranges::find_if(remedies, [&](const Remedy& remedy) { return has_word(remedy, word); });
    if (found != remedies.end()) return found->says;
    end = dot;
  }
  return {};
}

double theta_of_elevation(double elevation_deg) { return rounded_at_scale(90.0 - elevation_deg, 180.0) + 0.0; }

std::string elevation_outside(std::string_view name, double elevation_deg) {
  return fmt::format("{} must be from -90 to 90 degrees, from the plane z = 0 towards +z (found {})", name, elevation_deg);
}

std::string theta_outside(std::string_view name, double theta_deg) {
  const std::string sentence =
      fmt::format("{} must be from 0 to 180 degrees, from +z (found {}); theta is 90 - elevation", name, theta_deg);
  if (theta_deg > 0.0 || theta_deg < -90.0) return sentence;
  return fmt::format("{}: for an elevation of {} write {}, or elevation_deg", sentence, theta_deg, 90.0 - theta_deg);
}

}  // namespace raytube
