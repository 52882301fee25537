#include "scene/motion.h"

#include <algorithm>
#include <cmath>

namespace raytube {

namespace {

// Rodrigues 1840, as a matrix.
dmat3 rotation(const dvec3& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const dmat3 across(dvec3(0.0, axis.z, -axis.y), dvec3(-axis.z, 0.0, axis.x), dvec3(axis.y, -axis.x, 0.0));
  return dmat3(c) + (1.0 - c) * glm::outerProduct(axis, axis) + s * across;
}

dmat3 rotation(const std::array<double, 4>& quaternion) {
  const auto [w, x, y, z] = quaternion;
  return {dvec3(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)),
          dvec3(2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)),
          dvec3(2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y))};
}

Pose turned(const Turning& turning, double since) {
  const dmat3 about = rotation(turning.axis, turning.angle + turning.rate * since);
  return {about, turning.through - about * turning.through};
}

using Columns = std::array<double, 7>;

Columns columns_of(const PoseSample& sample) {
  const auto& [time, at, q] = sample;
  return {at.x, at.y, at.z, q[0], q[1], q[2], q[3]};
}

// Of a parabola through three lines of the table at the middle one, of a straight line at its ends.
Columns slopes_at(const std::vector<PoseSample>& table, std::size_t i) {
  const std::size_t before = i > 0 ? i - 1 : i, after = std::min(i + 1, table.size() - 1);
  const Columns a = columns_of(table[before]), b = columns_of(table[i]), c = columns_of(table[after]);
  const double down = table[i].time - table[before].time, up = table[after].time - table[i].time;
  Columns slopes;
  for (std::size_t k = 0; k < slopes.size(); ++k) {
    const double below = down > 0.0 ? (b[k] - a[k]) / down : 0.0, above = up > 0.0 ? (c[k] - b[k]) / up : 0.0;
    slopes[k] = (down * above + up * below) / (down + up);
    if (down == 0.0 || up == 0.0) slopes[k] = below + above;
  }
  return slopes;
}

Pose pose_in(const std::vector<PoseSample>& table, double time) {
  const auto after = std::ranges::upper_bound(table, time, {}, &PoseSample::time);
  const auto i = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(after - table.begin() - 1, 0, static_cast<std::ptrdiff_t>(table.size()) - 2));
  const double step = table[i + 1].time - table[i].time, t = (time - table[i].time) / step;
  const Columns from = columns_of(table[i]), to = columns_of(table[i + 1]), leaving = slopes_at(table, i),
                arriving = slopes_at(table, i + 1);
  Columns at;
  for (std::size_t k = 0; k < at.size(); ++k)
    at[k] =
        from[k] + t * t * (3.0 - 2.0 * t) * (to[k] - from[k]) + t * (1.0 - t) * step * ((1.0 - t) * leaving[k] - t * arriving[k]);
  const double length = std::sqrt(at[3] * at[3] + at[4] * at[4] + at[5] * at[5] + at[6] * at[6]);
  return {rotation(std::array{at[3] / length, at[4] / length, at[5] / length, at[6] / length}), {at[0], at[1], at[2]}};
}

}  // namespace

Pose pose_of(const Motion& motion, std::size_t body, double time) {
  Pose pose;
  for (; body != no_body; body = motion.bodies[body].on) {
    const BodyMotion& b = motion.bodies[body];
    Pose own;
    if (b.turning) own = turned(*b.turning, time - motion.reference);
    if (!b.poses.empty()) own = pose_in(b.poses, time) * own;
    own.shift += (time - motion.reference) * b.velocity;
    pose = own * pose;
  }
  return pose;
}

std::size_t carried_by(const Motion& motion, std::size_t body) {
  while (body != no_body && !motion.bodies[body].moves()) body = motion.bodies[body].on;
  return body;
}

}  // namespace raytube
