// Tubes that go to and fro between sheets: what the estimate says of truncated ones, and many frequencies of them.
#include "sbr/beams/truncated_tubes.h"

#include <gtest/gtest.h>

#include "validation/material_scene.h"
#include "scene/frequency_bands.h"

namespace raytube {

using namespace material_scene;

namespace {

const Material glass = layered(MaterialKind::sheet, {{{{6.0, -0.05}}, 4e-3}});

SweepResult solved(const PolygonSoup& soup, const Material& material, const std::vector<double>& frequencies,
                   const std::vector<Look>& looks, const TubeOptions& tubes) {
  const LoadedMesh loaded = build_mesh(soup, 1.0, "test", std::span(&material, 1));
  SolveOptions options{tubes, {}, 1, false, {}};
  options.edges.method = EdgeMethod::none;
  return solve(Target(loaded.mesh), {frequencies, looks, false, {}, {material}}, options);
}

PolygonSoup hollow_box() {
  PolygonSoup soup = shapes::cube(20.0 / 3.0 * lambda);
  soup.materials.assign(soup.polygons.size(), 0);
  return soup;
}

std::vector<Look> looks_aslant() {
  std::vector<Look> looks;
  for (double phi = 0.0; phi <= 45.0; phi += 5.0) looks.push_back({deg(70.0, phi), deg(70.0, phi)});
  return looks;
}

// Wherever its faces are looked at tubes double.
PolygonSoup dihedral_in_a_box() {
  PolygonSoup soup = hollow_box();
  const auto first = static_cast<std::uint32_t>(soup.points.size());
  const PolygonSoup inside = shapes::dihedral(2.0 * lambda, 3.0 * lambda);
  soup.points.insert(soup.points.end(), inside.points.begin(), inside.points.end());
  for (const std::vector<std::uint32_t>& t : inside.polygons) soup.polygons.push_back({t[0] + first, t[1] + first, t[2] + first});
  soup.materials.resize(soup.polygons.size(), no_index);
  return soup;
}

// True over estimated errors of co-polarised rows, in order; so many bounces stand for all of them.
std::vector<double> error_ratios(const PolygonSoup& soup, int bounces, int all_bounces) {
  const auto after = [&](int most) {
    TubeOptions tubes;
    tubes.max_bounces = most;
    return solved(soup, glass, {frequency}, looks_aslant(), tubes);
  };
  const SweepResult truncated = after(bounces), all = after(all_bounces);
  std::vector<double> ratios;
  for (std::size_t i = 0; i < all.total.size(); ++i)
    for (int p = 0; p < 2; ++p)
      ratios.push_back(std::abs(truncated.total[i].at(p, p) - all.total[i].at(p, p)) / truncated.error[i][p][p]);
  std::ranges::sort(ratios);
  return ratios;
}

// An extrapolation: right in the order of magnitude, and not too small in two rows of three.
void expect_fair(const std::vector<double>& ratios, double least_median) {
  EXPECT_LT(ratios.back(), 4.0);
  EXPECT_LT(ratios[2 * ratios.size() / 3], 1.0);
  EXPECT_GT(ratios[ratios.size() / 2], least_median);
}

// 40 bounces leave 1e-7 of the rest.
TEST(TruncatedTubes, TheEstimateFollowsTheErrorOfABoxOfGlass) {
  for (const int bounces : {4, 8, 16}) expect_fair(error_ratios(hollow_box(), bounces, 40), 0.1);
}

// What goes to and fro in it goes on in many directions, most of which never come back.
TEST(TruncatedTubes, TheEstimateCoversTheErrorWhereTubesDouble) {
  for (const int bounces : {8, 10}) expect_fair(error_ratios(dihedral_in_a_box(), bounces, 16), 0.01);
}

// Sheets have their frequencies traced some at a time; each is as it is alone. The grid of cells is that of the highest one.
TEST(TruncatedTubes, ManyFrequenciesAreEachAsTheyAreAlone) {
  Material dispersive = glass;
  std::vector<double> frequencies;
  dispersive.layers.clear();
  for (int i = 0; i < 21; ++i) {
    frequencies.push_back(frequency * (1.0 + 0.01 * i));
    dispersive.layers.push_back({{{{6.0 - 0.02 * i, -0.05}}, 4e-3}});
  }
  const std::vector<Look> look{{deg(70.0, 20.0), deg(70.0, 20.0)}};
  for (const TubeMode mode : {TubeMode::adaptive, TubeMode::uniform}) {
    TubeOptions tubes;
    tubes.mode = mode;
    const SweepResult all = solved(hollow_box(), dispersive, frequencies, look, tubes);
    for (const std::size_t i : {0, 15, 16, 20}) {
      TubeOptions same_grid = tubes;
      same_grid.per_wavelength = tubes.per_wavelength * frequencies.back() / frequencies[i];
      const SweepResult one = solved(hollow_box(), at_frequency({dispersive}, i).front(), {frequencies[i]}, look, same_grid);
      EXPECT_LT(difference(all.total[i], one.total[0]), 1e-9) << i;
    }
  }
}

TruncatedSums truncated(const PolygonSoup& soup, const Look& look, const TubeOptions& tubes) {
  SolveOptions options{tubes, {}, 1, false, {}};
  options.edges.method = EdgeMethod::none;
  return solve(Target(build_mesh(soup, 1.0, "test").mesh), {{frequency}, {look}}, options).statistics.truncated;
}

// Along its bisector every tube that meets a face of a right-angled corner meets the other one next: what is left after one
// bounce is as wide as the corner's opening.
TEST(TruncatedTubes, WhatIsLeftAfterTheLastBounceIsTheAreaOfItsTubes) {
  const double a = 2.0 * lambda, h = 3.0 * lambda, opening = std::sqrt(2.0) * a * h;
  for (const TubeMode mode : {TubeMode::adaptive, TubeMode::uniform}) {
    TubeOptions tubes;
    tubes.mode = mode;
    tubes.max_bounces = 1;
    const TruncatedSums sums = truncated(shapes::dihedral(a, h), {deg(90.0, 45.0), deg(90.0, 45.0)}, tubes);
    EXPECT_GT(sums[Truncation::bounces].tubes, 0u);
    // Uniform tubes end at cells: two rows of them along each side, 0.1 wavelength wide, of some 30 by 30.
    EXPECT_NEAR(sums[Truncation::bounces].sigma, opening, (mode == TubeMode::adaptive ? 1e-9 : 0.15) * opening);
    EXPECT_EQ(sums.tubes(), sums[Truncation::bounces].tubes);
    tubes.max_bounces = 2;
    EXPECT_EQ(truncated(shapes::dihedral(a, h), {deg(90.0, 45.0), deg(90.0, 45.0)}, tubes).tubes(), 0u);
  }
}

// What a small ball reflects sideways meets a wide plate far away, each tube there wider than a few wavelengths.
TEST(TruncatedTubes, TubesWiderThanTheirMiddleSaysAreCountedByThemselves) {
  const PolygonSoup ball = shapes::icosphere(4, lambda),
                    above = shapes::transformed(shapes::plate(120.0 * lambda), glm::dmat3(1.0), 1.0, {0.0, 0.0, 60.0 * lambda});
  TubeOptions tubes;
  tubes.curved = CurvedSurfaces::always;
  tubes.max_per_wavelength = tubes.per_wavelength;
  const TruncatedSums sums = truncated(shapes::joined(ball, above), {deg(85.0, 0.0), deg(85.0, 0.0)}, tubes);
  const double cell = wavelength(sampled_band(frequency).middle) / tubes.per_wavelength;
  const double cells = static_cast<double>(sums[Truncation::width].tubes) * cell * cell;
  EXPECT_GT(sums[Truncation::width].tubes, 0u);
  // A whole number of cells fills the rectangle: they are no larger than asked for, and hardly smaller.
  EXPECT_LE(sums[Truncation::width].sigma, cells * (1.0 + 1e-9));
  EXPECT_GE(sums[Truncation::width].sigma, cells * 0.95);
  EXPECT_EQ(sums.tubes(), sums[Truncation::width].tubes);
}

// Between two walls of glass on either side more than 15 times as many tubes are under way as a tile has cells, 48 by 45.
TEST(TruncatedTubes, OfTooManyTheWeakestAreCountedByThemselves) {
  PolygonSoup boxes = shapes::joined(shapes::cube(6.0 * lambda), shapes::cube(4.0 * lambda));
  boxes.materials.assign(boxes.polygons.size(), 0);
  TubeOptions tubes;
  tubes.mode = TubeMode::uniform;
  tubes.max_bounces = 12;
  const Look look{deg(70.0, 20.0), deg(70.0, 20.0)};
  const TruncatedSums sums = solved(boxes, glass, {frequency}, {look}, tubes).statistics.truncated;
  EXPECT_GT(sums[Truncation::number].tubes, 0u);
  EXPECT_GT(sums[Truncation::number].sigma, 0.0);
  EXPECT_GT(sums[Truncation::bounces].tubes, 0u);
  EXPECT_EQ(sums[Truncation::width].tubes, 0u);
}

TEST(TruncatedTubes, TheStrongestGoOn) {
  std::vector<int> tubes{3, 1, 2, 3, 0, 2, 2}, ended;
  end_weakest(
      tubes, 4, [](int tube) { return static_cast<double>(tube); }, [&](int tube) { ended.push_back(tube); });
  EXPECT_EQ(tubes, (std::vector<int>{3, 2, 3, 2}));
  EXPECT_EQ(ended, (std::vector<int>{1, 0, 2}));
  end_weakest(
      tubes, 4, [](int tube) { return static_cast<double>(tube); }, [&](int) { FAIL(); });
}

}  // namespace
}  // namespace raytube
