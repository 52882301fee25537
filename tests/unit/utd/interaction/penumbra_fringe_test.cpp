// Fringe currents of rims that waves of other edges reach, against quadrature over these rims, point by point.
#include "utd/interaction/penumbra_fringe.h"

#include <gtest/gtest.h>

#include "run.h"
#include "unit/utd_scene.h"

namespace raytube {
namespace {

using testing::measured;

/// A half plane's edge along y on z = 0, x < 0, and a plate that stands beside it.
class EdgeAndRim {
 public:
  /// `rim`: its middle, `direction`: along it.
  explicit EdgeAndRim(const dvec3& rim = dvec3(1.5, 0.2, 0.8), const dvec3& direction = dvec3(0.2, 1, 0.1)) {
    const std::uint32_t own = test::add_panel(scene_.mesh, {-1, 0, 0}, {1, 0, 0}, {0, 2, 0});
    const dvec3 along = glm::normalize(direction), up = glm::normalize(glm::cross(dvec3(1, 0.3, 0), along));
    const std::uint32_t plate = test::add_panel(scene_.mesh, rim - 0.5 * up, 1.7 * along, 0.5 * up);
    scene_.wedges = {test::half_plane({0, -2, 0}, {0, 2, 0}, {-1, 0, 0}, {0, 0, 1}, 2.0, own),
                     test::half_plane(rim - 1.7 * along, rim + 1.7 * along, -up, glm::cross(along, -up), 1.0, plate)};
    for (const Wedge& wedge : scene_.wedges) {
      const dvec3 tangent = glm::cross(wedge.faces[0].into_face, wedge.faces[0].normal);
      const bool reversed = glm::dot(tangent, wedge.end - wedge.start) < 0.0;
      axes_.push_back({&wedge, reversed ? wedge.end : wedge.start, tangent, wedge.length(), {}});
    }
  }

  EdgeAndRim(const EdgeAndRim&) = delete;

  Wedge& wedge(std::size_t index) { return scene_.wedges[index]; }

  LitEdgePiece lit(const PlaneWave& wave) const {
    return {&axes_[0], &wave, incidence_on(scene_.wedges[0], wave.direction).faces[0], 0.5, 3.0, 0.7};
  }

  std::vector<ScatteringMatrix> fringe(const LookVectors& look, const PlaneWave& wave,
                                       std::span<const double> wavenumbers) const {
    const Tracer tracer(scene_.mesh);
    std::vector<ScatteringMatrix> sums(wavenumbers.size());
    PenumbraFringe(tracer, FaceTree(scene_.mesh), axes_, 0.0, look, wavenumbers).add(lit(wave), sums);
    return sums;
  }

  std::vector<ScatteringMatrix> step(const LookVectors& look, const PlaneWave& wave, std::span<const double> wavenumbers) const {
    const Tracer tracer(scene_.mesh);
    std::vector<ScatteringMatrix> sums(wavenumbers.size());
    PenumbraFringe(tracer, FaceTree(scene_.mesh), axes_, 0.0, look, wavenumbers).add_step(lit(wave), 1.0, sums);
    return sums;
  }

  /// S = sum over points of the amplitude of the rim for the field there, in a basis of its own.
  ScatteringMatrix by_points(const LookVectors& look, const PlaneWave& wave, double k, int points) const {
    const LitEdgePiece piece = lit(wave);
    const StraightEdge edge{axes_[0].origin, {-1, 0, 0}, {0, 0, 1}, 2.0, piece.from, piece.to};
    ScatteringMatrix sum;
    for (int i = 0; i < points; ++i) {
      const dvec3 place = axes_[1].origin + (i + 0.5) / points * axes_[1].length * axes_[1].tangent;
      const RaySource from{Spreading::plane, {}, wave.direction, {}};
      const dvec3 leaving = edge_ray(edge, from, place).leaving;
      LookVectors here = look;
      here.incident = leaving;
      here.electric[0] = glm::normalize(glm::cross(leaving, dvec3(0.3, -0.5, 0.8)));
      here.electric[1] = glm::cross(leaving, here.electric[0]);
      for (int c = 0; c < 2; ++c) here.magnetic[c] = glm::cross(leaving, here.electric[c]);
      bool windowed = false;
      const ScatteringMatrix amplitude =
          amplitude_at(edge_amplitude(scene_.wedges[1], incidence_on(scene_.wedges[1], leaving), here), k, windowed);
      const Complex phase =
          std::polar(piece.weight * axes_[1].length / points, k * (glm::dot(look.scattered, place) - wave.path));
      for (int q = 0; q < 2; ++q) {
        RaySource source = from;
        source.moment = {wave.electric[q], dvec3(0.0)};
        const ComplexVector field = diffracted_field(edge, source, place, k);
        for (int p = 0; p < 2; ++p)
          for (int c = 0; c < 2; ++c) sum.at(p, q) += phase * amplitude.at(p, c) * dot(field, here.electric[c]);
      }
    }
    return sum;
  }

