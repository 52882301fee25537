// Flat faces cut into other triangles: many, thin, with vertices that hang on the edges of others.

#include "mesh/repair/triangulate.h"
#include "stress/description.h"
#include "stress/stability.h"

namespace raytube::testing {
namespace {

using Corners = std::array<dvec3, 3>;

std::vector<Corners> triangles_of(const PolygonSoup& soup) {
  std::vector<Corners> result;
  for (const auto& polygon : soup.polygons)
    for (const auto& [a, b, c] : triangulate(soup.points, polygon))
      result.push_back({soup.points[a], soup.points[b], soup.points[c]});
  return result;
}

/// As in an STL file: every triangle has corners of its own.
PolygonSoup soup_of(const std::vector<Corners>& triangles) {
  PolygonSoup soup;
  for (const Corners& t : triangles) {
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    soup.points.insert(soup.points.end(), t.begin(), t.end());
    soup.polygons.push_back({first, first + 1, first + 2});
  }
  return soup;
}

/// The same place for both triangles at a side.
dvec3 between(const dvec3& a, const dvec3& b, double share) { return a + share * (b - a); }

/// n * n similar triangles.
void add_regular(const Corners& t, int n, std::vector<Corners>& result) {
  const auto at = [&](int i, int k) {
    return t[0] + (static_cast<double>(i) / n) * (t[1] - t[0]) + (static_cast<double>(k) / n) * (t[2] - t[0]);
  };
  for (int i = 0; i < n; ++i)
    for (int k = 0; i + k < n; ++k) {
      result.push_back({at(i, k), at(i + 1, k), at(i, k + 1)});
      if (i + k + 1 < n) result.push_back({at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)});
    }
}

PolygonSoup regular(const PolygonSoup& soup, int n) {
  std::vector<Corners> result;
  for (const Corners& t : triangles_of(soup)) add_regular(t, n, result);
  return soup_of(result);
}

/// Neighbours are cut into different numbers of triangles, so that corners of one hang on the sides of the other.
PolygonSoup hanging(const PolygonSoup& soup, int n) {
  std::vector<Corners> result;
  int more = 0;
  for (const Corners& t : triangles_of(soup)) add_regular(t, n + more++ % 3, result);
  return soup_of(result);
}

/// The same with the vertices inside each triangle displaced at random, by up to a quarter of the way to their neighbours.
PolygonSoup displaced(const PolygonSoup& soup, int n) {
  std::vector<Corners> result;
  std::uint64_t stream = 1000;
  for (const Corners& t : triangles_of(soup)) {
    const dvec3 u = (t[1] - t[0]) / static_cast<double>(n), v = (t[2] - t[0]) / static_cast<double>(n);
    ++stream;
    const auto at = [&](int i, int k) {
      const dvec2 random = random_point(7, stream, static_cast<std::uint64_t>(i * (n + 1) + k));
      const bool inside = i > 0 && k > 0 && i + k < n;
      const double aside = inside ? 0.25 * random.x : 0.0, angle = 2 * pi * random.y;
      return t[0] + (i + aside * std::cos(angle)) * u + (k + aside * std::sin(angle)) * v;
    };
    for (int i = 0; i < n; ++i)
      for (int k = 0; i + k < n; ++k) {
        result.push_back({at(i, k), at(i + 1, k), at(i, k + 1)});
        if (i + k + 1 < n) result.push_back({at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)});
      }
  }
  return soup_of(result);
}

/// A random triangle is cut at a random point inside, again and again: needles of all sizes.
PolygonSoup random_points(const PolygonSoup& soup, std::size_t count, std::uint64_t stream) {
  std::vector<Corners> all = triangles_of(soup);
  for (std::uint64_t i = 0; all.size() < count; ++i) {
    const auto which = static_cast<std::size_t>(random_number(stream, 2 * i) * static_cast<double>(all.size()));
    const dvec2 at = random_point(7, stream, 2 * i + 1);
    const double root = std::sqrt(at.x);
    const Corners t = all[which];
    const dvec3 inside = (1 - root) * t[0] + root * (1 - at.y) * t[1] + root * at.y * t[2];
    all[which] = {t[0], t[1], inside};
    all.push_back({t[1], t[2], inside});
    all.push_back({t[2], t[0], inside});
  }
  return soup_of(all);
}

/// Along every side of a triangle one of this height [m].
PolygonSoup slivers(const PolygonSoup& soup, double height) {
  std::vector<Corners> result;
  for (const Corners& t : triangles_of(soup)) {
    const dvec3 normal = glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]));
    Corners inner;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      inner[i] = between(t[i], t[j], 0.45) + height * glm::normalize(glm::cross(normal, t[j] - t[i]));
      result.push_back({t[i], t[j], inner[i]});
    }
    result.push_back(inner);
    for (int i = 0; i < 3; ++i) result.push_back({t[i], inner[i], inner[(i + 2) % 3]});
  }
  return soup_of(result);
}

