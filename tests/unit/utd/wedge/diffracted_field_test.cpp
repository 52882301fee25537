#include <gtest/gtest.h>

#include <random>

#include "core/error.h"
#include "utd/wedge/diffracted_field.h"
#include "utd/wedge/wedge_coefficients.h"

namespace raytube {
namespace {

constexpr double k = 2 * pi;
const dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);

StraightEdge wedge(double n, double begin, double end) { return {dvec3(0.0), x, y, n, begin, end}; }

dvec3 point_at(double rho, double angle, double along) { return {rho * std::cos(angle), rho * std::sin(angle), along}; }

RaySource point_source(const dvec3& at) { return {Spreading::point, at, z, {{0.3, -1.2, 0.7}, {0.9, 0.4, -0.5}}}; }

TEST(DiffractedField, RayIsTheShortestWayOverTheEdge) {
  const StraightEdge edge{{1, 2, 3}, x, y, 1.5};
  const dvec3 source(4, 7, -2), observer(-3, 5, 6);
  const EdgeRay ray = edge_ray(edge, point_source(source), observer);
  const auto way = [&](double along) {
    const dvec3 q = edge.origin + along * z;
    return glm::length(source - q) + glm::length(observer - q);
  };
  EXPECT_NEAR(ray.path, way(ray.arc_length), 1e-13);
  // Fermat: a step of 1e-4 to either side makes it longer, by the same to third order.
  EXPECT_GT(way(ray.arc_length + 1e-4) - way(ray.arc_length), 1e-10);
  EXPECT_NEAR(way(ray.arc_length + 1e-4), way(ray.arc_length - 1e-4), 1e-12);
  EXPECT_LE(glm::length(ray.arriving - glm::normalize(ray.point - source)), 1e-14);
  EXPECT_LE(glm::length(ray.leaving - glm::normalize(observer - ray.point)), 1e-14);
}

TEST(DiffractedField, IsTheCoefficientWithItsDistanceParameterAndSpreading) {
  // D A e^{-jks} E_i of Kouyoumjian and Pathak (1974), spherical wave: L = s s' sin^2 / (s + s'), A = sqrt(s' / (s (s + s'))).
  const StraightEdge edge = wedge(1.5, -INFINITY, INFINITY);
  const dvec3 from = point_at(3, 0.7, -2), to = point_at(5, 4.0, 3);
  const EdgeRay ray = edge_ray(edge, point_source(from), to);
  const double before = glm::length(ray.point - from), after = glm::length(to - ray.point), sine = 8 / std::hypot(8, 5);
  const double parameter = before * after * sine * sine / (before + after),
               spread = std::sqrt(before / (after * (before + after)));
  const WedgeCoefficients d = wedge_coefficients({1.5, 0.7, 4.0, sine, parameter}, k);
  const Complex incident = std::polar(1 / before, -k * before), wave = std::polar(spread, -k * after);
  EXPECT_LE(std::abs(diffracted_wave(edge, ray, k).soft - d.soft * wave * incident), 1e-14);
  EXPECT_LE(std::abs(diffracted_wave(edge, ray, k).hard - d.hard * wave * incident), 1e-14);
}

TEST(DiffractedField, LongWayOverAnEndIsFoundWithoutCancellation) {
  const StraightEdge edge = wedge(2.0, -1.5, 2.5);
  const dvec3 from = point_at(3, 0.7, -2), to = point_at(5, 4.0, 3);
  const EdgeRay ray = edge_ray(edge, point_source(from), to);
  for (const int end : {0, 1}) {
    const dvec3 corner = (end == 0 ? edge.begin : edge.end) * z;
    EXPECT_NEAR(ray.detours[end], glm::length(from - corner) + glm::length(to - corner) - ray.path, 1e-14);
  }
  // From afar the difference itself is lost in rounding, 2e-9 m here; the closed form is (step sin)^2 / 2 (1/s + 1/s').
  const EdgeRay far = edge_ray(wedge(2.0, -1e-3, 1e-3), point_source(point_at(1e7, 0.7, 0)), point_at(1e7, 2.0, 0));
  EXPECT_NEAR(far.detours[0] / 1e-13, 1.0, 1e-12);
}

// Observers on a line along which the diffraction point runs over the end of the edge at 0.
struct Crossing {
  StraightEdge edge;
  RaySource source;
  double rho, angle;
  double source_rho, source_along;

