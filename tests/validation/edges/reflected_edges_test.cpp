// Fringe currents of edges that reflected waves light.
#include "utd/fringe/reflected_edges.h"

#include <gtest/gtest.h>

#include "run.h"
#include "shapes.h"
#include "utd/fringe/edges.h"
#include "utd/shadow/lit_edges.h"

namespace raytube {
namespace {

using namespace raytube::testing;

constexpr double frequencies[] = {speed_of_light, 1.3 * speed_of_light};

struct Scene {
  explicit Scene(PolygonSoup soup) : loaded(build_mesh(std::move(soup), 1.0)), target(loaded.mesh) {}

  EdgeScene edges() const { return {target.wedges, target.outlines, target.tracer}; }

  EdgeLookResult direct(const Look& look, int order) const { return fringe_scattering(edges(), look, {frequencies}, {order}); }

  /// A wave that lights what it would light if nothing were in its way but the target.
  ReflectedLook lit_by(const LookVectors& look, double path, double weight = 1.0) const {
    ReflectedLook result{look, path, {}};
    LitEdges edges(target.wedges, target.tracer, -look.incident, std::nullopt, 1 / 1.3);
    for (std::uint32_t i = 0; i < target.wedges.size(); ++i) {
      const WedgeIncidence incidence = incidence_on(target.wedges[i], look.incident);
      if (incidence.weight == 1.0 && edges.find(i, incidence))
        result.edges.push_back({i, {edges.lit().begin(), edges.lit().end()}, weight});
    }
    return result;
  }

  EdgeLookResult reflected(std::span<const ReflectedLook> looks, int order) const {
    return reflected_fringe_scattering(edges(), looks, frequencies, {order, false, true});
  }

  LoadedMesh loaded;
  Target target;
};

const Look looks[] = {{{0.9, 0.4}, {1.3, 2.1}}, {{0.7, -0.6}, {0.7, -0.6}}, {{1.2, 2.4}, {2.0, -1.0}}, {{2.1, 0.9}, {0.5, 3.0}}};

TEST(ReflectedEdges, OfTheIncidentWaveItselfIsItsFringe) {
  const Scene cube(shapes::cube(2));
  for (const Look& look : looks)
    for (const int order : {2, 3}) {
      const EdgeLookResult wanted = cube.direct(look, order);
      const ReflectedLook same[] = {cube.lit_by(look_vectors(look), 0.0)};
      const EdgeLookResult found = cube.reflected(same, order);
      EXPECT_EQ(found.wedges_lit, wanted.wedges_lit);
      EXPECT_GT(largest_amplitude(wanted.scattering[0]), 0.01);
      for (std::size_t i = 0; i < std::size(frequencies); ++i) {
        EXPECT_EQ(largest_amplitude(found.scattering[i] - wanted.scattering[i]), 0.0);
        EXPECT_EQ(largest_amplitude(found.higher[i] - wanted.higher[i]), 0.0);
      }
    }
}

TEST(ReflectedEdges, EdgesCountWithTheirWeight) {
  const Scene cube(shapes::cube(2));
  const LookVectors look = look_vectors(looks[0]);
  ReflectedLook half = cube.lit_by(look, 0.3, 0.5), split = cube.lit_by(look, 0.3);
  split.edges.front().weight = 0.5;
  split.edges.push_back(split.edges.front());
  const ReflectedLook whole[] = {cube.lit_by(look, 0.3)}, twice[] = {half, half}, again[] = {split};
  const ScatteringMatrix wanted = cube.reflected(whole, 3).scattering[1];
  // Rounding of sums of some hundred terms.
  EXPECT_LE(largest_amplitude(cube.reflected(twice, 3).scattering[1] - wanted), 1e-14);
  EXPECT_LE(largest_amplitude(cube.reflected(again, 3).scattering[1] - wanted), 1e-14);
}

/// A box turned about two axes, or its image in the plane z = height.
PolygonSoup turned_box(std::optional<double> height) {
  PolygonSoup soup = shapes::box({1.5, 2.0, 2.5});
  for (dvec3& p : soup.points) {
    p = {std::cos(0.4) * p.x - std::sin(0.4) * p.y, std::sin(0.4) * p.x + std::cos(0.4) * p.y, p.z};
    p = {p.x, std::cos(0.7) * p.y - std::sin(0.7) * p.z, std::sin(0.7) * p.y + std::cos(0.7) * p.z};
    if (height) p.z = 2 * *height - p.z;
  }
  return soup;
}

// The wave mirrored in the plane z = height; its path is the way by which it comes later than one through the origin.
LookVectors mirrored(LookVectors look) {
  const dvec3 mirror(1, 1, -1);
  look.incident *= mirror;
  for (dvec3& electric : look.electric) electric *= -mirror;
  for (dvec3& magnetic : look.magnetic) magnetic *= mirror;
  return look;
}

TEST(ReflectedEdges, AboveAMirrorIsThatOfTheImage) {
  // J of the body in the reflected wave is -R J of its image in the incident wave, and S(s) = -R S_image(Rs): V keeps its sign,
  // whose basis vector at Rs is -R that at s, and H changes it. Tolerance: rounding, of panels that are laid in another order.
  constexpr double height = -3.0;
  const Scene body(turned_box({})), image(turned_box(height));
  for (const Look& look : looks)
    for (const int order : {2, 3}) {
      const LookVectors vectors = look_vectors(look);
      const Direction below{pi - look.receive.theta, look.receive.phi};
      const EdgeLookResult wanted = image.direct({look.transmit, below}, order);
      const ReflectedLook light[] = {body.lit_by(mirrored(vectors), 2 * height * vectors.incident.z)};
      const EdgeLookResult found = body.reflected(light, order);
      const dvec3 change = vectors.scattered * dvec3(1, 1, -1) - vectors.incident;
      const double difference = 2 * height * vectors.scattered.z;
      for (std::size_t i = 0; i < std::size(frequencies); ++i) {
        const double k = wavenumber(frequencies[i]);
        const Complex phase = std::polar(1.0, k * (glm::dot(change, image.loaded.mesh.center) + difference));
        ScatteringMatrix expected = wanted.scattering[i] + wanted.higher[i];
        for (int transmit = 0; transmit < 2; ++transmit) expected.at(1, transmit) *= -1.0;
        expected *= phase;
        EXPECT_LE(largest_amplitude(found.scattering[i] + found.higher[i] - expected), 1e-10 * largest_amplitude(expected));
      }
    }
}

}  // namespace
}  // namespace raytube
