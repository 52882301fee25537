// Test targets made in memory.
#pragma once

#include <cmath>
#include <map>

#include "mesh/load.h"

namespace raytube::shapes {

/// Square plate of side `a` in z = 0, centred, turned by `turn` [rad] in its plane.
inline PolygonSoup plate(double a, double turn = 0.0) {
  const double h = a / 2, c = std::cos(turn), s = std::sin(turn);
  const auto corner = [&](double x, double y) { return dvec3(c * x - s * y, s * x + c * y, 0.0); };
  return {{corner(-h, -h), corner(h, -h), corner(h, h), corner(-h, h)}, {{0, 1, 2}, {0, 2, 3}}};
}

/// Faces w x b on +x and +y, fold on z, open sheets.
inline PolygonSoup dihedral(double w, double b) {
  const double h = b / 2;
  return {{{0, 0, -h}, {w, 0, -h}, {w, 0, h}, {0, 0, h}, {0, w, -h}, {0, w, h}}, {{0, 3, 2}, {0, 2, 1}, {0, 4, 5}, {0, 5, 3}}};
}

/// Three right isosceles triangles of leg `a` on the positive axes.
inline PolygonSoup trihedral(double a) {
  return {{{0, 0, 0}, {a, 0, 0}, {0, a, 0}, {0, 0, a}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}}};
}

/// Closed box of the given sides, centred.
inline PolygonSoup box(const dvec3& sides) {
  PolygonSoup soup;
  const dvec3 h = sides / 2.0;
  for (int i = 0; i < 8; ++i) soup.points.emplace_back(i & 1 ? h.x : -h.x, i & 2 ? h.y : -h.y, i & 4 ? h.z : -h.z);
  soup.polygons = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                   {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return soup;
}

/// Closed cube of side `a`, centred.
inline PolygonSoup cube(double a) { return box(dvec3(a)); }

/// Sphere of radius `a`, 20 * 4^subdivisions triangles with corners on it.
inline PolygonSoup icosphere(int subdivisions, double a = 1.0) {
  const double p = std::numbers::phi;
  std::vector<dvec3> v = {{-1, p, 0},  {1, p, 0},  {-1, -p, 0}, {1, -p, 0}, {0, -1, p},  {0, 1, p},
                          {0, -1, -p}, {0, 1, -p}, {p, 0, -1},  {p, 0, 1},  {-p, 0, -1}, {-p, 0, 1}};
  std::vector<std::vector<std::uint32_t>> t = {
      {0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
      {3, 9, 4},  {3, 4, 2}, {3, 2, 6}, {3, 6, 8},  {3, 8, 9},   {4, 9, 5}, {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (dvec3& q : v) q = glm::normalize(q);
  for (int level = 0; level < subdivisions; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t i, std::uint32_t j) {
      const auto [entry, is_new] = middles.try_emplace(std::minmax(i, j), static_cast<std::uint32_t>(v.size()));
      if (is_new) v.push_back(glm::normalize(v[i] + v[j]));
      return entry->second;
    };
    std::vector<std::vector<std::uint32_t>> finer;
    for (const auto& f : t) {
      const std::uint32_t ab = middle(f[0], f[1]), bc = middle(f[1], f[2]), ca = middle(f[2], f[0]);
      finer.insert(finer.end(), {{f[0], ab, ca}, {f[1], bc, ab}, {f[2], ca, bc}, {ab, bc, ca}});
    }
    t = std::move(finer);
  }
  for (dvec3& q : v) q *= a;
  return {v, t};
}

/// Closed right prism from z = low to high on a counter-clockwise outline; the two ends are single polygons.
inline PolygonSoup prism(const std::vector<dvec2>& outline, double low, double high) {
  PolygonSoup soup;
  const auto n = static_cast<std::uint32_t>(outline.size());
  for (const double z : {low, high})
    for (const dvec2& p : outline) soup.points.emplace_back(p.x, p.y, z);
  std::vector<std::uint32_t> bottom, top;
  for (std::uint32_t i = 0; i < n; ++i) {
    bottom.push_back(n - 1 - i);
    top.push_back(n + i);
    soup.polygons.push_back({i, (i + 1) % n, n + (i + 1) % n, n + i});
  }
  soup.polygons.push_back(bottom);
  soup.polygons.push_back(top);
  return soup;
}

/// Tip at (0, 0, height), rim of radius `a` about the origin; with a polygon for a bottom if closed.
inline PolygonSoup cone(double a, double height, std::uint32_t sides, bool closed) {
  PolygonSoup soup{{{0, 0, height}}, {}};
  std::vector<std::uint32_t> bottom;
  for (std::uint32_t i = 0; i < sides; ++i) {
    soup.points.emplace_back(a * std::cos(2 * pi * i / sides), a * std::sin(2 * pi * i / sides), 0.0);
    soup.polygons.push_back({0, 1 + i, 1 + (i + 1) % sides});
    bottom.insert(bottom.begin(), 1 + i);
  }
  if (closed) soup.polygons.push_back(bottom);
  return soup;
}

/// A square about the origin of 2 n^2 triangles, `side` wide.
inline PolygonSoup tiled_plate(double side, std::uint32_t n) {
  PolygonSoup soup;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= n; ++j) soup.points.emplace_back(side * i / n - side / 2, side * j / n - side / 2, 0.0);
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t p = i * (n + 1) + j;
      soup.polygons.push_back({p, p + n + 1, p + n + 2});
      soup.polygons.push_back({p, p + n + 2, p + 1});
    }
  return soup;
}

/// Closed cylinder along z, centred, `sides` corners on the circle of radius `a`.
inline PolygonSoup cylinder(double a, double length, std::uint32_t sides) {
  std::vector<dvec2> outline;
  for (std::uint32_t i = 0; i < sides; ++i)
    outline.emplace_back(a * std::cos(2 * pi * i / sides), a * std::sin(2 * pi * i / sides));
  return prism(outline, -length / 2, length / 2);
}

/// Two soups as one, nothing shared.
inline PolygonSoup joined(PolygonSoup first, const PolygonSoup& second) {
  const auto offset = static_cast<std::uint32_t>(first.points.size());
  first.points.insert(first.points.end(), second.points.begin(), second.points.end());
  for (std::vector<std::uint32_t> polygon : second.polygons) {
    for (std::uint32_t& corner : polygon) corner += offset;
    first.polygons.push_back(std::move(polygon));
  }
  return first;
}

/// A plate of side 4 and a sheet of 2 n^2 triangles that lies on it, some of its corners by up to 4e-6 above.
inline PolygonSoup sheet_on_plate(std::uint32_t n) {
  PolygonSoup sheet = tiled_plate(2.0, n);
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= n; ++j) sheet.points[i * (n + 1) + j].z = 1e-6 * ((7 * i + 3 * j) % 5);
  return joined(plate(4.0, 0.1), sheet);
}

inline PolygonSoup transformed(PolygonSoup soup, const glm::dmat3& turn, double scale = 1.0, const dvec3& shift = dvec3(0.0)) {
  for (dvec3& p : soup.points) p = scale * (turn * p) + shift;
  return soup;
}

}  // namespace raytube::shapes
