// Bodies a wavelength or a few in size, with details from a millionth to a tenth of one: drawn from a seed. The wavelength is 1
// m.
#pragma once

#include <random>

#include "shapes.h"

namespace raytube::testing {

struct FineBody {
  const char* kind;
  PolygonSoup soup;
};

class FineBodies {
 public:
  explicit FineBodies(std::uint64_t seed) : generator_(seed) {}

  FineBody next() {
    switch (generator_() % 8) {
      case 0:
        return {"thin rim", rim()};
      case 1:
        return {"stairs", stairs()};
      case 2:
        return {"fan of slivers", fan()};
      case 3:
        return {"nearly coplanar facets", rough_plate()};
      case 4:
        return {"self-touching rings", rings()};
      case 5:
        return {"torus", torus()};
      case 6:
        return {"comb", comb()};
      default:
        return {"short edges in a row", saw()};
    }
  }

  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(generator_); }
  /// The same corners, each moved by `distance` at most.
  PolygonSoup moved(PolygonSoup soup, double distance) {
    for (dvec3& p : soup.points) p += distance / std::sqrt(3.0) * dvec3(number(-1, 1), number(-1, 1), number(-1, 1));
    return soup;
  }

 private:
  using Corner = std::uint32_t;

  double size() { return number(0.5, 3.0); }
  double detail() { return std::pow(10.0, number(-6.0, -1.0)); }
  Corner count(Corner low, Corner high) { return low + static_cast<Corner>(generator_() % (high - low + 1)); }

  // A disc, open ring or knife whose border faces are a detail wide and lean any way.
  PolygonSoup rim() {
    const Corner sides = count(3, 20);
    const double radius = size() / 2, thickness = detail(), lean = number(-2.0, 2.0) * thickness;
    std::vector<dvec2> outline;
    for (Corner i = 0; i < sides; ++i)
      outline.push_back(radius * dvec2(std::cos(2 * pi * i / sides), std::sin(2 * pi * i / sides)));
    PolygonSoup soup = shapes::prism(outline, 0.0, thickness);
    for (Corner i = sides; i < 2 * sides; ++i) soup.points[i] *= dvec3(1 + lean / radius, 1 + lean / radius, 1.0);
    return soup;
  }

  // A block whose top rises in steps a detail high, over treads from a detail to the whole block wide.
  PolygonSoup stairs() {
    const Corner steps = count(1, 10);
    const double width = size(), rise = detail(), run = generator_() % 2 ? detail() : width / steps;
    std::vector<dvec2> outline{{0.0, -number(0.1, 1.0)}};
    outline.push_back({run * (steps + 1), outline[0].y});
    for (Corner i = steps; i > 0; --i) {
      outline.push_back({run * (i + 1), rise * i});
      outline.push_back({run * i, rise * i});
    }
    outline.push_back({run, 0.0});
    outline.push_back({0.0, 0.0});
    return shapes::prism(outline, 0.0, width);
  }

  // An open plate of slivers about a point of its border or its inside, their tips a detail apart.
  PolygonSoup fan() {
    const Corner slivers = count(3, 20);
    const double length = size(), step = generator_() % 2 ? detail() : length / slivers, height = detail();
    PolygonSoup soup{{{0, 0, 0}}, {}};
    for (Corner i = 0; i <= slivers; ++i) soup.points.emplace_back(length, step * (i - slivers / 2.0), i % 2 ? height : 0.0);
    for (Corner i = 0; i < slivers; ++i) soup.polygons.push_back({0, i + 1, i + 2});
    return soup;
  }

  // A plate in a grid of facets whose corners stand a detail out of its plane.
  PolygonSoup rough_plate() {
    const Corner cells = count(2, 5);
    const double side = size(), height = detail();
    PolygonSoup soup;
    for (Corner i = 0; i <= cells; ++i)
      for (Corner j = 0; j <= cells; ++j) soup.points.emplace_back(side * i / cells, side * j / cells, height * number(-1, 1));
    for (Corner i = 0; i < cells; ++i)
      for (Corner j = 0; j < cells; ++j) {
        const Corner a = i * (cells + 1) + j, b = a + cells + 1;
        soup.polygons.insert(soup.polygons.end(), {{a, b, b + 1}, {a, b + 1, a + 1}});
      }
    return soup;
  }

