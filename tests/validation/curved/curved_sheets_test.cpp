// Curved surfaces in scenes with sheets: lit through them, seen through them, and reflecting onto them.
#include <gtest/gtest.h>

#include "validation/material_scene.h"

namespace raytube {

using namespace material_scene;

namespace {

const Material vacuum = layered(MaterialKind::sheet, {{{{1.0}}, 3e-3}}),
               laminate = layered(MaterialKind::sheet, {{{{4.0, -0.1}}, 3e-3}}),
               coat = layered(MaterialKind::coated, {{{{3.0, -0.5}}, 2e-3}});

constexpr std::uint32_t of_sheets = 0, coated = 1;

PolygonSoup of(PolygonSoup soup, std::uint32_t material, const dvec3& moved = dvec3(0.0)) {
  for (dvec3& p : soup.points) p += moved;
  soup.materials.assign(soup.polygons.size(), material);
  return soup;
}

PolygonSoup operator+(PolygonSoup a, const PolygonSoup& b) {
  const auto first = static_cast<std::uint32_t>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (std::vector<std::uint32_t> polygon : b.polygons) {
    for (std::uint32_t& corner : polygon) corner += first;
    a.polygons.push_back(polygon);
  }
  a.materials.insert(a.materials.end(), b.materials.begin(), b.materials.end());
  return a;
}

PolygonSoup rectangle(const dvec2& low, const dvec2& high, double z) {
  return of({{{low.x, low.y, z}, {high.x, low.y, z}, {high.x, high.y, z}, {low.x, high.y, z}}, {{0, 1, 2}, {0, 2, 3}}},
            of_sheets);
}

constexpr double tolerance_db = 0.05;

Look near_look(const Direction& from, const Direction& to, double range) {
  Look look{from, to};
  look.transmit_range = look.receive_range = range;
  return look;
}

Scene scene(const PolygonSoup& soup, const Material& sheets, CurvedSurfaces curved = CurvedSurfaces::always) {
  Scene made{soup, {sheets, coat}};
  made.tubes.curved = curved;
  made.tubes.tolerance_db = tolerance_db;
  return made;
}

ScatteringMatrix seen(const Scene& scene, const Look& look) {
  return scene.solved({look}, !(look.transmit == look.receive && look.transmit_range == look.receive_range)).front();
}

const double R = 3.0 * lambda;

PolygonSoup ball(std::uint32_t material = no_index, int subdivisions = 3) {
  return of(shapes::icosphere(subdivisions, R), material);
}

// Over all of the ball, and over half of it and tilted.
PolygonSoup above() { return rectangle(dvec2(-12.0 * lambda), dvec2(12.0 * lambda), 5.0 * lambda); }
PolygonSoup over_half() {
  PolygonSoup sheet = rectangle({0.3 * lambda, -8.0 * lambda}, {7.0 * lambda, 8.0 * lambda}, 5.0 * lambda);
  for (dvec3& p : sheet.points) p.z += 0.3 * p.x + 0.1 * p.y;
  return sheet;
}

// A sheet of vacuum is none, before the transmitter, the receiver or both. The shadow boundary between the facets and the surface
// is found to the quadrature's 2e-3 where both antennas are at one place, and to a share of the shadow's own radiation where the
// receiver has other parts of that boundary. Facets miss a tenth.
TEST(CurvedSheets, ASheetOfVacuumChangesNothing) {
  for (const std::uint32_t material : {no_index, coated})
    for (const PolygonSoup& window : {above(), over_half(), above() + over_half()})
      for (const auto& [from, to, tolerance] : {std::tuple(20.0, 20.0, 2e-3), std::tuple(120.0, 120.0, 2e-3),
                                                std::tuple(20.0, 60.0, 2e-2), std::tuple(120.0, 30.0, 8e-2)}) {
        const Look look{deg(from, 10.0), deg(to, 10.0)};
        EXPECT_LT(difference(seen(scene(ball(material) + window, vacuum), look), seen(scene(ball(material), vacuum), look)),
                  tolerance)
            << material << " " << from << " " << to;
      }
}

// Near the antennas facets that the horizon crosses are left out behind sheets.
TEST(CurvedSheets, ASheetOfVacuumChangesNothingNearTheAntennas) {
  for (const auto& [from, to, tolerance] :
       {std::tuple(20.0, 20.0, 1e-2), std::tuple(20.0, 60.0, 4e-2), std::tuple(120.0, 30.0, 2e-3)}) {
    const Look look = near_look(deg(from, 10.0), deg(to, 10.0), 8.0);
    EXPECT_LT(difference(seen(scene(ball() + over_half(), vacuum), look), seen(scene(ball(), vacuum), look)), tolerance)
        << from << " " << to;
  }
}

// Both ways through a wide sheet, whose own wave is taken off: two integrals, of 2e-3 each. Tubes end at the ball: nothing goes
// to and fro. In the plane through z V is TM and H is TE.
TEST(CurvedSheets, ABallBehindASheetIsSeenThroughItTwice) {
  const auto behind = [&](const PolygonSoup& body, const Look& look) {
    Scene both = scene(body + above(), laminate), alone = scene(above(), laminate);
    both.tubes.max_bounces = 2;
    return seen(both, look) - seen(alone, look);
  };
  for (const std::uint32_t material : {no_index, coated})
    for (const double theta : {0.0, 20.0}) {
      const Look look{deg(theta, 0.0), deg(theta, 0.0)};
      const SurfaceResponse at = response(laminate, 0, k, std::cos(theta * degree), false);
      ScatteringMatrix expected = seen(scene(ball(material), laminate), look);
      expected.at(0, 0) *= at.transmitted.tm * at.transmitted.tm;
      expected.at(1, 1) *= at.transmitted.te * at.transmitted.te;
      EXPECT_LT(difference(behind(ball(material), look), expected), 5e-3) << material << " " << theta;
    }
}

// By default bodies that stand apart from the sheets are curved, too.
TEST(CurvedSheets, ByDefaultABodyApartFromSheetsIsCurved) {
  const PolygonSoup target = ball() + above();
  const Look look{deg(20.0, 10.0), deg(20.0, 10.0)};
  PolygonSoup apart = above();
  for (dvec3& p : apart.points) p.z += 5.0 * lambda;
  EXPECT_EQ(difference(seen(scene(ball() + apart, laminate, CurvedSurfaces::convex), look),
                       seen(scene(ball() + apart, laminate), look)),
            0.0);
  EXPECT_GT(difference(seen(scene(target, laminate, CurvedSurfaces::convex), look), seen(scene(target, laminate), look)), 0.01);
}

glm::dmat3 turned_about_y(double degrees) {
  const double c = std::cos(degrees * degree), s = std::sin(degrees * degree);
  return {dvec3(c, 0.0, -s), dvec3(0.0, 1.0, 0.0), dvec3(s, 0.0, c)};
}

// A ball lit from the side sends a part of the wave straight up, where a plate sends it on to the receiver.
const Direction leaving = deg(120.0, 0.0);
const dvec3 towards_receiver{std::sqrt(0.75), 0.0, -0.5}, middle_of_plate{-8.0 / std::sqrt(2.0) * lambda, 0.0, 40.0 * lambda};

PolygonSoup by_way_of_sheet(const glm::dmat3& turn, const dvec3& middle) {
  return of(shapes::transformed(rectangle(dvec2(-7.0 * lambda), dvec2(7.0 * lambda), 0.0), turn), of_sheets, middle);
}

// What ball and plate radiate together, less what each does without the other.
ScatteringMatrix by_way_of_plate(const PolygonSoup& sheet, const Material& of_sheet) {
  const PolygonSoup ball = of(shapes::icosphere(4, 8.0 * lambda), no_index),
                    plate =
                        of(shapes::transformed(shapes::plate(8.0 * lambda), turned_about_y(-30.0)), no_index, middle_of_plate);
  const auto s = [&](const PolygonSoup& soup) {
    return soup.polygons.empty() ? ScatteringMatrix{} : seen(scene(soup, of_sheet), {deg(90.0, 180.0), leaving});
  };
  return s(ball + plate + sheet) - s(ball + sheet) - s(plate + sheet) + s(sheet);
}

// A sheet across the way from the ball to the plate, which rays within 6 degrees go; and one across that from the plate to the
// receiver. What sheets reflect of other parts of the wave is some hundredths.
TEST(CurvedSheets, WhatABallReflectsGoesThroughSheets) {
  const ScatteringMatrix bare = by_way_of_plate({}, vacuum);
  const PolygonSoup between = by_way_of_sheet(glm::dmat3(1.0), {middle_of_plate.x, 0.0, 25.0 * lambda}),
                    after = by_way_of_sheet(turned_about_y(-60.0), middle_of_plate + 15.0 * lambda * towards_receiver);
  ScatteringMatrix through = bare;
  through *= response(laminate, 0, k, 1.0, false).transmitted.te;
  EXPECT_LT(difference(by_way_of_plate(between, vacuum), bare), 1e-2);
  EXPECT_LT(difference(by_way_of_plate(after, vacuum), bare), 1e-2);
  EXPECT_LT(difference(by_way_of_plate(between, laminate), through), 7e-2);
  EXPECT_LT(difference(by_way_of_plate(after, laminate), through), 2e-2);
}

}  // namespace
}  // namespace raytube
