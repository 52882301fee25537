// Watertight bodies that are hard on ray tracers: slivers, needles, parts through one another, faces upon faces.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/field.h"
#include "shapes.h"

namespace raytube::shapes {

/// A gear of so many teeth, flanks of `flank` radians.
inline PolygonSoup gear(int teeth, double flank) {
  std::vector<dvec2> outline;
  const double pitch = 2.0 * pi / teeth;
  for (int i = 0; i < teeth; ++i)
    for (const auto& [angle, radius] :
         {std::pair(0.0, 0.8), std::pair(flank, 1.0), std::pair(0.5 * pitch, 1.0), std::pair(0.5 * pitch + flank, 0.8)})
      outline.push_back(radius * dvec2(std::cos(i * pitch + angle), std::sin(i * pitch + angle)));
  return prism(outline, -0.15, 0.15);
}

/// A box whose sides are cut into strips, ever thinner: the last one is 2^-strips of the side.
inline PolygonSoup box_of_slivers(int strips) {
  std::vector<dvec2> outline{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
  double x = 1.0;
  for (int i = 0; i < strips; ++i) outline.emplace(outline.begin() + 1 + i, 0.5 - (x *= 0.5), -0.5);
  return prism(outline, -0.5, 0.5);
}

inline void add(PolygonSoup& all, const PolygonSoup& more, const dvec3& at) {
  all = joined(std::move(all), transformed(more, glm::dmat3(1.0), 1.0, at));
}

/// Boxes on a lattice: side by side, their faces in one plane or upon one another, or each a little way into the next.
inline PolygonSoup boxes(double distance) {
  PolygonSoup all;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 2; ++y)
      for (int z = 0; z < 2; ++z)
        if ((x + y + z) % 4 != 3) add(all, box({1.0, 1.0 + 0.1 * x, 1.0}), distance * dvec3(x, y, z));
  return all;
}

/// A body that runs back along itself: a block with a slit of the given width from the top almost to the bottom.
inline PolygonSoup slit_block(double width) {
  return prism({{-1, -1}, {1, -1}, {1, 1}, {0.5 * width, 1}, {0.1, -0.9}, {-0.5 * width, 1}, {-1, 1}}, -0.5, 0.5);
}

/// A cube of side 1 of which one face is a fan round a corner beside it: beyond its edge two triangles lie upon the back of a
/// third one, a flap without thickness.
inline PolygonSoup box_with_flap() {
  PolygonSoup soup = cube(1.0);
  soup.polygons.erase(soup.polygons.begin() + 2, soup.polygons.begin() + 4);  // the face z = 0.5: corners 4, 5, 7, 6
  soup.points.emplace_back(0.1, 0.8, 0.5);
  const std::vector<std::vector<std::uint32_t>> fan = {{7, 6, 8}, {4, 5, 8}, {5, 7, 8}, {6, 4, 8}};
  soup.polygons.insert(soup.polygons.begin(), fan.begin(), fan.end());
  return soup;
}

/// Turned, and with coordinates of so many digits behind the point, as text files have them: what was flat is no longer.
inline PolygonSoup written(PolygonSoup soup, double digits) {
  const double unit = std::pow(10.0, -digits);
  for (dvec3& p : soup.points) {
    p = {std::cos(0.3) * p.x - std::sin(0.3) * p.y, std::sin(0.3) * p.x + std::cos(0.3) * p.y, p.z};
    p = {p.x, std::cos(0.2) * p.y - std::sin(0.2) * p.z, std::sin(0.2) * p.y + std::cos(0.2) * p.z};
    p = unit * glm::round(p / unit);
  }
  return soup;
}

/// A grid of triangles over the unit square, as `at` places its points.
template <class Place>
PolygonSoup plating(int columns, int rows, Place at) {
  PolygonSoup soup;
  for (int i = 0; i <= columns; ++i)
    for (int j = 0; j <= rows; ++j) soup.points.push_back(at(double(i) / columns, double(j) / rows));
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      const auto a = static_cast<std::uint32_t>(i * (rows + 1) + j), b = a + static_cast<std::uint32_t>(rows) + 1;
      soup.polygons.push_back({a, b, b + 1});
      soup.polygons.push_back({a, b + 1, a + 1});
    }
  return soup;
}

