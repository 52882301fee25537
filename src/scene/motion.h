// Bodies that move: which pose each has when. Plain data, and the kinematics of rigid bodies.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/pose.h"

namespace raytube {

/// Stands for no body: what does not move.
inline constexpr std::size_t no_body = static_cast<std::size_t>(-1);

/// Turning about an axis that goes through a point.
struct Turning {
  dvec3 axis{0.0, 0.0, 1.0};  // unit vector, right-handed
  dvec3 through{0.0};         // [m]
  double rate = 0.0;          // [rad/s]
  double angle = 0.0;         // at the reference time [rad]
};

/// A line of a table of poses.
struct PoseSample {
  double time;                             // [s]
  dvec3 position;                          // of the origin of the mesh's coordinates [m]
  std::array<double, 4> turn{1, 0, 0, 0};  // unit quaternion: w, x, y, z
};

/// A rigid part of the target and how it moves. Its mesh is at rest where the file has it; lengths and directions are those of
/// the body that carries it, at rest, or of the mesh's own coordinates.
struct BodyMotion {
  std::string name;                // in the case
  std::vector<std::string> parts;  // names in the mesh; none: what no other body has
  std::size_t on = no_body;        // the body that carries it
  std::optional<Turning> turning;  // first
  std::vector<PoseSample> poses;   // then; ascending in time, none or at least two
  std::string poses_csv;           // where these are from
  dvec3 velocity{0.0};             // and last [m/s]

  /// Relative to what carries it.
  bool moves() const {
    return glm::length(velocity) > 0.0 || !poses.empty() || (turning && (turning->rate != 0.0 || turning->angle != 0.0));
  }
};

/// All bodies of a target.
struct Motion {
  std::vector<BodyMotion> bodies;
  double reference = 0.0;  // time at which steady motion has brought nothing from its place yet [s]
};

/// The pose of a body at a time [s]. Steady turning and velocity are exact; between the lines of a table positions and
/// quaternions run along cubics with the slopes of central differences (Catmull and Rom 1974, for uneven times), the latter
/// brought back to unit length: for neighbours turned by less than half a turn against one another. `time` within the table.
Pose pose_of(const Motion& motion, std::size_t body, double time);

/// The body nearest to what stands, itself or below it, that moves relative to what carries it; no_body: it stands. Bodies with
/// the same one keep their places relative to one another.
std::size_t carried_by(const Motion& motion, std::size_t body);

}  // namespace raytube
