// Smooth bodies as meshers of several kinds leave them.
#pragma once

#include <cmath>
#include <functional>
#include <map>

#include "core/random.h"
#include "shapes.h"

namespace raytube::shapes {

enum class FacetKind {
  geodesic,    // nearly equal triangles
  longitudes,  // rows and columns
  uneven       // triangles of all shapes
};

/// Radius and height of a meridian, from 0 at the top to 1 at the bottom.
using Meridian = std::function<dvec2(double)>;

/// A body of revolution about z: rows at these places of its meridian, whose ends lie on the axis.
inline PolygonSoup revolution(const Meridian& meridian, const std::vector<double>& rows, std::uint32_t columns) {
  PolygonSoup soup;
  std::vector<std::vector<std::uint32_t>> grid;
  for (const double row : rows) {
    const dvec2 at = meridian(row);
    const bool pole = at.x < 1e-12;
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    grid.emplace_back();
    for (std::uint32_t j = 0; j < columns; ++j) grid.back().push_back(pole ? first : first + j);
    for (std::uint32_t j = 0; j < (pole ? 1 : columns); ++j)
      soup.points.emplace_back(at.x * std::cos(2 * pi * j / columns), at.x * std::sin(2 * pi * j / columns), at.y);
  }
  for (std::size_t i = 0; i + 1 < grid.size(); ++i)
    for (std::uint32_t j = 0; j < columns; ++j) {
      const std::uint32_t a = grid[i][j], b = grid[i + 1][j], c = grid[i + 1][(j + 1) % columns], d = grid[i][(j + 1) % columns];
      if (a != d) soup.polygons.push_back({a, b, d});
      if (b != c) soup.polygons.push_back({b, c, d});
    }
  return soup;
}

inline std::vector<double> even_rows(std::uint32_t count) {
  std::vector<double> rows;
  for (std::uint32_t i = 0; i <= count; ++i) rows.push_back(static_cast<double>(i) / count);
  return rows;
}

/// The distance of an arc from its chord, at `x` from the middle; it meets the chord at `half_angle`.
inline double arc(double x, double chord, double half_angle) {
  const double radius = chord / 2 / std::sin(half_angle);
  return std::sqrt(radius * radius - x * x) - radius * std::cos(half_angle);
}

/// An arc turned about its chord along x, and flattened across: an ogive, or a leaf with flat tips.
inline PolygonSoup spindle(double half_angle, double length, double flatness) {
  PolygonSoup soup = revolution(
      [=](double x) {
        const double along = length / 2 * std::cos(pi * x);
        return dvec2(x == 0.0 || x == 1.0 ? 0.0 : arc(along, length, half_angle), along);
      },
      even_rows(60), 72);
  for (dvec3& p : soup.points) p = {p.z, p.x, flatness * p.y};
  return soup;
}

/// An icosahedron whose faces are divided into n^2 triangles each, on the unit sphere.
inline PolygonSoup geodesic_sphere(std::uint32_t n) {
  const PolygonSoup base = icosphere(0);
  PolygonSoup soup;
  std::map<std::array<long, 3>, std::uint32_t> known;
  const auto point = [&](const dvec3& at) {
    const dvec3 p = glm::normalize(at);
    const std::array<long, 3> key{std::lround(p.x * 1e9), std::lround(p.y * 1e9), std::lround(p.z * 1e9)};
    const auto [found, is_new] = known.try_emplace(key, static_cast<std::uint32_t>(soup.points.size()));
    if (is_new) soup.points.push_back(p);
    return found->second;
  };
  for (const std::vector<std::uint32_t>& face : base.polygons) {
    const dvec3 a = base.points[face[0]], b = base.points[face[1]] - a, c = base.points[face[2]] - a;
    const auto at = [&](std::uint32_t i, std::uint32_t j) { return point(a + (i * 1.0 / n) * b + (j * 1.0 / n) * c); };
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t j = 0; i + j < n; ++j) {
        soup.polygons.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
        if (i + j + 1 < n) soup.polygons.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
  }
  return soup;
}

/// A spheroid of half axes a, a, c with about this many facets.
inline PolygonSoup spheroid(FacetKind kind, double a, double c, std::uint32_t facets) {
  PolygonSoup soup;
  if (kind == FacetKind::longitudes) {
    const auto n = static_cast<std::uint32_t>(std::lround(std::sqrt(facets / 4.0)));
    soup = revolution([](double s) { return dvec2(std::sin(pi * s), std::cos(pi * s)); }, even_rows(n), 2 * n);
  } else {
    const auto n = static_cast<std::uint32_t>(std::lround(std::sqrt(facets / 20.0)));
    soup = geodesic_sphere(n);
    // Corners move by up to .3 of the sides of equal triangles, whose facets stay the right way up.
    const double reach = kind == FacetKind::uneven ? 0.3 * std::sqrt(4.0 * pi / (10.0 * n * n + 2) * 2.0 / std::sqrt(3.0)) : 0.0;
    for (std::size_t i = 0; i < soup.points.size(); ++i) {
      const dvec2 u = 2.0 * random_point(7, 0, i) - 1.0;
      const dvec3 e = glm::normalize(glm::cross(soup.points[i], dvec3(0.3, 0.5, 0.8)));
      soup.points[i] = glm::normalize(soup.points[i] + reach * (u.x * e + u.y * glm::cross(soup.points[i], e)));
    }
  }
  for (dvec3& p : soup.points) p *= dvec3(a, a, c);
  return soup;
}

/// A cylinder of this radius and length with half a sphere at each end; its wall is one row of facets.
inline PolygonSoup capsule(double radius, double length, std::uint32_t columns) {
  const auto meridian = [=](double s) {
    const double angle = pi * s;
    return dvec2(radius * std::sin(angle), radius * std::cos(angle) + std::copysign(0.5 * length, 0.5 - s));
  };
  std::vector<double> rows;
  const std::uint32_t quarter = columns / 4;
  for (std::uint32_t i = 0; i <= quarter; ++i) rows.push_back(0.5 * i / quarter);
  rows.push_back(std::nextafter(0.5, 1.0));
  for (std::uint32_t i = 1; i <= quarter; ++i) rows.push_back(0.5 + 0.5 * i / quarter);
  return revolution(meridian, rows, columns);
}

/// Chord 3 wavelengths along x between sharp edges, 0.45 thick, two equal arcs; span 3 wavelengths along y, flat caps.
inline PolygonSoup lens_wing(double wavelength) {
  constexpr int parts = 64;
  const double chord = 3 * wavelength, rise = 0.225 * wavelength, radius = (chord * chord / 4 + rise * rise) / (2 * rise);
  const double half = std::asin(0.5 * chord / radius);
  std::vector<dvec2> outline;
  for (const int side : {-1, 1})
    for (int i = 0; i < parts; ++i) {
      const double angle = half * (2.0 * i / parts - 1.0);
      outline.push_back({-side * radius * std::sin(angle), side * (radius * std::cos(angle) - radius + rise)});
    }
  const glm::dmat3 turn(dvec3(1, 0, 0), dvec3(0, 0, 1), dvec3(0, -1, 0));
  return transformed(prism(outline, -1.5 * wavelength, 1.5 * wavelength), turn);
}

}  // namespace raytube::shapes
