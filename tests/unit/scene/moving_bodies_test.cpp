// Kinematics of rigid bodies against closed forms.
#include <gtest/gtest.h>

#include "scene/motion.h"

namespace raytube {
namespace {

constexpr double rounding = 1e-12;  // of poses of some metres, a few products deep

dvec3 at(const Motion& motion, std::size_t body, double time, const dvec3& point) { return pose_of(motion, body, time)(point); }

// Of a point of a body, by central differences: exact to the third power of the step for rotations.
dvec3 velocity_of(const Motion& motion, std::size_t body, double time, const dvec3& point) {
  constexpr double step = 1e-5;
  return (at(motion, body, time + step, point) - at(motion, body, time - step, point)) / (2.0 * step);
}

BodyMotion body(std::size_t on = no_body) {
  BodyMotion b;
  b.on = on;
  return b;
}

TEST(MovingBodies, WhatHasNoBodyStands) {
  EXPECT_EQ(at({}, no_body, 3.0, {1, 2, 3}), dvec3(1, 2, 3));
  EXPECT_EQ(carried_by({}, no_body), no_body);
}

TEST(MovingBodies, VelocityBringsThemFromTheirPlaceAtTheReferenceTime) {
  Motion motion{{body()}, 2.0};
  motion.bodies[0].velocity = {3.0, -1.0, 0.5};
  EXPECT_EQ(at(motion, 0, 2.0, {1, 0, 0}), dvec3(1, 0, 0));
  EXPECT_LT(glm::distance(at(motion, 0, 4.0, {1, 0, 0}), dvec3(7, -2, 1)), rounding);
}

TEST(MovingBodies, TurningIsRightHandedAboutItsAxis) {
  Motion motion{{body()}};
  motion.bodies[0].turning = Turning{{0, 0, 1}, {1, 0, 0}, 0.5 * pi, 0.0};
  EXPECT_LT(glm::distance(at(motion, 0, 1.0, {2, 0, 5}), dvec3(1, 1, 5)), rounding);
  EXPECT_LT(glm::distance(at(motion, 0, 0.37, {1, 0, -4}), dvec3(1, 0, -4)), rounding);  // on the axis
}

// A wheel of radius r that rolls: its lowest point stands, its highest runs at twice the velocity of the car.
TEST(MovingBodies, ARollingWheelStandsOnTheRoad) {
  constexpr double r = 0.31, v = 15.0;
  Motion motion{{body(), body(0)}};
  motion.bodies[0].velocity = {v, 0, 0};
  motion.bodies[1].turning = Turning{{0, 1, 0}, {1.3, 0.7, r}, v / r, 0.0};
  constexpr double differences = 1e-4;  // of a central difference: (omega step)^2 / 6 of v
  EXPECT_LT(glm::length(velocity_of(motion, 1, 0.0, {1.3, 0.7, 0.0})), differences);
  EXPECT_LT(glm::distance(velocity_of(motion, 1, 0.0, {1.3, 0.7, 2 * r}), dvec3(2 * v, 0, 0)), differences);
  EXPECT_EQ(carried_by(motion, 1), 1u);
}

TEST(MovingBodies, WhatOnlyRidesIsCarried) {
  Motion motion{{body(), body(0), body(1)}};
  motion.bodies[0].velocity = {1, 0, 0};
  EXPECT_EQ(carried_by(motion, 2), 0u);
  EXPECT_EQ(at(motion, 2, 2.0, {0, 0, 0}), dvec3(2, 0, 0));
}

PoseSample sample(double time, double turn) {
  return {time, {std::cos(turn), std::sin(turn), 0.0}, {std::cos(0.5 * turn), 0, 0, std::sin(0.5 * turn)}};
}

// A table of a circle in steps of ten degrees. Cubics through points on it with slopes of central differences, sin(h) / h of the
// right ones, are off by h^4 / 384 and h^3 / 48 of the radius at most: 1e-4.
TEST(MovingBodies, ATableRunsThroughItsLinesSmoothly) {
  Motion motion{{body()}};
  for (int i = 0; i <= 36; ++i) motion.bodies[0].poses.push_back(sample(0.1 * i, 10.0 * degree * i));
  for (const double time : {0.0, 0.7, 3.6}) {
    const double turn = 100.0 * degree * time;
    EXPECT_LT(glm::distance(at(motion, 0, time, {0, 0, 0}), dvec3(std::cos(turn), std::sin(turn), 0.0)), rounding);
    EXPECT_LT(glm::distance(at(motion, 0, time, {1, 0, 0}), 2.0 * dvec3(std::cos(turn), std::sin(turn), 0.0)), rounding);
  }
  for (double time = 0.2; time < 3.4; time += 0.037) {
    const double turn = 100.0 * degree * time;
    EXPECT_LT(glm::distance(at(motion, 0, time, {1, 0, 0}), 2.0 * dvec3(std::cos(turn), std::sin(turn), 0.0)), 2e-4) << time;
    const dmat3 m = pose_of(motion, 0, time).turn;
    EXPECT_LT(glm::length((m * glm::transpose(m) - dmat3(1.0))[0]), rounding);
  }
}

TEST(MovingBodies, ALineIsExactInATableOfUnevenTimes) {
  Motion motion{{body()}};
  for (const double time : {-1.0, 0.0, 0.3, 2.0}) motion.bodies[0].poses.push_back({time, dvec3(2.0, -1.0, 0.5) * time});
  for (double time = -1.0; time <= 2.0; time += 0.11)
    EXPECT_LT(glm::distance(at(motion, 0, time, {0, 0, 0}), dvec3(2.0, -1.0, 0.5) * time), rounding) << time;
}

}  // namespace
}  // namespace raytube
