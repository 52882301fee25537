#include "output/products/centres_netcdf.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "core/decimal.h"
#include "output/netcdf/new_netcdf.h"
#include "output/products/amplitude_variables.h"

namespace raytube {

namespace {

using Centres = std::vector<ScatteringCentre>;

void write_head(NewNetcdf& out, const StoredResult& result, const CentreLook& look) {
  out.describe(result);
  out.attribute("theta_deg", std::array{decimal_degrees(look.direction.theta)});
  out.attribute("phi_deg", std::array{decimal_degrees(look.direction.phi)});
  out.attribute("frequency_hz", std::array{look.frequency});
  out.attribute("resolution_m", std::array{look.side});
}

template <class Value>
void per_centre(NewNetcdf& out, const Centres& centres, const char* name, const char* units, const char* long_name, Value value) {
  std::vector<double> values;
  std::ranges::transform(centres, std::back_inserter(values), value);
  out.put(out.variable(name, {"centre"}, units, long_name), values);
}

void write_places(NewNetcdf& out, const Centres& centres, const CentreLook& look) {
  out.labels("xyz", {"x", "y", "z"}, "axis of the mesh's coordinates");
  std::vector<double> places;
  for (const ScatteringCentre& centre : centres) places.insert(places.end(), {centre.place.x, centre.place.y, centre.place.z});
  out.put(out.variable("place", {"centre", "xyz"}, "m", "place in the mesh's coordinates"), places);
  const dvec3 away = -spherical_basis(look.direction).radial;
  per_centre(out, centres, "range_m", "m", "range beyond the origin",
             [&away](const ScatteringCentre& c) { return glm::dot(c.place, away); });
}

void write_persistence(NewNetcdf& out, const Centres& centres, const CentreLook& look) {
  per_centre(out, centres, "persistence_hz", "Hz", "band within 3 dB of the largest",
             [&look](const ScatteringCentre& c) { return c.band * look.frequency; });
  per_centre(out, centres, "persistence_azimuth_deg", "degree", "azimuth within 3 dB of the largest",
             [](const ScatteringCentre& c) { return c.azimuth / degree; });
  per_centre(out, centres, "persistence_elevation_deg", "degree", "elevation within 3 dB of the largest",
             [](const ScatteringCentre& c) { return c.elevation / degree; });
}

void write_shares(NewNetcdf& out, const ScatteringCentres& found) {
  out.labels("mechanism", found.mechanisms, "mechanism");
  std::vector<double> shares;
  for (const ScatteringCentre& centre : found.centres) std::ranges::copy(centre.shares, std::back_inserter(shares));
  out.put(out.variable("share", {"centre", "mechanism"}, "1", "share of the power of the pieces within the cube"), shares);
}

void write_triangles(NewNetcdf& out, const Centres& centres, const PartOfTriangle& part_of) {
  constexpr double none = -1.0;
  per_centre(out, centres, "triangle", "1", "triangle of the mesh with the strongest current, from 0; -1: none",
             [](const ScatteringCentre& c) { return c.triangle ? static_cast<double>(*c.triangle) : none; });
  std::vector<std::string> parts;
  for (const ScatteringCentre& centre : centres) parts.push_back(centre.triangle ? part_of(*centre.triangle) : "");
  out.texts("part", "centre", parts, "part of the mesh that the triangle belongs to");
}

}  // namespace

void write_centres_netcdf(const std::filesystem::path& file, const StoredResult& result, const ScatteringCentres& found,
                          const CentreLook& look, const PartOfTriangle& part_of,
                          const std::vector<std::array<dvec3, 2>>& outline) {
  NewNetcdf out(file);
  write_head(out, result, look);
  out.dimension("centre", found.centres.size());
  out.polarisations();
  write_places(out, found.centres, look);
  std::vector<ScatteringMatrix> s;
  std::ranges::transform(found.centres, std::back_inserter(s), &ScatteringCentre::s);
  write_amplitudes(out, {"centre"}, "scattering centre", "range_m", s);
  for (const auto& [name, which] : {std::pair{"rest_re", ComplexPart::real}, std::pair{"rest_im", ComplexPart::imaginary}})
    out.put(out.variable(name, {"receive", "transmit"}, "m", "what the centres lack of S of the look"),
            components({found.rest}, which));
  write_shares(out, found);
  write_persistence(out, found.centres, look);
  write_triangles(out, found.centres, part_of);
  write_outline(out, outline);
  out.write();
}

}  // namespace raytube