  // Two open rings, a detail high, of which one corner is the same.
  PolygonSoup rings() {
    const Corner sides = count(3, 10);
    const double radius = size() / 3, height = detail();
    PolygonSoup soup;
    for (const double at : {-radius, radius}) {
      const auto first = static_cast<Corner>(soup.points.size());
      for (Corner i = 0; i < sides; ++i)
        for (const double z : {0.0, height}) {
          const double angle = 2 * pi * i / sides + (at < 0 ? 0.0 : pi);
          soup.points.emplace_back(at + radius * std::cos(angle), radius * std::sin(angle), z);
        }
      for (Corner i = 0; i < sides; ++i) {
        const Corner a = first + 2 * i, b = first + 2 * ((i + 1) % sides);
        soup.polygons.insert(soup.polygons.end(), {{a, b, b + 1}, {a, b + 1, a + 1}});
      }
    }
    return soup;
  }

  // A torus, its tube as thin as a detail or not.
  PolygonSoup torus() {
    const Corner around = count(3, 12), across = count(3, 6);
    const double radius = size() / 2, tube = generator_() % 2 ? detail() : radius * number(0.1, 0.5);
    PolygonSoup soup;
    for (Corner i = 0; i < around; ++i)
      for (Corner j = 0; j < across; ++j) {
        const double u = 2 * pi * i / around, v = 2 * pi * j / across, r = radius + tube * std::cos(v);
        soup.points.emplace_back(r * std::cos(u), r * std::sin(u), tube * std::sin(v));
      }
    for (Corner i = 0; i < around; ++i)
      for (Corner j = 0; j < across; ++j) {
        const Corner a = i * across + j, b = (i + 1) % around * across + j;
        const Corner c = (i + 1) % around * across + (j + 1) % across, d = i * across + (j + 1) % across;
        soup.polygons.insert(soup.polygons.end(), {{a, b, c}, {a, c, d}});
      }
    return soup;
  }

  // A flat plate with teeth a detail wide and apart, from short to long ones.
  PolygonSoup comb() {
    const Corner teeth = count(2, 12);
    const double pitch = generator_() % 2 ? detail() : size() / teeth, depth = generator_() % 2 ? detail() : size() / 2;
    PolygonSoup soup;
    std::vector<Corner> border;
    const auto add = [&](double x, double y) {
      border.push_back(static_cast<Corner>(soup.points.size()));
      soup.points.emplace_back(x, y, 0.0);
    };
    add(0.0, -size());
    add(pitch * (teeth - 0.5), soup.points[0].y);
    for (Corner i = teeth; i-- > 0;) {
      add(pitch * (i + 0.5), depth);
      add(pitch * i, depth);
      if (i > 0) add(pitch * i, 0.0), add(pitch * (i - 0.5), 0.0);
    }
    soup.polygons.push_back(border);
    return soup;
  }

  // A plate one border of which is a saw of short edges.
  PolygonSoup saw() {
    const Corner teeth = count(2, 15);
    const double width = size(), depth = detail();
    PolygonSoup soup;
    std::vector<Corner> border;
    const auto add = [&](double x, double y, double z) {
      border.push_back(static_cast<Corner>(soup.points.size()));
      soup.points.emplace_back(x, y, z);
    };
    add(0.0, -size(), 0.0);
    add(width, soup.points[0].y, 0.0);
    for (Corner i = 2 * teeth + 1; i-- > 0;) add(width * i / (2.0 * teeth), i % 2 ? depth : 0.0, 0.0);
    soup.polygons.push_back(border);
    return soup;
  }

  std::mt19937_64 generator_;
};

}  // namespace raytube::testing
