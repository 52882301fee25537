// Features of targets that asymptotic physics has no waves for, and the estimates made of them.
#include <gtest/gtest.h>

#include "plan/target.h"
#include "shapes.h"
#include "uncertainty/omissions.h"

namespace raytube {
namespace {

constexpr double frequency_1m = speed_of_light;  // [Hz] wavelength 1 m
const Direction general{60.0 * degree, 33.0 * degree};

// A target with what is found of it.
struct Found {
  explicit Found(PolygonSoup soup, const EdgeCurrents& currents = {}, double wavelength = 1.0)
      : target(build_mesh(std::move(soup), 1.0).mesh),
        curved(find_curved_parts(target.mesh, target.options.min_wedge_angle)),
        edges(find_edge_features(target.wedges, curved, currents, wavelength)) {}

  LookFeatures look(const Direction& transmit, const Direction& receive, double frequency = frequency_1m) const {
    return find_look_features({target.mesh, curved, edges}, {transmit, receive}, frequency);
  }

  Target target;
  CurvedParts curved;
  EdgeFeatures edges;
};

double at(const OmissionErrors& errors, Omission omission, int p = 0, int q = 0) {
  return errors[static_cast<std::size_t>(omission)][p][q];
}

TEST(Uncertainty, CubeShowsSevenOfItsCorners) {
  const Found cube(shapes::cube(3.0));
  EXPECT_EQ(cube.edges.corners.size(), 8u);
  for (const SharpCorner& corner : cube.edges.corners)
    EXPECT_NEAR(corner.weight, 0.5, 1e-12);  // n - 1; edges turn by more than 1
  EXPECT_NEAR(cube.look(general, general).corners, 0.5 * std::sqrt(7.0), 1e-12);
  // Far below a wavelength it is the edges that bound what a corner can do.
  EXPECT_NEAR(cube.look(general, general, 0.01 * frequency_1m).corners, 3.0 * 0.5 * std::sqrt(7.0), 1e-12);
  // From behind a corner is lit for one antenna of two.
  const Direction opposite{pi - general.theta, general.phi + pi};
  EXPECT_NEAR(cube.look(general, opposite).corners, 0.5 * std::sqrt(7.0 / 2 + 7.0 / 2), 1e-12);
}

TEST(Uncertainty, EdgesOfARoundPlateHaveNoCorners) {
  std::vector<dvec2> outline;
  for (int i = 0; i < 72; ++i) outline.push_back({3.0 * std::cos(i * 5.0 * degree), 3.0 * std::sin(i * 5.0 * degree)});
  const Found disc(shapes::prism(outline, -1.0, 1.0));
  EXPECT_TRUE(disc.edges.corners.empty());
  EXPECT_EQ(Found(shapes::plate(3.0)).edges.corners.size(), 4u);
}

TEST(Uncertainty, EdgesWithoutCurrentsAddUpInPhase) {
  EXPECT_TRUE(Found(shapes::plate(3.0)).edges.edges.empty());
  const Found plate(shapes::plate(3.0), {.conductors = false});
  ASSERT_EQ(plate.edges.edges.size(), 4u);
  // At broadside all four are in phase along themselves; each is a run of its own.
  EXPECT_NEAR(plate.look({0.0, 0.0}, {0.0, 0.0}).edges, 2.0 * 3.0 / (2.0 * pi), 1e-12);
  // 30 degrees off, across two of them, those stay and the others have the phase of the look along them.
  const double along = 3.0 * sinc(2.0 * pi * 3.0 * std::sin(30.0 * degree));
  EXPECT_NEAR(plate.look({30.0 * degree, 0.0}, {30.0 * degree, 0.0}).edges,
              std::sqrt(2.0 * 9.0 + 2.0 * along * along) / (2.0 * pi), 1e-12);
}

TEST(Uncertainty, EdgesBesideCurvedFacesAreLessWeakWhereTheirCurrentsFollow) {
  const Found straight(shapes::cylinder(2.0, 6.0, 72)), followed(shapes::cylinder(2.0, 6.0, 72), {.over_curved = true});
  ASSERT_FALSE(straight.edges.edges.empty());
  ASSERT_EQ(straight.edges.edges.size(), followed.edges.edges.size());
  for (std::size_t i = 0; i < straight.edges.edges.size(); ++i)
    EXPECT_LT(followed.edges.edges[i].missing, straight.edges.edges[i].missing);
  EXPECT_EQ(curved_share(straight.edges.edges), 1.0);
  EXPECT_EQ(curved_share(Found(shapes::plate(3.0), {.conductors = false}).edges.edges), 0.0);
}

TEST(Uncertainty, EdgesBesideNarrowFacesAreWeak) {
  // A box of 4 x 4 x 0.3 wavelengths is no thin plate, but its narrow faces do not carry the currents of wedges.
  const Found box(shapes::box({4.0, 4.0, 0.3}));
  EXPECT_EQ(box.edges.edges.size(), 8u);  // the short ones stand between broad faces
  EXPECT_TRUE(Found(shapes::box({4.0, 4.0, 0.6})).edges.edges.empty());
}

TEST(Uncertainty, ShadowBoundaryOfASphereIsThatOfPhysicalOptics) {
  // Backscatter: the ring 2 pi a in phase, of which PO has 1 / (4ka) of a sharp edge's field (its closed form ends there with
  // lambda / 8 pi); 2 is added to 4ka. The boundary runs in zigzag over the facets, up to 4/3 of the ring's length.
  const Found sphere(shapes::icosphere(4, 3.0));
  const double ring = 3.0 / (4.0 * 2.0 * pi * 3.0 + 2.0);
  for (const Direction& look : {general, Direction{1.0, 2.0}}) {
    const LookFeatures features = sphere.look(look, look);
    EXPECT_GT(features.shadow_boundaries[0][0], 0.8 * ring);
    EXPECT_LT(features.shadow_boundaries[0][0], 1.4 * ring);
    EXPECT_EQ(features.corners, 0.0);
    EXPECT_EQ(features.edges, 0.0);
  }
}

TEST(Uncertainty, IsTheSameWithTransmitterAndReceiverExchanged) {
  const Direction other{100.0 * degree, 150.0 * degree};
  for (const PolygonSoup& soup : {shapes::cube(2.0), shapes::cylinder(1.0, 3.0, 48), shapes::icosphere(3, 2.0)}) {
    const Found found(soup, {.conductors = false});
    const LookFeatures one = found.look(general, other), back = found.look(other, general);
    // Sums of some hundred terms; phases of some ten radians.
    EXPECT_NEAR(one.corners, back.corners, 1e-12 * one.corners);
    EXPECT_NEAR(one.edges, back.edges, 1e-10 * (one.edges + 1.0));
    EXPECT_NEAR(one.rims, back.rims, 1e-10);
    EXPECT_NEAR(one.tight_curves, back.tight_curves, 1e-10);
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) EXPECT_NEAR(one.shadow_boundaries[p][q], back.shadow_boundaries[q][p], 1e-10);
  }
}

TEST(Uncertainty, PartsComeFromTheirOwnEvidence) {
  LookFeatures look;
  RowEvidence row{.wavelength = 1.0};
  const ChannelErrors nothing = root_sum_square(estimate_omissions(look, row));
  EXPECT_EQ(nothing, ChannelErrors{});

  row.truncated = 4.0 * pi * 0.09;  // sigma of an isotropic scatterer of that area is 4 pi S^2
  EXPECT_NEAR(at(estimate_omissions(look, row), Omission::cut_tubes), 0.3, 1e-15);

  row.higher.at(0, 0) = 2.0;
  const OmissionErrors orders = estimate_omissions(look, row);
  EXPECT_GT(at(orders, Omission::edge_orders), at(orders, Omission::edge_orders, 1, 1));
  EXPECT_GT(at(orders, Omission::edge_orders, 1, 1), 0.0);  // the other co-polar channel
  EXPECT_EQ(at(orders, Omission::edge_orders, 0, 1), 0.0);

  // A double bounce is less certain where edge-face interaction is not there to mend it.
  std::vector<ScatteringMatrix> bounces(2);
  bounces[1].at(1, 1) = 9.0;
  row.bounces = bounces;
  row.penumbras.of_edges = 0.5;
  EXPECT_NEAR(at(estimate_omissions(look, row), Omission::interaction, 1, 1), 4.5, 1e-15);
  const std::vector<double> met{100.0, 4.0 * pi * 12.0 * 12.0};  // sigma of what scatters evenly, S = 12
  row.met = met;
  EXPECT_NEAR(at(estimate_omissions(look, row), Omission::interaction, 1, 1), 0.5 * 15.0, 1e-14);
  row.has_interaction = true;
  EXPECT_EQ(at(estimate_omissions(look, row), Omission::interaction, 1, 1), 0.0);

  // Closed smooth surfaces have shadow boundaries in the place of edges.
  EXPECT_EQ(at(estimate_omissions(look, row), Omission::smooth_surfaces, 1, 1), 0.0);
  row.penumbras.of_smooth = 0.2;
  EXPECT_NEAR(at(estimate_omissions(look, row), Omission::smooth_surfaces, 1, 1), 0.2 * 15.0, 1e-14);

  row.inside.at(0, 0) = 3.0;
  row.left_solids = 4.0 * pi * 4.0;  // S = 2 evenly all around
  EXPECT_NEAR(at(estimate_omissions(look, row), Omission::focusing), 5.0, 1e-14);
  // All that meets a surface a second time was inside of shells: S = 9, and 12 evenly, of a half of the power.
  row.inside = {}, row.left_solids = 0.0, row.penumbras.shells = std::sqrt(0.5);
  EXPECT_NEAR(at(estimate_omissions(look, row), Omission::focusing, 1, 1), std::sqrt(0.5 * (81.0 + 4.0 * 144.0)), 1e-13);

  const OmissionErrors all = estimate_omissions(look, row);
  double squares = 0.0;
  for (const ChannelErrors& part : all) squares += part[0][0] * part[0][0];
  EXPECT_NEAR(root_sum_square(all)[0][0], std::sqrt(squares), 1e-15);
}

TEST(Uncertainty, FacesEndAtEdgesAndNotAtCreases) {
  const Found cube(shapes::cube(3.0)), sphere(shapes::icosphere(4, 2.0)), cylinder(shapes::cylinder(1.0, 3.0, 48));
  ASSERT_EQ(cube.curved.faces.size(), 6u);
  for (const FaceExtent& face : cube.curved.faces) EXPECT_NEAR(face.area, 9.0, 1e-12);
  ASSERT_EQ(sphere.curved.faces.size(), 1u);
  EXPECT_NEAR(sphere.curved.faces[0].area, 16.0 * pi, 0.005 * 16.0 * pi);  // chords of icosphere(4): 0.2 % less
  EXPECT_EQ(cylinder.curved.faces.size(), 3u);
  EXPECT_TRUE(std::ranges::all_of(cube.curved.faces, &FaceExtent::ends));
  EXPECT_TRUE(std::ranges::all_of(cylinder.curved.faces, &FaceExtent::ends));
  EXPECT_FALSE(sphere.curved.faces[0].ends);
}

TEST(Uncertainty, PenumbrasOfManyFacesAddUpAsSquares) {
  using Faces = std::vector<FaceExtent>;
  const auto of_edges = [](const Faces& faces) { return penumbra_shares(faces, 1.0).of_edges; };
  const FaceExtent face{16.0, true};
  EXPECT_NEAR(of_edges({face}), 0.5, 1e-15);           // (1/4)^{1/2}
  EXPECT_NEAR(of_edges(Faces(50, face)), 0.5, 1e-14);  // of sqrt(50) times the field of one
  EXPECT_EQ(of_edges({{0.5, true}}), 1.0);
  EXPECT_EQ(of_edges({}), 0.0);
  EXPECT_NEAR(of_edges({face, {16.0 / 81.0, true}}), std::sqrt((0.25 + 1.0 / 81.0) / (1.0 + 1.0 / 81.0)), 1e-15);
  const PenumbraShares beside_sphere = penumbra_shares(Faces{face, {16.0, false}}, 1.0);
  EXPECT_NEAR(beside_sphere.of_edges, std::sqrt(0.125), 1e-15);
  EXPECT_NEAR(beside_sphere.of_smooth, std::sqrt(0.125), 1e-15);
}

TEST(Uncertainty, TotalIsTheSumOfAllMechanisms) {
  std::vector<ScatteringMatrix> bounces(2);
  RowEvidence row{.bounces = bounces, .wavelength = 1.0};
  bounces[0].at(0, 0) = 1.0, bounces[1].at(0, 0) = 2.0;
  row.edges.at(0, 0) = 4.0, row.higher.at(0, 0) = 8.0, row.interaction.at(0, 0) = 16.0, row.surface_waves.at(0, 0) = 32.0;
  EXPECT_EQ(row.total().at(0, 0), Complex(63.0));
}

TEST(Uncertainty, OfASmallTargetIsManyDecibels) {
  RowEvidence row{.half_extent = 0.01, .wavelength = 1.0};
  row.edges.at(0, 0) = 0.01;  // edges take no notice that the whole is too small: Rayleigh has 4e-5
  EXPECT_GT(at(estimate_omissions({}, row), Omission::small_target) / 0.01, 200.0);
  row.half_extent = 3.0;
  EXPECT_LT(at(estimate_omissions({}, row), Omission::small_target) / 0.01, 1e-6);
}

TEST(Uncertainty, EveryPartHasItsWords) {
  for (std::size_t i = 0; i < omissions; ++i) {
    const OmissionText& text = text_of(static_cast<Omission>(i));
    EXPECT_FALSE(std::string(text.name).empty() || std::string(text.what).empty() || std::string(text.remedy).empty()) << i;
  }
}

}  // namespace
}  // namespace raytube
