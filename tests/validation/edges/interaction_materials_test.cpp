// Edge-face interaction on targets of several materials.
#include <gtest/gtest.h>

#include "interaction_bodies.h"
#include "mesh/load.h"
#include "validation/material_scene.h"
#include "validation/point_waves.h"

namespace raytube {
namespace {

using namespace raytube::testing::interaction;
using material_scene::half_space;
using material_scene::layered;

// A trihedral with walls of two wavelengths, and what edge-face interaction adds to it. The wall on x = 0 is of the first
// material unless there is none.
struct Corner {
  std::vector<Material> materials{};
  PolygonSoup soup = square_trihedral(2.0 * lambda);

  std::vector<ScatteringMatrix> interaction(const std::vector<Look>& looks) const {
    PolygonSoup made = soup;
    if (!materials.empty() && made.materials.empty()) made.materials = {no_index, 0, no_index};
    const LoadedMesh loaded = build_mesh(made, 1.0, "test", materials);
    SolveOptions options = adaptive(true);
    options.keep_parts = true;
    Sweep sweep{{frequency}, looks, false};
    sweep.materials = materials;
    return solve(Target(loaded.mesh), sweep, options).of("interaction");
  }
};

std::vector<Look> looks_at(double range = std::numeric_limits<double>::infinity()) {
  std::vector<Look> looks;
  for (const Direction& direction : {Direction{62 * degree, 20 * degree}, Direction{48 * degree, 55 * degree}})
    looks.push_back(std::isfinite(range) ? point_waves::near_look(direction, range) : Look{direction, direction});
  return looks;
}

double difference(const std::vector<ScatteringMatrix>& found, const std::vector<ScatteringMatrix>& wanted) {
  double apart = 0.0, size = 0.0;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    apart = std::max(apart, frobenius_norm(found[i] - wanted[i])), size = std::max(size, frobenius_norm(wanted[i]));
  return apart / size;
}

// Behind a wall, and too small for waves of edges to count on it: a coated patch leaves the interaction of all others as it is,
// but for where quadrature over azimuths begins anew (its corners): 1.5e-4.
TEST(InteractionMaterials, APatchElsewhereChangesNothing) {
  const Corner bare;
  Corner patched{{layered(MaterialKind::coated, {{{{4.0, -0.1}, 1.0}, 0.003}})}};
  const auto first = static_cast<std::uint32_t>(patched.soup.points.size());
  for (const dvec2 at : {dvec2(0.5, 0.5), dvec2(1.3, 0.5), dvec2(1.3, 1.3), dvec2(0.5, 1.3)})
    patched.soup.points.emplace_back(-0.2 * lambda, at.x * lambda, at.y * lambda);
  patched.soup.polygons.push_back({first, first + 1, first + 2, first + 3});
  patched.soup.materials = {no_index, no_index, no_index, 0};
  EXPECT_LT(difference(patched.interaction(looks_at()), bare.interaction(looks_at())), 5e-4);
}

// Whatever is as good as a conductor: a half-space, a coat of no thickness. Rounding of phases in the coat.
TEST(InteractionMaterials, LimitOfAConductor) {
  const Corner metal{{layered(MaterialKind::coated, {})}};
  const Corner dense{{half_space({-1e24, -1e24})}}, coat{{layered(MaterialKind::coated, {{{{4.0, -0.1}, 1.0}, 1e-13}})}};
  for (const double range : {std::numeric_limits<double>::infinity(), 40.0 * lambda}) {
    const std::vector<ScatteringMatrix> wanted = metal.interaction(looks_at(range));
    EXPECT_GT(frobenius_norm(wanted[0]), 0.05 * lambda);
    EXPECT_LT(difference(dense.interaction(looks_at(range)), wanted), 1e-8) << range;
    EXPECT_LT(difference(coat.interaction(looks_at(range)), wanted), 1e-8) << range;
  }
}

// A wall of nothing takes waves away as an absorber does.
TEST(InteractionMaterials, LimitOfNothing) {
  const Corner vacuum{{half_space(1.0)}}, black{{{"absorber", MaterialKind::absorber, 0.0, {}}}};
  EXPECT_LT(difference(vacuum.interaction(looks_at()), black.interaction(looks_at())), 1e-9);
}

// Spherical waves of 10^4 far-field distances on glass: 1.6 over that distance in units of D^2 / wavelength, as on conductors
// (near_interaction_test).
TEST(InteractionMaterials, FarLimit) {
  const Corner glass{{half_space({4.0, -0.5})}};
  EXPECT_LT(difference(glass.interaction(looks_at(1e4 * 16.0 * lambda)), glass.interaction(looks_at())), 2e-4);
}

// Many frequencies are each by itself: nothing is interpolated between those of media that change with it.
TEST(InteractionMaterials, EveryFrequencyHasItsOwnCoefficients) {
  Material media = half_space({4.0, -0.5});
  media.layers.push_back({{{{6.0, -0.1}, 1.0}, 0.0}});
  PolygonSoup soup = square_trihedral(2.0 * lambda);
  soup.materials = {no_index, 0, no_index};
  const auto at = [&](std::vector<double> frequencies, std::vector<std::size_t> indices) {
    Sweep sweep{std::move(frequencies), {looks_at()[0]}, false};
    sweep.materials = at_frequencies({media}, indices);
    const LoadedMesh loaded = build_mesh(soup, 1.0, "test", sweep.materials);
    SolveOptions options = adaptive(true);
    options.keep_parts = true;
    return solve(Target(loaded.mesh), sweep, options).of("interaction");
  };
  const auto both = at({frequency, 1.1 * frequency}, {0, 1});
  EXPECT_LT(difference({both[0]}, at({frequency}, {0})), 1e-4);  // panels of quadrature differ
  EXPECT_LT(difference({both[1]}, at({1.1 * frequency}, {1})), 1e-4);
}

}  // namespace
}  // namespace raytube
