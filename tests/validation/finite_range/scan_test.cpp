// An antenna that is moved along a rail or over a plane, and what is focused from there.
#include <gmock/gmock.h>

#include "core/error.h"
#include "imaging/isar.h"
#include "run.h"
#include "shapes.h"

namespace raytube {
namespace {

using namespace raytube::testing;

constexpr double radius = 0.03;

std::vector<dvec3> places_of(std::size_t columns, std::size_t rows, double width, double height, double x) {
  std::vector<dvec3> places;
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < columns; ++i)
      places.emplace_back(x, width * (double(i) / double(columns - 1) - 0.5),
                          rows > 1 ? height * (double(j) / double(rows - 1) - 0.5) : 0.0);
  return places;
}

SweepSamples scanned(const std::vector<dvec3>& spheres, const std::vector<dvec3>& places, std::size_t frequencies) {
  PolygonSoup soup;
  for (const dvec3& centre : spheres) {
    PolygonSoup sphere = shapes::icosphere(2, radius);
    for (dvec3& point : sphere.points) point += centre;
    add_polygons(sphere, soup);
  }
  Sweep sweep;
  SweepSamples samples{.frequency = {8e9, 4e9 / double(frequencies - 1), frequencies}};
  for (std::size_t f = 0; f < frequencies; ++f) sweep.frequencies.push_back(samples.frequency.at(f));
  for (const dvec3& place : places) {
    const double range = glm::length(place);
    const Direction at{std::acos(place.z / range), std::atan2(place.y, place.x)};
    sweep.looks.push_back({at, at, range, range});
    samples.looks.push_back({place / range, place / range, range, range});
  }
  SolveOptions o = options(EdgeMethod::none);
  o.tubes.mode = TubeMode::adaptive;
  samples.s = solve_soup(soup, sweep, o).total;
  return samples;
}

// The strongest place within two cells of one.
dvec3 peak_near(const IsarImage& image, const dvec3& place) {
  double most = 0.0;
  dvec3 found(0.0);
  for (std::size_t i = 0; i < image.s.size(); ++i) {
    const dvec3 at = image.place(i);
    const bool near = std::ranges::all_of(
        image.axes, [&](const ImageAxis& axis) { return std::abs(glm::dot(at - place, axis.direction)) < 2.0 * axis.cell; });
    if (near && std::abs(image.s[i].vv()) > most) most = std::abs(image.s[i].vv()), found = at;
  }
  return found;
}

// Peaks are found to half a twelfth of a cell. A sphere shines where it faces the antenna: its path is that to its middle less
// its radius, from every place.
void expect_in_place(const std::vector<dvec3>& spheres, const std::vector<dvec3>& places, std::size_t frequencies) {
  const SweepSamples samples = scanned(spheres, places, frequencies);
  const std::optional<AngleGrid> grid = scan_grid(places);
  ASSERT_TRUE(grid && grid->scan);
  const dvec3 middle = grid->scan->middle;
  for (const dvec3& sphere : spheres) {
    const dvec3 shines = sphere + radius * glm::normalize(middle - sphere);
    const IsarImage image = isar_image(samples, *grid, {{}, {{0.2, 0.2, 0.2}, shines}, 12.0}, "scan");
    const dvec3 peak = peak_near(image, shines);
    for (const ImageAxis& axis : image.axes) {
      const double off = std::abs(glm::dot(peak - shines, axis.direction)) / axis.cell;
      measured("sphere in a focused scan", off, "cells off");
      EXPECT_LT(off, 0.1);
    }
  }
}

TEST(Scan, ThreeSpheresBesideARailAreInTheirPlaces) {
  expect_in_place({{0.0, 0.0, 0.0}, {0.11, 0.21, 0.0}, {-0.13, -0.17, 0.0}}, places_of(21, 1, 0.7, 0.0, 2.0), 17);
}

TEST(Scan, ThreeSpheresBeforeAPlaneAreInTheirPlaces) {
  expect_in_place({{0.0, 0.0, 0.0}, {0.11, 0.21, 0.1}, {-0.13, -0.17, -0.14}}, places_of(11, 11, 0.42, 0.42, 2.0), 9);
}

TEST(Scan, OnlyEvenLinesAreOne) {
  std::vector<dvec3> places = places_of(5, 3, 1.0, 0.6, 2.0);
  EXPECT_EQ(scan_grid(places)->phi_deg.count, 5u);
  EXPECT_EQ(scan_grid(places)->theta_deg.count, 3u);
  places[7].y += 0.01;
  EXPECT_FALSE(scan_grid(places));
  places.pop_back();
  EXPECT_FALSE(scan_grid(places));
  EXPECT_FALSE(scan_grid({{2, 0, 0}, {1.9, 0.5, 0}, {1.6, 1.0, 0}}));
}

TEST(Scan, ARailTowardsTheTargetShowsNothing) {
  const std::vector<dvec3> places = {{2, 0, 0}, {2.1, 0, 0}, {2.2, 0, 0}};
  const SweepSamples samples = scanned({dvec3(0.0)}, places, 3);
  EXPECT_THAT([&] { require_aperture(samples, *scan_grid(places), "a.nc"); },
              ::testing::ThrowsMessage<InputError>(::testing::HasSubstr("a.nc: the scan runs towards the origin")));
}

}  // namespace
}  // namespace raytube
