#include "output/words/warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "core/text.h"

namespace raytube {

namespace {

constexpr std::array<const char*, 4> names = {"phi", "theta", "receiver phi", "receiver theta"};

// Rounded to two digits, never above the value.
double rounded_down(double value) {
  const double digit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::floor(value / digit * (1.0 + 1e-9)) * digit;
}

std::string at_wavelength(const Validity& v) {
  return fmt::format("a wavelength at {:.4g} GHz ({:.3g} mm)", v.frequency / 1e9, wavelength(v.frequency) * 1e3);
}

std::string percent(const SmallFeatures& features) { return fmt::format("{:.2g} %", 100.0 * features.share); }

// Rounded to a thousandth of `size`.
std::string place(const dvec3& point, double size, const MeshUnit& unit) {
  const double step = std::pow(10.0, std::floor(std::log10(size / unit.metres)) - 3.0);
  const dvec3 p = glm::round(point / unit.metres / step) * step + 0.0;
  return fmt::format("({:.7g}, {:.7g}, {:.7g}) {}", p.x, p.y, p.z, unit.name);
}

std::string hole_text(const OpenBodies& bodies, const MeshUnit& unit) {
  const Hole& hole = bodies.largest;
  const double square = unit.metres * unit.metres;
  return fmt::format("{:.6g} {}^2 beside {:.6g} {}^2 of surface, with a border of {:.4g} {} round {}", hole.area / square,
                     unit.name, bodies.area / square, unit.name, hole.border / unit.metres, unit.name,
                     place(hole.middle, hole.border, unit));
}

std::string bodies_text(const OpenBodies& bodies, const MeshUnit& unit) {
  const double percent = 100.0 * bodies.share;
  const std::string hole = hole_text(bodies, unit);
  if (bodies.holes == 1)
    return fmt::format("component {}, {:.3g} % of the surface, is closed except for a hole: {}", bodies.component, percent, hole);
  const std::string which = bodies.count == 1
                                ? fmt::format("component {}, {:.3g} % of the surface, is", bodies.component, percent)
                                : fmt::format("{} components, {:.3g} % of the surface, are", bodies.count, percent);
  const std::string where = bodies.count == 1 ? "" : fmt::format(", in component {},", bodies.component);
  return fmt::format("{} closed except for {} holes; the largest{} is {}", which, bodies.holes, where, hole);
}

std::string sentence(const ThickLayers& narrowest, std::size_t components, const Material& material, const MeshUnit& unit) {
  const auto length = [&](double metres) { return fmt::format("{:.4g} {}", metres / unit.metres, unit.name); };
  const std::string more = components == 1 ? "" : fmt::format(" ({} components are too narrow)", components);
  return fmt::format(
      "materials: the layers of \"{}\" are {} thick{}, but component {} round {} is only {} {}{}; check "
      "thickness_mm and target.unit, or treat the return of such parts as approximate: layers count as parts of infinite planes",
      quotable(material.name), length(narrowest.thickness), narrowest.both_sides ? " on both sides" : "", narrowest.component,
      place(narrowest.middle, narrowest.thickness, unit), length(narrowest.width), narrowest.closed ? "thick" : "wide", more);
}

// The depth along the line of sight that steps of so many GHz show without ambiguity [m].
double unambiguous_range(double gigahertz) { return speed_of_light / (2e9 * gigahertz); }

std::string sentence(const CoarseSteps& steps) {
  if (steps.quantity == RowCoordinates::frequency)
    return fmt::format(
        "sampling: steps of {:.4g} GHz in frequency are too wide for a range profile: it repeats after {:.3g} m, and the target "
        "is {:.3g} m deep; take steps of {:.2g} GHz or less, or read each row by itself (rcs.png shows points, not "
        "lines)",
        steps.step, unambiguous_range(steps.step), unambiguous_range(steps.limit), rounded_down(steps.limit));
  return fmt::format(
      "sampling: steps of {:.4g} deg in {} are too wide for this target's lobes, which require {:.2g} deg or less; take finer "
      "steps, or read each row by itself (rcs.png shows points, not lines)",
      steps.step, names[steps.quantity], rounded_down(steps.limit));
}

}  // namespace

std::vector<std::string> open_body_warnings(const OpenBodies& bodies, const MeshUnit& unit) {
  if (bodies.count == 0 || bodies.share < least_share) return {};
  return {
      fmt::format("open bodies: {}; rays enter there, and the inside reflects as the outside does; add the missing facets in the "
                  "CAD program, "
                  "unless the opening is intended, like that of a duct",
                  bodies_text(bodies, unit))};
}

std::vector<std::string> thick_layer_warnings(const std::vector<ThickLayers>& layers, std::span<const Material> materials,
                                              const MeshUnit& unit) {
  std::vector<std::string> sentences;
  for (std::uint32_t m = 0; m < materials.size(); ++m) {
    const auto of_material = [&](const ThickLayers& thick) { return thick.material == m; };
    std::vector<ThickLayers> found;
    std::ranges::copy_if(layers, std::back_inserter(found), of_material);
    if (found.empty()) continue;
    const ThickLayers& narrowest = *std::ranges::min_element(found, {}, &ThickLayers::width);
    sentences.push_back(sentence(narrowest, found.size(), materials[m], unit));
  }
  return sentences;
}

std::vector<std::string> validity_warnings(const Validity& v, const MeshUnit& unit) {
  const std::string size = fmt::format("{:.4g} {}, is {:.2g} wavelengths at {:.4g} GHz", too_small(v) ? v.extent * 1e3 : v.extent,
                                       too_small(v) ? "mm" : "m", v.extent / wavelength(v.frequency), v.frequency / 1e9);
  const std::string check = plausible(v) ? "" : fmt::format("check target.unit, which is \"{}\"", unit.name);
  if (too_small(v))
    return {fmt::format(
        "validity: the target's largest extent, {}, and the methods require {:.0f}; {}below {:.4g} GHz treat "
        "results as approximate, or use a full-wave program",
        size, least_wavelengths, check.empty() ? "" : check + "; ", least_wavelengths * speed_of_light / v.extent / 1e9)};
  std::vector<std::string> sentences;
  if (!check.empty())
    sentences.push_back(
        fmt::format("size: the target's largest extent, {}, and few radar targets are this large; {}", size, check));
  if (matters(v.parts))
    sentences.push_back(
        fmt::format("validity: {} separate parts, {} of the surface, are smaller than {}; treat their return as approximate, or "
                    "raise the frequency",
                    v.parts.count, percent(v.parts), at_wavelength(v)));
  if (matters(v.faces))
    sentences.push_back(fmt::format(
        "validity: {} faces between edges, {} of the surface, are smaller than {}; treat their return as approximate, or, "
        "where they stand for a curved surface, mesh it finer, with creases below edges.min_wedge_deg",
        v.faces.count, percent(v.faces), at_wavelength(v)));
  if (matters(v.radii))
    sentences.push_back(
        fmt::format("validity: {} of the surface is bent to radii smaller than {}; waves around such bends are approximate where "
                    "surfaces.waves "
                    "computes them, and missing elsewhere; treat the return from there as approximate, or raise the frequency",
                    percent(v.radii), at_wavelength(v)));
  return sentences;
}

std::vector<std::string> sampling_warnings(const std::vector<CoarseSteps>& steps) {
  std::vector<std::string> sentences;
  for (const CoarseSteps& coarse : steps) sentences.push_back(sentence(coarse));
  return sentences;
}

}  // namespace raytube