 private:
  test::Scene scene_;
  std::vector<EdgeAxis> axes_;
};

// The midpoint rule of 4000 points is good to 1e-6; 8 points of Filon's rule on panels that grow fourfold leave 1e-5.
TEST(PenumbraFringe, IsTheIntegralAlongTheRim) {
  const EdgeAndRim scene;
  double error = 0.0, size = 0.0;
  for (const double phi : {10.0, 70.0, 155.0, 230.0}) {
    const Look view{{50 * degree, 40 * degree}, {65 * degree, phi * degree}};
    const LookVectors look = look_vectors(view);
    const PlaneWave wave{look.incident, look.electric, 0.37};
    const double wavenumbers[] = {2 * pi, 1.3 * pi};
    const std::vector<ScatteringMatrix> sums = scene.fringe(look, wave, wavenumbers);
    for (int f = 0; f < 2; ++f) {
      const ScatteringMatrix expected = scene.by_points(look, wave, wavenumbers[f], 4000);
      error = std::max(error, largest_amplitude(sums[f] - expected));
      size = std::max(size, largest_amplitude(expected));
    }
  }
  measured("fringe of a rim, largest S", size, "m at a wavelength of 1 m");
  measured("fringe of a rim, error", error / size, "of it");
  EXPECT_GT(size, 0.003);
  EXPECT_LT(error, 1e-4 * size);
}

// Two wavenumbers alone are evaluated directly, on the same panels if the higher one is the same.
TEST(PenumbraFringe, ABandIsDirectEvaluation) {
  const EdgeAndRim scene;
  std::vector<double> wavenumbers;
  for (int i = 0; i <= 100; ++i) wavenumbers.push_back(2 * pi * (20 + 0.02 * i));
  double error = 0.0, size = 0.0;
  for (const double phi : {10.0, 70.0, 155.0, 230.0}) {
    const LookVectors look = look_vectors({{50 * degree, 40 * degree}, {65 * degree, phi * degree}});
    const PlaneWave wave{look.incident, look.electric, 0.37};
    const std::vector<ScatteringMatrix> sums = scene.fringe(look, wave, wavenumbers);
    for (std::size_t f = 0; f < wavenumbers.size(); f += 9) {
      const double two[] = {wavenumbers[f], wavenumbers.back()};
      const ScatteringMatrix direct = scene.fringe(look, wave, two)[0];
      error = std::max(error, largest_amplitude(sums[f] - direct));
      size = std::max(size, largest_amplitude(direct));
    }
  }
  measured("fringe of a rim, a band from few wavenumbers", error / size, "of it");
  EXPECT_LT(error, 1e-5 * size);  // nodes leave 1e-7 of all magnitudes, of which most cancel along the rim
}

// A rim that stands across the half plane at the height of its edge: boundaries cut it, and between 54 and 58 degrees the ray
// comes from the end of the lit piece close to one of them. The midpoint rule leaves jump / points: 2e-3 at 4000, less than 5e-4
// at 32000.
TEST(PenumbraFringe, JumpsWithinTheRimEndPanels) {
  EdgeAndRim scene(dvec3(1.2, 0.2, 0.0), dvec3(0.1, 0.4, 1));
  double error = 0.0, size = 0.0;
  for (double theta = 40; theta < 75; theta += 3.9) {
    const LookVectors look = look_vectors({{theta * degree, 160 * degree}, {65 * degree, 70 * degree}});
    const PlaneWave wave{look.incident, look.electric, 0.37};
    const double wavenumbers[] = {2 * pi};
    const ScatteringMatrix expected = scene.by_points(look, wave, wavenumbers[0], 32000);
    error = std::max(error, largest_amplitude(scene.fringe(look, wave, wavenumbers)[0] - expected));
    size = std::max(size, largest_amplitude(expected));
  }
  measured("fringe of a rim across boundaries, error", error / size, "of the largest");
  EXPECT_GT(size, 0.003);
  EXPECT_LT(error, 1e-3 * size);
}

// The planes of faces that are folded flat on one another may leave more than a half plane between them.
TEST(PenumbraFringe, FacesMayCrossByRounding) {
  EdgeAndRim flat, folded;
  folded.wedge(0).n = 2.0 + 7e-6;
  const LookVectors look = look_vectors({{50 * degree, 40 * degree}, {65 * degree, 10 * degree}});
  const PlaneWave wave{look.incident, look.electric, 0.37};
  const double wavenumbers[] = {2 * pi};
  const ScatteringMatrix expected = flat.fringe(look, wave, wavenumbers)[0];
  // n of the edge is 2 in both; elsewhere it stands for an angle of 2e-5.
  EXPECT_LE(largest_amplitude(folded.fringe(look, wave, wavenumbers)[0] - expected), 1e-4 * largest_amplitude(expected));
}

// One of two wedges that the wave sees as one has half of the current, and half of the wave.
TEST(PenumbraFringe, SharesCountOnce) {
  EdgeAndRim whole, half_of_wave, half_of_rim;
  half_of_wave.wedge(0).share = half_of_rim.wedge(1).share = 0.5;
  const LookVectors look = look_vectors({{50 * degree, 40 * degree}, {65 * degree, 10 * degree}});
  const PlaneWave wave{look.incident, look.electric, 0.37};
  const double wavenumbers[] = {2 * pi};
  const ScatteringMatrix all = whole.fringe(look, wave, wavenumbers)[0], all_of_step = whole.step(look, wave, wavenumbers)[0];
  EXPECT_GT(largest_amplitude(all_of_step), 0.003);
  const auto is_half = [](ScatteringMatrix part, const ScatteringMatrix& of) {
    EXPECT_LT(largest_amplitude((part *= 2.0) - of), 1e-14 * largest_amplitude(of));
  };
  is_half(half_of_wave.fringe(look, wave, wavenumbers)[0], all);
  is_half(half_of_rim.fringe(look, wave, wavenumbers)[0], all);
  is_half(half_of_wave.step(look, wave, wavenumbers)[0], all_of_step);
}

// The strips of a face are what its own rims have of the waves of one another.
TEST(PenumbraFringe, OwnFacesHaveNone) {
  test::Scene plate = test::plate(3.0, 3.0);
  std::vector<EdgeAxis> axes;
  for (const Wedge& wedge : plate.wedges)
    axes.push_back({&wedge, wedge.start, glm::normalize(wedge.end - wedge.start), wedge.length(), {}});
  const LookVectors look = look_vectors({{50 * degree, 40 * degree}, {65 * degree, 10 * degree}});
  const PlaneWave wave{look.incident, look.electric, 0.0};
  const double wavenumbers[] = {2 * pi};
  const Tracer tracer(plate.mesh);
  const FaceTree faces(plate.mesh);
  std::vector<ScatteringMatrix> sums(1);
  PenumbraFringe penumbra(tracer, faces, axes, 0.0, look, wavenumbers);
  penumbra.add({&axes[0], &wave, incidence_on(plate.wedges[0], look.incident).faces[0], 0.0, 3.0, 1.0}, sums);
  EXPECT_EQ(largest_amplitude(sums[0]), 0.0);
  EXPECT_EQ(penumbra.work(), 0.0);
}

}  // namespace
}  // namespace raytube
