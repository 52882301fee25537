// Closed meshes drawn at random, from a seed.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <random>
#include <string>

#include "shapes.h"

namespace raytube::testing {

class ClosedBodies {
 public:
  /// Bodies are flattened by up to this factor along two axes.
  ClosedBodies(std::uint64_t seed, double flattest) : flattest_(flattest), generator_(seed) {}

  /// A body of one of the kinds below, flattened along random axes, turned, and moved by up to ten times its size.
  PolygonSoup next() {
    PolygonSoup soup = kind();
    const dvec3 stretch(power(), power(), 1.0);
    const glm::dmat3 first = turn(), second = turn();
    const dvec3 shift = 10.0 * dvec3(number(-1, 1), number(-1, 1), number(-1, 1));
    for (dvec3& point : soup.points) point = second * (stretch * (first * point)) + shift;
    return soup;
  }

 private:
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(generator_); }
  double power() { return std::pow(flattest_, -number(0.0, 1.0)); }

  glm::dmat3 turn() {
    std::normal_distribution<double> normal;
    const double w = normal(generator_), x = normal(generator_), y = normal(generator_), z = normal(generator_);
    return glm::mat3_cast(glm::normalize(glm::dquat(w, x, y, z)));
  }

  PolygonSoup kind() {
    switch (generator_() % 4) {
      case 0:
        return bumpy_sphere();
      case 1:
        return box_in_pieces();
      case 2:
        return star_prism();
      default:
        return ring();
    }
  }

  // Every corner at its own distance from the middle: valleys and ridges, never through one another.
  PolygonSoup bumpy_sphere() {
    PolygonSoup soup = shapes::icosphere(static_cast<int>(1 + generator_() % 4));
    const double roughness = number(0.0, 0.6);
    for (dvec3& point : soup.points) point *= number(1.0 - roughness, 1.0);
    return soup;
  }

  // Triangles divided again and again at a random point inside: slivers, and corners where many meet.
  PolygonSoup box_in_pieces() {
    PolygonSoup soup = shapes::box({number(0.1, 1), number(0.1, 1), 1});
    for (int division = 0; division < 200; ++division) {
      auto& triangle = soup.polygons[generator_() % soup.polygons.size()];
      const std::uint32_t i = triangle[0], j = triangle[1], k = triangle[2];
      const auto middle = static_cast<std::uint32_t>(soup.points.size());
      const double a = number(0.05, 0.9), b = number(0.05, 0.95 - a);
      soup.points.push_back(a * soup.points[i] + b * soup.points[j] + (1 - a - b) * soup.points[k]);
      triangle = {i, j, middle};
      soup.polygons.push_back({j, k, middle});
      soup.polygons.push_back({k, i, middle});
    }
    return soup;
  }

  // Sharp ridges outside and sharp folds inside.
  PolygonSoup star_prism() {
    const auto corners = static_cast<std::uint32_t>(2 * (2 + generator_() % 12));
    const double depth = number(0.02, 0.9), height = number(0.1, 2.0);
    std::vector<dvec2> outline;
    for (std::uint32_t i = 0; i < corners; ++i) {
      const double r = i % 2 ? depth : 1.0, phi = 2 * pi * i / corners;
      outline.emplace_back(r * std::cos(phi), r * std::sin(phi));
    }
    return shapes::prism(outline, 0.0, height);
  }

  PolygonSoup ring() {
    const auto around = static_cast<std::uint32_t>(3 + generator_() % 40),
               across = static_cast<std::uint32_t>(3 + generator_() % 20);
    const double thickness = number(0.02, 0.9);
    PolygonSoup soup;
    for (std::uint32_t i = 0; i < around; ++i)
      for (std::uint32_t k = 0; k < across; ++k) {
        const double phi = 2 * pi * i / around, psi = 2 * pi * k / across, r = 1 + thickness * std::cos(psi);
        soup.points.emplace_back(r * std::cos(phi), r * std::sin(phi), thickness * std::sin(psi));
        const std::uint32_t a = i * across + k, b = ((i + 1) % around) * across + k, beside = (k + 1) % across;
        const std::uint32_t c = ((i + 1) % around) * across + beside, d = i * across + beside;
        soup.polygons.push_back({a, b, c});
        soup.polygons.push_back({a, c, d});
      }
    return soup;
  }

  double flattest_;
  std::mt19937_64 generator_;
};

}  // namespace raytube::testing
