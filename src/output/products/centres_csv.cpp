#include "output/products/centres_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <utility>

#include "core/decimal.h"
#include "output/files/files.h"
#include "output/products/amplitude_columns.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

constexpr int all_digits = 17;  // so that rows add up

// In a line.
std::string head(const CentreLook& look, const std::vector<std::string>& mechanisms, std::string title) {
  std::ranges::replace_if(
      title, [](char c) { return std::iscntrl(static_cast<unsigned char>(c)) != 0; }, ' ');
  std::string text = fmt::format(
      "# Scattering centres of the look theta {}, phi {} degrees at {} Hz, resolved to cubes of {:.6g} m. x_m, y_m, z_m: in the "
      "mesh's "
      "coordinates;\n# range_m beyond the origin. Amplitudes S_pq [m], phase reference the origin; with the last row, `rest`, "
      "they add up "
      "to S of the look.\n# share_...: of the power of the pieces within a cube, by mechanism. persistence_...: over which their "
      "sum is "
      "within 3 dB of its largest;\n# half of what a cube resolves at most.\n",
      number_text(decimal_degrees(look.direction.theta)), number_text(decimal_degrees(look.direction.phi)),
      number_text(look.frequency), look.side);
  if (!title.empty()) text += fmt::format("# title: {}\n", title);
  text += "centre,x_m,y_m,z_m,range_m" + amplitude_columns() + ",mechanism";
  for (const std::string& mechanism : mechanisms) text += fmt::format(",share_{}", mechanism);
  return text + ",persistence_ghz,persistence_azimuth_deg,persistence_elevation_deg,triangle,part\n";
}

// In quotes where it has a comma or quotes.
std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string centre_text(std::size_t number, const ScatteringCentre& centre, const std::string& mechanism, const CentreLook& look,
                        const PartOfTriangle& part_of) {
  std::string text = fmt::format("{},{:.9g},{:.9g},{:.9g},{:.9g}", number, centre.place.x, centre.place.y, centre.place.z,
                                 0.0 - glm::dot(centre.place, spherical_basis(look.direction).radial));
  text += amplitudes_text(centre.s, all_digits) + ',' + mechanism;
  for (const double share : centre.shares) text += fmt::format(",{:.4f}", share);
  text += fmt::format(",{:.5g},{:.4g},{:.4g}", centre.band * look.frequency * 1e-9, centre.azimuth / degree,
                      centre.elevation / degree);
  return text + (centre.triangle ? fmt::format(",{},{}\n", *centre.triangle, csv_cell(part_of(*centre.triangle))) : ",,\n");
}

double level(const ScatteringCentre& centre) { return sigma_dbsm(std::max(std::abs(centre.s.vv()), std::abs(centre.s.hh()))); }

// From blue to yellow, as levels in pictures.
std::array<int, 3> color_of(double share) {
  constexpr std::array<std::array<double, 3>, 3> colors = {{{68, 1, 84}, {33, 145, 140}, {253, 231, 37}}};
  const double at = 2.0 * std::clamp(share, 0.0, 1.0);
  const std::size_t first = at < 1.0 ? 0 : 1;
  std::array<int, 3> color{};
  for (std::size_t c = 0; c < 3; ++c)
    color[c] = static_cast<int>(
        std::lround(colors[first][c] + (at - static_cast<double>(first)) * (colors[first + 1][c] - colors[first][c])));
  return color;
}

}  // namespace

void write_centres_csv(const std::filesystem::path& file, const ScatteringCentres& found, const CentreLook& look,
                       const PartOfTriangle& part_of, const std::string& title) {
  OutputFile out(file);
  out.write(head(look, found.mechanisms, title));
  for (std::size_t i = 0; i < found.centres.size(); ++i)
    out.write(centre_text(i + 1, found.centres[i], found.mechanism_of(found.centres[i]), look, part_of));
  out.write("rest,,,," + amplitudes_text(found.rest, all_digits) + std::string(found.mechanisms.size() + 6, ',') + '\n');
  out.commit();
}

void write_by_part_csv(const std::filesystem::path& file, const std::vector<ScatteringPiece>& pieces,
                       const std::vector<std::string>& mechanisms, const CentreLook& look, const PartOfTriangle& part_of) {
  std::map<std::string, ScatteringMatrix> by_part, by_mechanism;
  ScatteringMatrix all;
  for (const ScatteringPiece& piece : pieces) {
    all += piece.s;
    if (piece.triangle)
      by_part[part_of(*piece.triangle)] += piece.s;
    else
      by_mechanism[mechanisms[piece.mechanism]] += piece.s;
  }
  std::vector<std::pair<std::string, ScatteringMatrix>> rows(by_part.begin(), by_part.end());
  std::ranges::stable_sort(rows, std::ranges::greater{}, [](const auto& row) { return frobenius_norm(row.second); });
  OutputFile out(file);
  out.write(fmt::format(
      "# S of the look theta {}, phi {} degrees at {} Hz by the parts of the mesh that currents are on, by the names in its "
      "file; edges, interaction and waves\n# over surfaces by mechanism. Amplitudes S_pq [m], phase reference the origin: "
      "they add up to the last row.\n",
      number_text(decimal_degrees(look.direction.theta)), number_text(decimal_degrees(look.direction.phi)),
      number_text(look.frequency)));
  out.write("part,mechanism" + amplitude_columns() + '\n');
  for (const auto& [part, s] : rows) out.write(csv_cell(part) + ",tubes" + amplitudes_text(s, all_digits) + '\n');
  for (const auto& [mechanism, s] : by_mechanism) out.write(',' + mechanism + amplitudes_text(s, all_digits) + '\n');
  out.write(",all" + amplitudes_text(all, all_digits) + '\n');
  out.commit();
}

void write_centres_ply(const std::filesystem::path& file, const ScatteringCentres& found) {
  constexpr double shown_range = 40.0;
  OutputFile out(file);
  out.write(fmt::format(
      "ply\nformat ascii 1.0\ncomment scattering centres of raytube\nelement vertex {}\nproperty double x\nproperty double "
      "y\nproperty double z\nproperty float sigma_dbsm\nproperty uchar red\nproperty uchar green\nproperty uchar "
      "blue\nend_header\n",
      found.centres.size()));
  for (const ScatteringCentre& centre : found.centres) {
    const auto [red, green, blue] = color_of(1.0 - (level(found.centres.front()) - level(centre)) / shown_range);
    out.write(fmt::format("{:.9g} {:.9g} {:.9g} {:.3f} {} {} {}\n", centre.place.x, centre.place.y, centre.place.z, level(centre),
                          red, green, blue));
  }
  out.commit();
}

}  // namespace raytube
