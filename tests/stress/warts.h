// Meshes as CAD exports are: parts of a vehicle with the defects that their reports list, drawn from a seed.
#pragma once

#include <random>

#include "shapes.h"

namespace raytube::testing {

class Warts {
 public:
  explicit Warts(std::uint64_t seed) : generator_(seed) {}

  /// Some boxes, cylinders, plates and spheres in a space of side 1, a share of `defects` of their facets spoiled.
  PolygonSoup next(int parts, double defects) {
    soup_ = {};
    for (int part = 0; part < parts; ++part) add(this->part());
    const auto count = static_cast<int>(defects * static_cast<double>(soup_.polygons.size()));
    for (int i = 0; i < count; ++i) spoil();
    return std::move(soup_);
  }

 private:
  using Polygon = std::vector<std::uint32_t>;

  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(generator_); }
  std::size_t index(std::size_t count) { return static_cast<std::size_t>(generator_() % count); }
  dvec3 place() { return {number(-0.5, 0.5), number(-0.5, 0.5), number(-0.5, 0.5)}; }

  // Parts stand where they like: through one another, some on a grid so that their faces touch.
  PolygonSoup part() {
    const bool on_grid = generator_() % 2 == 0;
    const auto snapped = [&](double x) { return on_grid ? std::round(4 * x) / 4 : x; };
    const dvec3 at = place(), where(snapped(at.x), snapped(at.y), snapped(at.z));
    PolygonSoup shape;
    switch (generator_() % 4) {
      case 0:
        shape = shapes::box(on_grid ? dvec3(0.25, 0.25, 0.5) : dvec3(number(0.01, 0.5), number(0.01, 0.5), number(0.001, 0.5)));
        break;
      case 1:
        shape = shapes::cylinder(number(0.02, 0.2), number(0.02, 0.4), static_cast<std::uint32_t>(3 + index(30)));
        break;
      case 2:
        shape = shapes::plate(number(0.05, 0.5), number(0, 1));
        break;
      default:
        shape = shapes::icosphere(1, number(0.03, 0.2));
    }
    if (generator_() % 4 == 0)
      for (Polygon& polygon : shape.polygons) std::ranges::reverse(polygon);  // inside out
    return shapes::transformed(shape, glm::dmat3(1.0), 1.0, where);
  }

  void add(const PolygonSoup& shape) {
    const auto first = static_cast<std::uint32_t>(soup_.points.size());
    soup_.points.insert(soup_.points.end(), shape.points.begin(), shape.points.end());
    for (Polygon polygon : shape.polygons) {
      for (std::uint32_t& corner : polygon) corner += first;
      soup_.polygons.push_back(polygon);
    }
  }

  std::uint32_t add_point(const dvec3& point) {
    soup_.points.push_back(point);
    return static_cast<std::uint32_t>(soup_.points.size() - 1);
  }

  void spoil() {
    const std::size_t at = index(soup_.polygons.size());
    const Polygon polygon = soup_.polygons[at];
    if (polygon.size() < 3) return;
    const dvec3 a = soup_.points[polygon[0]], b = soup_.points[polygon[1]];
    switch (generator_() % 11) {
      case 0:  // twice
        soup_.polygons.push_back(polygon);
        break;
      case 1:  // twice, from both sides
        soup_.polygons.push_back({polygon.rbegin(), polygon.rend()});
        break;
      case 2:  // wound against its neighbours
        std::ranges::reverse(soup_.polygons[at]);
        break;
      case 3:  // missing
        soup_.polygons.erase(soup_.polygons.begin() + static_cast<std::ptrdiff_t>(at));
        break;
      case 4:  // a corner of its own, off the others by a gap above or below the weld distance
        soup_.polygons[at][0] = add_point(a + std::pow(10.0, number(-12.0, -3.0)) * place());
        break;
      case 5: {  // its neighbour's edge has a vertex that it has not
        const std::uint32_t middle = add_point(a + number(0.1, 0.9) * (b - a));
        soup_.polygons[at].insert(soup_.polygons[at].begin() + 1, middle);
        break;
      }
      case 6:  // no area: two corners in one place, or three on a line
        soup_.polygons.push_back({polygon[0], polygon[1], generator_() % 2 ? add_point(b) : add_point(0.5 * (a + b))});
        break;
      case 7:  // no polygon
        soup_.polygons.push_back({polygon[0], polygon[1]});
        break;
      case 8:  // a fin: more than two facets at an edge
        soup_.polygons.push_back({polygon[0], polygon[1], add_point(0.5 * (a + b) + 0.1 * place())});
        break;
      case 9:  // a wall inside
        soup_.polygons.push_back({polygon[0], polygon[1], polygon[2 % polygon.size()], add_point(a + 0.2 * place())});
        break;
      default:  // a vertex that nothing uses
        add_point(3.0 * place());
    }
  }

  std::mt19937_64 generator_;
  PolygonSoup soup_;
};

}  // namespace raytube::testing
