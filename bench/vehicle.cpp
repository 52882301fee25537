#include "vehicle.h"

#include <cmath>
#include <functional>

namespace raytube::bench {

namespace {

using Surface = std::function<dvec3(double, double)>;  // of two parameters 0..1

struct Builder {
  double edge;  // of a triangle [m]
  PolygonSoup soup;

  std::uint32_t cuts(double length) const { return static_cast<std::uint32_t>(std::max(1.0, std::round(length / edge))); }
  std::uint32_t cuts_round(double radius) const { return std::max(8u, cuts(2.0 * pi * radius)); }

  void triangle(const dvec3& a, const dvec3& b, const dvec3& c) {
    if (glm::length(glm::cross(b - a, c - a)) < 1e-12) return;  // at the middle of a disc
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    soup.points.insert(soup.points.end(), {a, b, c});
    soup.polygons.push_back({first, first + 1, first + 2});
  }

  // Seams close by welding: equal parameters give equal points to rounding.
  void sheet(std::uint32_t across, std::uint32_t along, const Surface& at) {
    for (std::uint32_t i = 0; i < across; ++i)
      for (std::uint32_t j = 0; j < along; ++j) {
        const double s = double(i) / across, s_next = double(i + 1) / across, t = double(j) / along,
                     t_next = double(j + 1) / along;
        const dvec3 a = at(s, t), b = at(s_next, t), c = at(s_next, t_next), d = at(s, t_next);
        triangle(a, b, c);
        triangle(a, c, d);
      }
  }

  void face(const dvec3& corner, const dvec3& u, const dvec3& v) {
    sheet(cuts(glm::length(u)), cuts(glm::length(v)), [&](double s, double t) { return corner + s * u + t * v; });
  }

  // Sides along the axes, then turned about y by `pitch`.
  void box(const dvec3& middle, const dvec3& sides, double pitch = 0.0) {
    const dvec3 x = sides.x * dvec3(std::cos(pitch), 0, -std::sin(pitch)), y(0, sides.y, 0),
                z = sides.z * dvec3(std::sin(pitch), 0, std::cos(pitch)), low = middle - (x + y + z) / 2.0,
                high = low + x + y + z;
    face(low, y, x);
    face(low, x, z);
    face(low, z, y);
    face(high, -x, -y);
    face(high, -z, -x);
    face(high, -y, -z);
  }

  void rod(const dvec3& from, const dvec3& to, double radius) {
    const dvec3 axis = to - from, u = radius * glm::normalize(glm::cross(axis, dvec3(0.3, 0.5, 0.7))),
                v = glm::cross(glm::normalize(axis), u);
    const std::uint32_t round = cuts_round(radius);
    const auto circle = [&](double s) { return std::cos(2 * pi * s) * u + std::sin(2 * pi * s) * v; };
    sheet(round, cuts(glm::length(axis)), [&](double s, double t) { return from + t * axis + circle(s); });
    sheet(round, cuts(radius), [&](double s, double t) { return from + t * circle(s); });
    sheet(round, cuts(radius), [&](double s, double t) { return to + (1 - t) * circle(s); });
  }

  void wheel(const dvec3& middle) {
    constexpr double radius = 0.55, thickness = 0.2;
    sheet(cuts_round(radius), cuts_round(thickness), [&](double s, double t) {
      const double out = radius + thickness * std::cos(2 * pi * t);
      return middle + dvec3(out * std::cos(2 * pi * s), thickness * std::sin(2 * pi * t), out * std::sin(2 * pi * s));
    });
    rod(middle - dvec3(0, 0.12, 0), middle + dvec3(0, 0.12, 0), 0.45);
  }

  // Half a pipe and more, open to the front, with flat ends.
  void bucket(const dvec3& middle, double radius, double width) {
    const auto arc = [&](double s) {
      const double angle = (70 + 220 * s) * degree;
      return radius * dvec3(std::cos(angle), 0, std::sin(angle));
    };
    const dvec3 half(0, width / 2, 0);
    const std::uint32_t round = std::max(8u, cuts(radius * 220 * degree));
    sheet(round, cuts(width), [&](double s, double t) { return middle + (2 * t - 1) * half + arc(s); });
    for (const double side : {-1.0, 1.0})
      sheet(round, cuts(radius), [&](double s, double t) { return middle + side * half + t * arc(s); });
  }
};

PolygonSoup with_edge(double edge) {
  Builder b{edge, {}};
  b.box({0.0, 0, 0.95}, {4.6, 1.0, 0.5});               // frame
  b.box({-1.5, 0, 1.65}, {1.8, 1.6, 1.0});              // engine
  b.box({0.25, 0, 2.2}, {1.5, 1.5, 1.9});               // cabin
  b.box({-2.45, 0, 1.1}, {0.4, 2.2, 0.7});              // counterweight
  b.rod({-1.9, 0.5, 2.0}, {-1.9, 0.5, 3.0}, 0.09);      // exhaust
  b.rod({-0.9, -1.05, 1.0}, {-0.2, -1.05, 1.0}, 0.25);  // tank
  for (const double side : {-1.0, 1.0}) {
    for (const double x : {-1.45, 1.45}) b.wheel({x, side * 1.15, 0.75});
    b.box({2.2, side * 0.45, 1.25}, {2.7, 0.2, 0.3}, 0.35);  // arm
    b.rod({1.0, side * 0.25, 1.1}, {3.2, side * 0.25, 0.85}, 0.07);
  }
  b.rod({-1.45, -1.0, 0.75}, {-1.45, 1.0, 0.75}, 0.12);  // axles
  b.rod({1.45, -1.0, 0.75}, {1.45, 1.0, 0.75}, 0.12);
  b.bucket({3.85, 0, 0.65}, 0.6, 2.8);
  return std::move(b.soup);
}

}  // namespace

PolygonSoup vehicle(double triangles) {
  constexpr double first_edge = 0.1;
  const auto first_count = static_cast<double>(with_edge(first_edge).polygons.size());
  return with_edge(first_edge * std::sqrt(first_count / triangles));
}

}  // namespace raytube::bench