/// The shell of a ship, 1 long: two sides that meet in the keel, a deck, a transom and a blunt stem with sharp edges all round.
inline PolygonSoup hull(int stations, int waterlines) {
  const auto side = [](double x, double t, double sign) {
    const double beam = 0.07 * (x < 0.6 ? 0.75 + 0.25 * std::min(1.0, x / 0.3) : 1.05 - std::pow((x - 0.6) / 0.4, 2));
    return dvec3(x, sign * beam * std::pow(t, 0.3 + 0.7 * std::abs(x - 0.45)), 0.1 * t);
  };
  const auto across = [&](double x, double z, double t) { return glm::mix(side(x, z, 1.0), side(x, z, -1.0), t); };
  PolygonSoup all = plating(stations, waterlines, [&](double x, double t) { return side(x, t, 1.0); });
  add(all, plating(stations, waterlines, [&](double x, double t) { return side(x, t, -1.0); }), {});
  add(all, plating(stations, waterlines / 4, [&](double x, double t) { return across(x, 1.0, t); }), {});
  for (const double end : {0.0, 1.0})
    add(all, plating(waterlines / 4, waterlines, [&](double t, double z) { return across(end, z, t); }), {});
  return all;
}

/// Boxes that stand on a plate and in one another.
inline PolygonSoup towers() {
  PolygonSoup all = box({1.6, 1.6, 0.05});
  for (int i = 0; i < 40; ++i) {
    const double width = 0.08 + 0.003 * (i * 7 % 20), height = 0.1 + 0.01 * (i * 11 % 30);
    add(all, box({width, 0.2 - width, height}), {-0.7 + 0.0371 * (i * 17 % 40), -0.7 + 0.0353 * i, 0.5 * height + 0.025});
  }
  return all;
}

inline std::vector<std::pair<std::string, PolygonSoup>> nasty_bodies() {
  std::vector<std::pair<std::string, PolygonSoup>> all = {
      {"gear of 24 teeth", gear(24, 0.01)},
      {"gear of 97 teeth with flanks of 1e-5", gear(97, 1e-5)},
      {"box of slivers", box_of_slivers(18)},
      {"disc of 2000 needles", prism(
                                   [] {
                                     std::vector<dvec2> circle;
                                     for (int i = 0; i < 2000; ++i)
                                       circle.emplace_back(std::cos(i * pi / 1000.0), std::sin(i * pi / 1000.0));
                                     return circle;
                                   }(),
                                   0.0, 1e-3)},
      {"boxes side by side", boxes(1.0)},
      {"boxes through one another", boxes(0.7)},
      {"boxes that reach 1e-6 into one another", boxes(1.0 - 1e-6)},
      {"boxes 1e-6 apart", boxes(1.0 + 1e-6)},
      {"block with a slit of 1e-3", slit_block(1e-3)},
      {"block with a slit of 1e-6", slit_block(1e-6)},
      {"box with a flap", box_with_flap()},
      {"block with a closed slit", slit_block(0.0)},
      {"block with a slit of 3e-8", slit_block(3e-8)}};
  PolygonSoup spheres, gears;
  for (int i = 0; i < 4; ++i) {
    add(spheres, icosphere(3), {0.6 * i, 0.1 * i, 0.0});
    add(gears, gear(16 + i, 0.003), {0.5 * i, 0.0, 0.1 * i});
  }
  all.emplace_back("spheres through one another", spheres);
  all.emplace_back("gears through one another", gears);
  return all;
}

/// Bodies whose patches are not quite flat.
inline std::vector<std::pair<std::string, PolygonSoup>> uneven_bodies() {
  return {{"hull", hull(80, 40)},
          {"hull of six digits", written(hull(80, 40), 6)},
          {"towers of six digits", written(towers(), 6)},
          {"towers of five digits", written(towers(), 5)}};
}

}  // namespace raytube::shapes