  ComplexVector at(double diffraction_point) const {
    const double slope = (diffraction_point - source_along) / source_rho;
    return diffracted_field(edge, source, point_at(rho, angle, diffraction_point + rho * slope), k);
  }
};

TEST(DiffractedField, DoesNotJumpWhereTheDiffractionPointLeavesTheEdge) {
  for (const double n : {2.0, 1.5, 1.25})
    for (const double angle : {0.3, 2.0, 0.9 * n * pi})
      for (const bool start : {true, false}) {
        const Crossing c{start ? wedge(n, 0, 9) : wedge(n, -9, 0), point_source(point_at(4, 0.8, 2)), 6, angle, 4, 2};
        const double size = norm(c.at(start ? 1.0 : -1.0));
        for (const double step : {1e-6, 1e-9})
          // It changes by about k and by 1/sqrt(lambda L) a metre; a cut edge would lose all of it.
          EXPECT_LE(norm(c.at(step) - c.at(-step)), 40 * step * size) << n << ' ' << angle;
        // The slope is the same on both sides, to the curvature over 1e-4.
        const ComplexVector before = c.at(-1e-4) - c.at(0.0), after = c.at(0.0) - c.at(1e-4);
        EXPECT_LE(norm(before - after), 0.05 * norm(after)) << n << ' ' << angle;
      }
}

TEST(DiffractedField, FadesBeyondTheEndAndIsWholeFarInside) {
  const RaySource source = point_source(point_at(400, 0.8, 0));
  const dvec3 observer = point_at(600, 2.9, 0);
  const double whole = norm(diffracted_field(wedge(1.5, -INFINITY, INFINITY), source, observer, k));
  const auto share = [&](double begin) {
    return norm(diffracted_field(wedge(1.5, begin, INFINITY), source, observer, k)) / whole;
  };
  // |G| falls as 1 / (2 sqrt(pi) x) and x = step sqrt(k (1/s + 1/s') / 2) = 0.114 step, times a share below 1.
  EXPECT_LE(share(1000.0), 0.0025);
  EXPECT_NEAR(share(-1000.0), 1.0, 0.0025);
  EXPECT_NEAR(share(0.0), 0.5, 1e-12);  // half an edge, seen from straight across its end
}

TEST(DiffractedField, PiecesOfAnEdgeAddUpToTheWhole) {
  // What one piece loses at the cut the other one has: H of the one end is 1 - H of the other.
  const RaySource source = point_source(point_at(4, 0.8, 2));
  for (const double cut : {-0.5, 0.3, 1.9}) {
    const dvec3 observer = point_at(6, 3.0, -3);
    const ComplexVector whole = diffracted_field(wedge(1.5, -1, 2), source, observer, k);
    const ComplexVector first = diffracted_field(wedge(1.5, -1, cut), source, observer, k);
    const ComplexVector second = diffracted_field(wedge(1.5, cut, 2), source, observer, k);
    EXPECT_LE(norm(first + second - whole), 1e-13 * norm(whole));
    EXPECT_GT(std::min(norm(first), norm(second)), 1e-3 * norm(whole));
  }
}

dvec3 turned(const dvec3& v) {
  const dvec3 axis = glm::normalize(dvec3(1, -2, 0.5));
  return std::cos(1.1) * v + std::sin(1.1) * glm::cross(axis, v) + (1 - std::cos(1.1)) * glm::dot(axis, v) * axis;
}

TEST(DiffractedField, TurnsWithTheScene) {
  const dvec3 shift(3, -1, 2);
  const RaySource source = point_source(point_at(4, 0.8, 2));
  const dvec3 observer = point_at(6, 3.0, -3);
  const StraightEdge edge = wedge(1.5, -1, 2);
  const StraightEdge moved{turned(edge.origin) + shift, turned(x), turned(y), 1.5, -1, 2};
  const RaySource moved_source{
      Spreading::point, turned(source.position) + shift, z, {turned(source.moment.re), turned(source.moment.im)}};
  const ComplexVector field = diffracted_field(edge, source, observer, k);
  const ComplexVector found = diffracted_field(moved, moved_source, turned(observer) + shift, k);
  // Phases of k path = 80 turn by rounding of the points, 1e-15 each.
  EXPECT_LE(norm(found - ComplexVector{turned(field.re), turned(field.im)}), 1e-12 * norm(field));
}

TEST(DiffractedField, IsTheSameWithSourceAndObserverSwapped) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> share(0.02, 0.98), along(-4, 4), distance(0.5, 8);
  const ComplexVector receive{{0.2, 0.5, -0.8}, {-0.7, 0.1, 0.6}};
  const auto product = [](const ComplexVector& a, const ComplexVector& b) { return dot(a, b.re) + Complex(0, 1) * dot(a, b.im); };
  for (const double n : {2.0, 1.5, 0.75})
    for (int i = 0; i < 20; ++i) {
      const RaySource there = point_source(point_at(distance(random), share(random) * n * pi, along(random)));
      const RaySource back{Spreading::point, point_at(distance(random), share(random) * n * pi, along(random)), z, receive};
      const StraightEdge edge = wedge(n, -1, 2);
      const Complex one = product(diffracted_field(edge, there, back.position, k), receive);
      const Complex other = product(diffracted_field(edge, back, there.position, k), there.moment);
      EXPECT_LE(std::abs(one - other), 1e-12 * (std::abs(one) + 1e-3)) << n;  // rounding of phases up to k path = 100
    }
}

