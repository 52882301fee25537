// Which parts of edges reflected waves light, against single rays sent back from points of them.
#include "utd/interaction/reflected_light.h"

#include <gtest/gtest.h>

#include <optional>
#include <random>

#include "unit/mesh_shapes.h"
#include "utd/interaction/edge_axes.h"

namespace raytube {
namespace {

constexpr double wavelength_1m = 1.0;

PolygonSoup dihedral(double a) {
  return {{{0, 0, 0}, {a, 0, 0}, {a, 0, a}, {0, 0, a}, {0, a, 0}, {0, a, a}}, {{0, 1, 2, 3}, {0, 3, 5, 4}}};
}
PolygonSoup trihedral(double a) { return shapes::joined(dihedral(a), shapes::plate({0, 0, 0}, {0, a, 0}, {a, 0, 0})); }
PolygonSoup l_shape() { return shapes::prism({{0, 0}, {6, 0}, {6, 3}, {3, 3}, {3, 6}, {0, 6}}, 3.0); }

struct Target {
  explicit Target(const PolygonSoup& soup)
      : loaded(shapes::build(soup)),
        wedges(shapes::wedges_of(loaded)),
        axes(edge_axes(loaded.mesh, wedges, {})),
        tree(loaded.mesh),
        tracer(loaded.mesh) {}

  std::deque<ReflectedWave> light(const PlaneWave& incident, int most) const {
    const std::vector<bool> all(loaded.mesh.patches.size(), true);
    return ReflectedLight({tree, all, {}}, axes, incident, wavelength_1m).waves(most);
  }

  /// Whether the way back from a point of an edge, or beside it along its surface, runs over the mirrors, last one first, and
  /// then clear. Closed bodies are met from outside, so every hit counts.
  bool lit(const EdgeAxis& axis, double position, double sideways, dvec3 backwards,
           std::span<const std::uint32_t> mirrors) const {
    const std::array<WedgeFace, 2>& faces = axis.wedge->faces;
    const dvec3 over = faces[0].into_face - faces[1].into_face;
    dvec3 from =
        axis.origin + position * axis.tangent + sideways * (axis.wedge->n == 2.0 ? faces[0].into_face : glm::normalize(over));
    IgnoredPatches ignored{axis.wedge->faces[0].patch, axis.wedge->faces[1].patch, axis.wedge->border_patch};
    for (std::size_t left = mirrors.size();; --left) {
      const auto [patch, distance] = first(from, backwards, ignored);
      if (left == 0) return patch == no_index;
      if (patch != mirrors[left - 1]) return false;
      from += distance * backwards;
      const dvec3& n = loaded.mesh.patches[patch].normal;
      backwards -= 2 * glm::dot(n, backwards) * n;
      ignored = {patch, no_index, no_index};
    }
  }

  std::pair<std::uint32_t, double> first(dvec3 from, const dvec3& direction, const IgnoredPatches& ignored) const {
    double gone = 0.0;
    std::uint32_t source = ignored[0];
    for (int passed = 0; passed < 20; ++passed) {
      const Ray ray{from, direction, source};
      Hit hit;
      tracer.closest_hits({&ray, 1}, {&hit, 1});
      if (!hit) return {no_index, 0.0};
      source = loaded.mesh.triangle_patch[hit.triangle];
      gone += hit.distance;
      if (std::ranges::find(ignored, source) == ignored.end()) return {source, gone};
      from += hit.distance * direction;
    }
    ADD_FAILURE() << "more surfaces on a ray than there are";
    return {no_index, 0.0};
  }

