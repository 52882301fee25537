#include "jobs/material_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "case/materials/materials.h"
#include "core/decimal.h"
#include "core/text.h"
#include "mesh/features/overlaps.h"
#include "output/words/plural.h"

namespace raytube {

namespace {

constexpr const char* overlap_remedy =
    "write kind = \"coated\" for a layer on a conductor, or leave one of the two out of the mesh";

struct Share {
  std::uint64_t triangles = 0;
  double area = 0.0;  // [m^2]
};

// Of each material, and of perfect conductors behind them.
std::vector<Share> shares_of(std::size_t materials, const TriangleMesh& mesh) {
  std::vector<Share> shares(materials + 1);
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    Share& share = shares[std::min<std::size_t>(mesh.patch_of(i).material, materials)];
    ++share.triangles;
    share.area += 0.5 * mesh.twice_area(i);
  }
  return shares;
}

std::string share_text(std::string_view material, const Share& share) {
  return fmt::format("  {}: {}, {:.6g} m^2", quotable(material), count_text(share.triangles, "triangle"), share.area);
}

// The frequency of a sweep nearest to its middle.
std::size_t middle_frequency(const std::vector<double>& frequencies) {
  const auto [lowest, highest] = std::ranges::minmax(frequencies);
  const double middle = 0.5 * (lowest + highest);
  const auto nearest = std::ranges::min_element(frequencies, {}, [&](double f) { return std::abs(f - middle); });
  return static_cast<std::size_t>(nearest - frequencies.begin());
}

// What a case file calls them, in the order of MaterialKind.
constexpr std::array kinds{"pec", "absorber", "dielectric", "solid", "coated", "sheet", "sheet"};
static_assert(kinds.size() == static_cast<std::size_t>(MaterialKind::thin_sheet) + 1);

// To hundredths, without a sign before zero.
std::string level_text(const Complex& ratio) {
  return fmt::format("{:.2f} dB", std::round(2000.0 * std::log10(std::abs(ratio))) / 100.0 + 0.0);
}

// Both polarisations have the same levels at normal incidence.
std::string response_text(const Material& material, const Sweep& sweep, std::size_t frequency) {
  const double k = wavenumber(sweep.frequencies[frequency]);
  const SurfaceResponse front = response(material, frequency, k, 1.0, false);
  const std::string reflected = level_text(front.reflected.te);
  std::string text = fmt::format("{}{}, |R| {}", kinds[static_cast<std::size_t>(material.kind)],
                                 material.roughness > 0.0 ? ", rough" : "", reflected);
  if (!material.transmits()) return text;
  const std::string from_behind = level_text(response(material, frequency, k, 1.0, true).reflected.te);
  if (from_behind != reflected) text += fmt::format(" ({} from behind)", from_behind);
  return text + ", |T| " + level_text(front.transmitted.te);
}

// Of a half-space that bounds a body.
const char* note_on_inside(const Material& material, std::uint32_t index, const TriangleMesh& mesh) {
  if (material.kind != MaterialKind::half_space) return "";
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (mesh.closed(t) && mesh.patch_of(t).material == index) return "; no waves inside the body (kind \"solid\" has them)";
  return "";
}

// The middle of the smaller one of two triangles, in the mesh's own coordinates.
dvec3 point_of(const Overlaps& overlaps, const TriangleMesh& mesh) {
  const auto [first, second] = overlaps.example;
  const auto& [a, b, c] = mesh.triangles[mesh.twice_area(first) < mesh.twice_area(second) ? first : second];
  return (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3.0 + mesh.center;
}

std::string name_of(const std::vector<Material>& materials, std::uint32_t material) {
  return material < materials.size() ? quotable(materials[material].name) : "pec";
}

}  // namespace

std::vector<std::string> material_lines(const Case& c, const Target& target) {
  const std::vector<Material>& materials = c.sweep.materials;
  const std::vector<std::string> unused = unused_materials(c);
  if (materials.empty() && unused.empty()) return {};
  const std::vector<Share> shares = shares_of(materials.size(), target.mesh);
  const std::size_t frequency = middle_frequency(c.sweep.frequencies);
  std::vector<std::string> lines{"materials"};
  if (!materials.empty())
    lines[0] += fmt::format(", at normal incidence and {} GHz", number_text(c.sweep.frequencies[frequency] / 1e9));
  for (std::size_t i = 0; i < materials.size(); ++i)
    lines.push_back(fmt::format("{}; {}{}", share_text(materials[i].name, shares[i]),
                                response_text(materials[i], c.sweep, frequency),
                                note_on_inside(materials[i], static_cast<std::uint32_t>(i), target.mesh)));
  lines.push_back(share_text("perfect conductor", shares.back()));
  if (!unused.empty()) lines.push_back(fmt::format("  defined, but not used in [target]: {}", quotable(joined(unused, ", "))));
  if (const OverlapNote note = overlap_note(c, target); note.pairs > 0) lines.push_back("  " + note.sentence);
  return lines;
}

OverlapNote overlap_note(const Case& c, const Target& target) {
  if (c.sweep.materials.empty()) return {};
  const Overlaps overlaps = overlaps_of_materials(target.tracer);
  if (overlaps.pairs == 0) return {};
  const dvec3 point = point_of(overlaps, target.mesh);
  const auto name = [&](int i) { return name_of(c.sweep.materials, target.mesh.patch_of(overlaps.example[i]).material); };
  return {overlaps.pairs,
          fmt::format("{} pairs of facets of different materials lie upon one another in one plane, for example \"{}\" and "
                      "\"{}\" near ({:.6g}, {:.6g}, {:.6g}) m: only one of the two is seen, by their order in the file and by "
                      "rounding; {}",
                      overlaps.pairs, name(0), name(1), point.x, point.y, point.z, overlap_remedy)};
}

std::string duplicates_sentence(const MeshReport& report) {
  if (report.duplicates_of_other_material == 0) return "";
  return fmt::format("{} facets are ignored: earlier ones with the same corners are made of another material; {}",
                     report.duplicates_of_other_material, overlap_remedy);
}

}  // namespace raytube
