// Edge-face interaction of many frequencies from a few wavenumbers, against direct evaluation.
#include <gtest/gtest.h>

#include "interaction_bodies.h"
#include "utd/interaction/illuminated_faces.h"
#include "utd/interaction/interaction_groups.h"

namespace raytube::testing::interaction {
namespace {

std::vector<double> band_about(double middle, double width, int count) {
  std::vector<double> wavenumbers;
  for (int i = 0; i < count; ++i)
    wavenumbers.push_back(wavenumber(middle * (1 + width * (static_cast<double>(i) / (count - 1) - 0.5))));
  return wavenumbers;
}

struct Compared {
  double size = 0.0, error = 0.0;  // largest of S, and of what the band differs from direct evaluation [m]
};

/// Of all edges by direct light, at every 25th wavenumber. Two wavenumbers alone are evaluated directly; the higher one keeps
/// what hangs on the shortest wavelength the same.
Compared compare(const PolygonSoup& soup, const Look& look, const std::vector<double>& wavenumbers, double tolerance) {
  const Target target(build_mesh(soup, 1.0).mesh);
  const LookVectors vectors = look_vectors(look);
  const PlaneWave wave{vectors.incident, vectors.electric, 0.0};
  const InteractionParts parts(target.mesh, target.wedges, {}, 1.0);
  const std::vector<bool> large(target.mesh.patches.size(), true);
  const ReceivingFaces faces{target.faces, large, parts.corners};
  Compared result;
  for (const EdgeAxis& axis : parts.axes) {
    const WedgeIncidence incidence = incidence_on(*axis.wedge, vectors.incident);
    const double weight = incidence_weight(*axis.wedge, incidence);
    if (weight == 0.0) continue;
    const LitEdgePiece piece{&axis, &wave, incidence.faces[0], 0.2 * axis.length, axis.length, weight};
    const IlluminationLimits limits{1, tolerance};
    const IlluminatedFaces all = illuminated_faces(faces, vectors, wavenumbers, piece, limits);
    for (std::size_t f = 0; f < wavenumbers.size(); f += 25) {
      const std::vector<double> two{wavenumbers[f], wavenumbers.back()};
      const IlluminatedFaces direct = illuminated_faces(faces, vectors, two, piece, limits);
      result.size = std::max(result.size, largest_amplitude(direct.scattering[0]));
      result.error = std::max(result.error, largest_amplitude(all.scattering[f] - direct.scattering[0]));
    }
  }
  return result;
}

// Eight points leave 1e-4 of a wave; what few wavenumbers leave is less than a tenth of it.
TEST(InteractionBand, IsDirectEvaluation) {
  const double tolerance = 1e-5 * lambda;
  const std::vector<double> wavenumbers = band_about(frequency, 0.1, 101);
  const Look look{{70 * degree, 25 * degree}, {100 * degree, 50 * degree}};
  for (const PolygonSoup& soup : {square_trihedral(20 * lambda), cube_on_block(12 * lambda, lambda, 5 * lambda)}) {
    const Compared found = compare(soup, look, wavenumbers, tolerance);
    measured("a band from few wavenumbers", found.error / found.size, "of the largest S");
    EXPECT_LT(found.error, 1e-5 * found.size + tolerance);
    EXPECT_GT(found.size, 100 * tolerance);
  }
}

}  // namespace
}  // namespace raytube::testing::interaction