TEST(DiffractedField, OfAFarSourceIsThatOfAPlaneWave) {
  const dvec3 towards = glm::normalize(dvec3(1, 2, -0.5)), observer = point_at(6, 3.0, -3);
  const StraightEdge edge = wedge(1.5, -1, 2);
  const ComplexVector moment{{0.3, -1.2, 0.7}, {0.9, 0.4, -0.5}};
  const ComplexVector plane = diffracted_field(edge, {Spreading::plane, dvec3(0.0), -towards, moment}, observer, k);
  double before = 0.0;
  for (const double range : {1e4, 1e5, 1e6}) {
    const RaySource far{Spreading::point, range * towards, z, std::polar(range, k * range) * moment};
    const double difference = norm(diffracted_field(edge, far, observer, k) - plane) / norm(plane);
    // The wave front is bent by k (extent)^2 / (2 range), extent about 8 m: first order in 1/range.
    EXPECT_LE(difference, 200 / range);
    EXPECT_NEAR(before == 0.0 ? 0.1 : difference / before, 0.1, 0.01);
    before = difference;
  }
}

TEST(DiffractedField, OfALineSourceGoesOverToAPlaneWaveToo) {
  const dvec3 towards = point_at(1, 1.2, 0), observer = point_at(6, 3.0, 1);
  const StraightEdge edge = wedge(1.75, -1, 2);
  const ComplexVector moment{{0.3, -1.2, 0.7}, {0.9, 0.4, -0.5}};
  const ComplexVector plane = diffracted_field(edge, {Spreading::plane, dvec3(0.0), -towards, moment}, observer, k);
  const RaySource far{Spreading::line, 1e6 * towards, z, std::polar(1e3, k * 1e6) * moment};
  EXPECT_LE(norm(diffracted_field(edge, far, observer, k) - plane), 1e-5 * norm(plane));  // rho / rho' and rounding of k rho'
}

TEST(DiffractedField, OfAMeshEdgeRunsFromItsStart) {
  const Wedge mesh_wedge{{0, 0, -1}, {0, 0, 2}, 1.5, {WedgeFace{0, x, y, 1.0}, WedgeFace{1, -y, -x, 1.0}}};
  const RaySource source = point_source(point_at(4, 0.8, 2));
  const ComplexVector whole = diffracted_field(wedge(1.5, -1, 2), source, point_at(6, 3.0, -3), k);
  EXPECT_LE(norm(diffracted_field(straight_edge(mesh_wedge), source, point_at(6, 3.0, -3), k) - whole), 1e-13 * norm(whole));
}

TEST(DiffractedField, RefusesWhatHasNoRay) {
  const StraightEdge edge = wedge(1.5, -1, 2);
  const RaySource good = point_source(point_at(4, 0.8, 2));
  const dvec3 observer = point_at(6, 3.0, -3), on_edge(0, 0, 5), in_metal = point_at(2, 1.75 * pi, 0);
  EXPECT_NO_THROW(diffracted_field(edge, good, observer, k));
  EXPECT_THROW(diffracted_field(edge, good, on_edge, k), InputError);
  EXPECT_THROW(diffracted_field(edge, good, in_metal, k), InputError);
  EXPECT_THROW(diffracted_field(edge, point_source(on_edge), observer, k), InputError);
  EXPECT_THROW(diffracted_field(edge, point_source(in_metal), observer, k), InputError);
  EXPECT_THROW(diffracted_field(edge, {Spreading::plane, dvec3(0.0), z, good.moment}, observer, k), InputError);
  EXPECT_THROW(diffracted_field(edge, {Spreading::line, {3, 3, 0}, x, good.moment}, observer, k), InputError);
  EXPECT_THROW(diffracted_field(wedge(2.5, -1, 2), good, observer, k), InputError);
  EXPECT_THROW(diffracted_field(wedge(1.5, 2, 2), good, observer, k), InputError);
  EXPECT_THROW(diffracted_field(edge, good, observer, 0.0), InputError);
  EXPECT_FALSE(has_edge_ray(edge, good, in_metal));
  EXPECT_TRUE(has_edge_ray(edge, good, observer));
}

}  // namespace
}  // namespace raytube
