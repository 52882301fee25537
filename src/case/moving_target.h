// The target of a case that moves, at whatever time.
#pragma once

#include <fmt/format.h>

#include "case/data/case.h"
#include "core/error.h"
#include "mesh/load.h"

namespace raytube {

/// Does what it is told at a time [s], which an InputError gets behind its sentence.
template <class Action>
auto saying_when(double time, const Action& action) {
  try {
    return action();
  } catch (const InputError& error) {
    throw InputError(fmt::format("{} (at {:.9g} s)", error.what(), time));
  }
}

/// Polygons of a case and the body that each of them is part of. At every time the mesh is mended as if its file had the bodies
/// where they are then: what touches is welded, what comes apart is not.
class MovingTarget {
 public:
  /// `soup` with names and materials, as read_target gives it. Throws InputError for a part that is not in the mesh, and for a
  /// polygon of two bodies.
  MovingTarget(PolygonSoup soup, const Case& c);

  /// All of it has one pose at any time, so that nothing changes but where it is seen from.
  bool moves_as_one() const { return as_one_; }
  /// Nothing of it moves at all.
  bool stands() const { return as_one_ && mover_ == no_body; }
  /// Where all of it is then, if it moves as one.
  Pose pose(double time) const { return pose_of(motion(), mover_, time); }

  /// As the file has it.
  LoadedMesh at_rest() const;
  /// With every body where it is at a time [s]. Throws InputError, with that time, for what cannot be there.
  LoadedMesh at(double time) const;

  /// Where the corners of all polygons are at a time [m].
  std::vector<dvec3> corners(double time) const;

  /// What moves as one, with a box round it where the mesh has it at rest [m].
  struct RigidPart {
    std::size_t mover;  // among the bodies; no_body: it stands
    Box box;
  };
  std::vector<RigidPart> rigid_parts() const;
  /// Where the points of one are at a time, to where they are at rest.
  Pose pose_of_part(const RigidPart& part, double time) const { return pose_of(motion(), part.mover, time); }

  /// A sentence for each two bodies that are apart in the file and run into one another at one of these times; one that tells how
  /// short the interval would have to be, if between two neighbours among them the path over some place changes by more than half
  /// a wavelength, so that its Doppler frequency is ambiguous. Empty: neither. Throws InputError, with the time, for a body below
  /// the ground.
  std::vector<std::string> warnings(const Sweep& sweep) const;

 private:
  const Motion& motion() const { return case_.motion->motion; }
  std::vector<dvec3> points_at(double time) const;
  std::vector<std::string> meetings(const std::vector<double>& times) const;
  std::string ambiguity(const Sweep& sweep) const;

  Case case_;                                 // without looks
  PolygonSoup soup_;                          // no point of it is part of two bodies
  std::vector<std::size_t> body_of_point_;    // [point] among the bodies; no_body: it stands
  std::vector<std::size_t> body_of_polygon_;  // [polygon] likewise
  std::size_t mover_ = no_body;
  bool as_one_ = false;
};

}  // namespace raytube