using Remeshing = std::function<PolygonSoup(const PolygonSoup&)>;

// Turned, so that no coordinate is exact and new corners lie in their planes to rounding only.
std::vector<NamedSoup> turned_targets() {
  std::vector<NamedSoup> targets = flat_targets();
  for (std::size_t t = 0; t < targets.size(); ++t) targets[t].soup = shapes::transformed(targets[t].soup, random_rotation(3, t));
  return targets;
}

double worst_of_remeshing(const std::vector<NamedSoup>& targets, const Remeshing& remesh) {
  const auto changed = [&](Description d, int) {
    d.soup = remesh(d.soup);
    return Change{std::move(d)};
  };
  std::vector<NamedOptions> options = plain_options();
  options.back() = order_3();
  return worst_of_changes(targets, options, general_looks(), 1, changed);
}

// A plane through many corners is that through few to a rounding, and a patch with a convex outline is the same polygon however
// it is cut; others are other polygons of the same area.
constexpr const char* reason =
    "planes and outlines are the same to rounding, 1e-14; a tube or a ray decided otherwise would be 1e-6";

TEST(Remesh, RegularTriangles) {
  const int n = size_of_run(12, 60);
  expect_stable({std::to_string(n * n) + " triangles for one", flat_names,
                 worst_of_remeshing(turned_targets(), [=](const PolygonSoup& soup) { return regular(soup, n); }), 1e-9, reason});
}

TEST(Remesh, ManyTrianglesAFace) {
  const int n = size_of_run(40, 224);
  const std::vector<NamedSoup> few = {turned_targets()[0], turned_targets()[2]};
  expect_stable({std::to_string(2 * n * n) + " triangles a face", "plate, dihedral",
                 worst_of_remeshing(few, [=](const PolygonSoup& soup) { return regular(soup, n); }), 1e-9, reason});
}

TEST(Remesh, DisplacedVertices) {
  const int n = size_of_run(12, 60);
  std::vector<NamedSoup> convex_faces = turned_targets();
  const NamedSoup bar = convex_faces[4];
  convex_faces.erase(convex_faces.begin() + 4);
  expect_stable({std::to_string(n * n) + " triangles for one, corners inside displaced at random",
                 "plate, cube, dihedral, trihedral, two boxes",
                 worst_of_remeshing(convex_faces, [=](const PolygonSoup& soup) { return displaced(soup, n); }), 1e-9, reason});
  // Its ends are not convex, and stay cut into many faces; from some thousands on adaptive tubes sample them by cells.
  expect_stable({"144 triangles for one, corners inside displaced at random", "L-shaped bar",
                 worst_of_remeshing({bar}, [](const PolygonSoup& soup) { return displaced(soup, 12); }), 1e-9, reason});
}

TEST(Remesh, NeedlesOfAllSizes) {
  // Some hundred; of many thousands some would be thinner than the distance below which vertices are one.
  const auto remesh = [](const PolygonSoup& soup) { return random_points(soup, 500, 1); };
  expect_stable({"500 triangles, cut at random points again and again", flat_names, worst_of_remeshing(turned_targets(), remesh),
                 1e-9, reason});
}

TEST(Remesh, HangingVertices) {
  const int n = size_of_run(8, 40);
  expect_stable({"neighbours cut into " + std::to_string(n * n) + " to " + std::to_string((n + 2) * (n + 2)) +
                     " triangles: corners hang on the sides of others",
                 flat_names, worst_of_remeshing(turned_targets(), [=](const PolygonSoup& soup) { return hanging(soup, n); }),
                 1e-9, reason});
}

TEST(Remesh, Slivers) {
  // The largest target is 5.2 wavelengths from corner to corner; what is lower than 1e-7 of that is nothing.
  const auto remesh = [](const PolygonSoup& soup) { return slivers(soup, 1e-6 * stress_wavelength); };
  expect_stable({"slivers along all sides, 2e6 times as long as high", flat_names, worst_of_remeshing(turned_targets(), remesh),
                 1e-9, reason});
}

TEST(Remesh, SliversBelowTheWeldDistance) {
  // They are taken out, and corners within 1e-7 of the diagonal D, 5.2 wavelengths, of an edge join it: faces move by that at
  // most, phases by 2 k 1e-7 D.
  const auto remesh = [](const PolygonSoup& soup) { return slivers(soup, 1e-8 * stress_wavelength); };
  expect_stable({"slivers along all sides, 2e8 times as long as high", flat_names, worst_of_remeshing(turned_targets(), remesh),
                 3 * 4 * pi * 5.2e-7, "vertices 1e-7 D apart are one: 2 k 1e-7 D a bounce, of three"});
}

}  // namespace
}  // namespace raytube::testing