  LoadedMesh loaded;
  std::vector<Wedge> wedges;
  std::vector<EdgeAxis> axes;
  FaceTree tree;
  Tracer tracer;
};

/// The weight of the pieces at a position; none within two thousandths of a wavelength of an end of one, which may be snapped.
std::optional<double> weight_at(const ReflectedWave& wave, const EdgeAxis& axis, double position) {
  double weight = 0.0;
  for (const LitEdgePiece& piece : wave.lit) {
    if (piece.edge != &axis) continue;
    if (std::min(std::abs(position - piece.from), std::abs(position - piece.to)) < 2e-3) return {};
    if (piece.from < position && position < piece.to) weight += piece.weight;
  }
  return weight;
}

PlaneWave wave_from(const dvec3& direction) { return {direction, {dvec3(0.0), dvec3(0.0)}, 0.0}; }

// Every sequence of mirrors that lights an edge is found, and no other.
int expect_single_rays(const Target& target, const dvec3& direction, int most) {
  const PlaneWave incident = wave_from(direction);
  const std::deque<ReflectedWave> waves = target.light(incident, most);
  const auto patches = static_cast<std::uint32_t>(target.loaded.mesh.patches.size());
  int lit = 0;
  for (std::uint32_t first = 0; first < patches; ++first)
    for (std::uint32_t second = 0; second <= (most > 1 ? patches : 0); ++second) {
      std::vector<std::uint32_t> mirrors = {first};
      if (second > 0) mirrors.push_back(second - 1);
      if (mirrors.size() == 2 && mirrors[0] == mirrors[1]) continue;
      dvec3 last = direction;
      for (const std::uint32_t mirror : mirrors) last = reflected(wave_from(last), target.loaded.mesh.patches[mirror]).direction;
      const auto wave = std::ranges::find(waves, mirrors, &ReflectedWave::patches);
      for (const EdgeAxis& axis : target.axes) {
        const WedgeFace* faces = axis.wedge->faces.data();
        if (faces[0].patch == mirrors.back() || faces[1].patch == mirrors.back()) continue;
        if (incidence_on(*axis.wedge, last).weight == 0.0) continue;
        for (int i = 0; i < 40; ++i) {
          const double position = axis.length * (i + 0.5) / 40;
          const bool wanted = target.lit(axis, position, 0.0, -last, mirrors);
          lit += wanted;
          // Within 4 % of its length of a beam's border an edge is lit in part: there the two sides differ.
          const double aside = 0.04 * axis.length;
          const bool over = target.lit(axis, position, aside, -last, mirrors),
                     under = target.lit(axis, position, -aside, -last, mirrors);
          const std::optional<double> weight = wave == waves.end() ? 0.0 : weight_at(*wave, axis, position);
          if (!weight) continue;
          if (over == under)
            EXPECT_EQ(*weight, over ? 1.0 : 0.0) << "mirrors " << mirrors.size() << ", position " << position;
          else
            EXPECT_TRUE(*weight >= 0.0 && *weight <= 1.0) << *weight << " at " << position;
        }
      }
    }
  return lit;
}

TEST(ReflectedLight, PiecesAreThoseOfSingleRays) {
  std::mt19937 random(5);
  const auto number = [&] { return 2.0 * static_cast<double>(random()) / 4294967296.0 - 1.0; };
  for (const PolygonSoup& soup : {dihedral(3), trihedral(3), l_shape()}) {
    const Target target(soup);
    int lit = 0;
    for (int i = 0; i < 6; ++i) lit += expect_single_rays(target, glm::normalize(dvec3(number(), number(), number())), 2);
    for (int i = 0; i < 6; ++i)  // into the corner
      lit += expect_single_rays(target, -glm::normalize(dvec3(0.6 + 0.4 * number(), 0.6 + 0.4 * number(), 0.5 * number())), 2);
    EXPECT_GT(lit, 300);
  }
}

TEST(ReflectedLight, OnTheBorderOfABeamAnEdgeIsHalfLit) {
  // Across the inner edge, every beam ends with the face, and the other face's ends lie on that border.
  const Target target(dihedral(3));
  const std::deque<ReflectedWave> waves = target.light(wave_from(-glm::normalize(dvec3(2, 1, 0))), 1);
  ASSERT_EQ(waves.size(), 2u);
  int half = 0, whole = 0;
  for (const ReflectedWave& wave : waves)
    for (const LitEdgePiece& piece : wave.lit) {
      const bool at_end = std::abs(piece.edge->tangent.z) < 0.5;
      EXPECT_NEAR(piece.weight, at_end ? 0.5 : 1.0, 1e-6);  // the border is searched to 2^-40 of 4 % of the length
      ++(at_end ? half : whole);
    }
  EXPECT_EQ(half, 4);   // two ends of either face
  EXPECT_EQ(whole, 1);  // the outer edge that the reflected light reaches
}

TEST(ReflectedLight, WaveKeepsThePhaseOnTheMirror) {
  // On the mirror the paths of both waves agree, and E changes sign along it (a perfect conductor).
  const Patch plane{glm::normalize(dvec3(1, -2, 0.5)), 0.7};
  const dvec3 d = glm::normalize(dvec3(0.3, 0.8, -0.2)), e = glm::normalize(glm::cross(d, dvec3(1, 0, 0)));
  const PlaneWave before{d, {e, glm::cross(d, e)}, 0.4}, after = reflected(before, plane);
  for (const dvec3& along : {dvec3(0.0), dvec3(3, 1, -2)}) {
    const dvec3 point = plane.offset * plane.normal + along - glm::dot(along, plane.normal) * plane.normal;
    // A few roundings of numbers of order 1 here and below.
    EXPECT_NEAR(glm::dot(after.direction, point) + after.path, glm::dot(before.direction, point) + before.path, 1e-14);
  }
  for (int q = 0; q < 2; ++q) {
    EXPECT_NEAR(glm::length(glm::cross(plane.normal, after.electric[q] + before.electric[q])), 0.0, 1e-14);
    EXPECT_NEAR(glm::dot(after.electric[q], after.direction), 0.0, 1e-14);
  }
}

}  // namespace
}  // namespace raytube
