// What the thickness of a plate changes in the currents of a half plane: finite and continuous everywhere, nothing when thin.
#include <gtest/gtest.h>

#include "mesh/features/thin_plates.h"
#include "shapes.h"
#include "utd/multiple/thin_plate_edge.h"
#include "utd/shadow/edge_visibility.h"

namespace raytube {
namespace {

constexpr double k = 2 * pi;  // wavelength 1 m

/// A plate in y = 0, x < 0, its edge along z, both sides semi-infinite.
Wedge plate_edge(double thickness) {
  const dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  // t = x_f x n_f of the first side is -x x y = -z.
  return {0.5 * z, -0.5 * z, 2.0, {WedgeFace{0, -x, y, 1e30}, WedgeFace{1, -x, -y, 1e30}}, false, no_index, -thickness * y, 2};
}

/// S per length that the thickness adds, both sides and the edge face.
ScatteringMatrix change(const Wedge& wedge, const Look& look) {
  const LookVectors vectors = look_vectors(look);
  const WedgeIncidence incidence = incidence_on(wedge, vectors.incident);
  ScatteringMatrix sum = edge_face_amplitude(wedge, incidence, vectors, k);
  for (int side = 0; side < 2; ++side) {
    const WedgeFace& face = wedge.faces[side];
    const FaceIncidence& arriving = incidence.faces[side];
    const ThinPlateCorrection thin(wedge, side, arriving, grazing_half_cosine(face, arriving, vectors.scattered),
                                   vectors.scattered, true);
    sum += face_amplitude(thin.untruncated(k), face, arriving, vectors);
  }
  return sum;
}

double largest(const ScatteringMatrix& s) {
  return std::max({std::abs(s.vv()), std::abs(s.vh()), std::abs(s.hv()), std::abs(s.hh())});
}

double difference(const ScatteringMatrix& a, const ScatteringMatrix& b) {
  return std::max({std::abs(a.vv() - b.vv()), std::abs(a.vh() - b.vh()), std::abs(a.hv() - b.hv()), std::abs(a.hh() - b.hh())});
}

/// Directions on a grid with special ones on purpose: along the edge, along the plate, square to it, and next to these.
std::vector<Direction> directions() {
  std::vector<Direction> result;
  for (const double theta : {0.0, 1e-7, 1e-4, 0.1, 0.7, pi / 2 - 1e-7, pi / 2, 2.0, pi - 1e-3, pi})
    for (const double phi : {0.0, 1e-8, 1e-6, 1e-3, 0.4, pi / 2, 2.2, pi - 1e-6, pi - 1e-8, pi, -1e-8, -0.5, -pi / 2, -3.0})
      result.push_back({theta, phi});
  return result;
}

TEST(ThinPlateCorrection, IsBoundedInEveryDirection) {
  // In wavelengths. Of the order of t ln t with F(phi) at its largest, and no more than the half plane itself has off its poles.
  double worst = 0.0;
  for (const double thickness : {1e-6, 0.01, 0.099})
    for (const Direction& transmit : directions())
      for (const Direction& receive : directions())
        worst = std::max(worst, largest(change(plate_edge(thickness), {transmit, receive})));
  EXPECT_LE(worst, 1.0);
}

TEST(ThinPlateCorrection, VanishesWithTheThickness) {
  for (const Direction& transmit : directions())
    for (const Direction& receive : directions()) ASSERT_LE(largest(change(plate_edge(1e-9), {transmit, receive})), 1e-7);
}

TEST(ThinPlateCorrection, IsContinuousWhereThePolesCancel) {
  // The specular direction of the plate, and the one straight through it.
  for (const double source : {0.3, 1.2, pi / 2, 2.8})
    for (const double pole : {pi - source, source - pi}) {
      const auto at = [&](double offset) { return change(plate_edge(0.05), {{pi / 2, source}, {pi / 2, pole + offset}}); };
      for (const double offset : {1e-9, 1e-7, 9e-7, 1.1e-6, 3e-6}) EXPECT_LE(difference(at(offset), at(-offset)), 5e-6) << source;
      EXPECT_LE(difference(at(0.0), at(1e-5)), 2e-5) << source;
    }
}

TEST(ThinPlateCorrection, DoesNotDependOnTheSideItIsSeenFrom) {
  for (const double source : {0.3, 1.2, 2.8})
    for (const double observer : {-2.0, -0.4, 0.9, 3.0}) {
      const ScatteringMatrix above = change(plate_edge(0.05), {{1.0, source}, {1.3, observer}});
      const ScatteringMatrix below = change(plate_edge(0.05), {{1.0, -source}, {1.3, -observer}});
      EXPECT_LE(std::abs(above.vv() - below.vv()) + std::abs(above.hh() - below.hh()), 1e-14);
      EXPECT_LE(std::abs(above.vh() + below.vh()) + std::abs(above.hv() + below.hv()), 1e-14);
    }
}

TEST(ThinPlateCorrection, IsSeenFromBothSidesOfThePlate) {
  const LoadedMesh loaded = build_mesh(shapes::box({3, 2, 0.05}), 1.0);
  const std::vector<Wedge> sharp = find_wedges(loaded.mesh, 15.0 * degree);
  const std::vector<Wedge> wedges = merge_thin_plate_edges(sharp, find_thin_plate_edges(loaded.mesh, sharp), 0.1);
  const Tracer tracer(loaded.mesh);
  for (const double elevation : {-1.2, -0.01, -1e-5, 1e-5, 0.01, 1.2})
    for (const double azimuth : {0.3, 2.0}) {
      const dvec3 towards(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      EdgeVisibility visibility(wedges, tracer, towards, 1.0);
      for (std::uint32_t i = 0; i < wedges.size(); ++i) {
        if (wedges[i].thickness() == 0.0) continue;
        std::vector<LitInterval> lit;
        visibility.find(i, dvec3(0.0), lit);
        ASSERT_EQ(lit.size(), 1u);
        EXPECT_EQ(lit[0].end - lit[0].begin, 1.0);
      }
    }
}

}  // namespace
}  // namespace raytube
