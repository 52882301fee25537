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

}  // namespace raytube::shapes
