// A plane ground below the target, by the method of images.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "scene/sweep.h"

namespace raytube {

/// How a wave gets from the transmitter by way of the target to the receiver: once reflected by the ground, or straight.
struct GroundPath {
  bool lit_by_ground;   // on its way in
  bool seen_by_ground;  // on its way out
};

/// The paths of a look over this ground. Over a perfect conductor they are those of the target together with its mirror image,
/// in free space, and all that target and ground hand to each other is in them: the mirror image of the incident wave gives the
/// mirror image of the field that the wave itself gives, so that what it lights need not be computed (Balanis 2012, section 7.4).
/// Over other grounds they are the four paths of the target alone (Johnson 2002, IEEE Trans. AP-50, 1361), and what bounces
/// between both more than once is left out.
std::span<const GroundPath> ground_paths(const Ground& ground);

/// The looks along these paths, those of each look one after the other. What the ground reflects comes from mirrored directions;
/// at a finite distance, and of rays, from the mirror images of the antennas.
Sweep sweep_of_paths(const Sweep& sweep, const Ground& ground, bool rays);

/// The looks whose tubes light the target in a look: the straight one, and over a medium that by way of the ground.
std::vector<Look> lighting_looks(const Look& look, const std::optional<Ground>& ground);

/// What the ground makes of the unit waves V and H of an antenna, as those of its mirror image: [of the image][of the antenna].
/// By reciprocity what reaches a receiver there, too.
using GroundReflection = std::array<std::array<Complex, 2>, 2>;

/// Of one path at one frequency.
struct PathFactors {
  GroundReflection transmit, receive;  // on the way in and out

  /// What S along the path [m] adds to S over ground.
  ScatteringMatrix operator()(const ScatteringMatrix& s) const;
  /// Of errors, which add up as amplitudes do, so that none is too small where all paths are alike.
  ChannelErrors operator()(const ChannelErrors& errors) const;
};

/// The ground as the waves of one sweep meet it: plane ones, referred to the origin of the mesh's own coordinates, with the phase
/// of the way; or those of antennas at a finite distance, which are referred to its image. Over a medium such a wave is reflected
/// as the plane wave along that ray which goes on to the middle of the target. Valid where its angle hardly differs over the
/// target, and well above grazing: |w| >> 1, w = k R (cos + 1 / sqrt(eps_r))^2 / 2 for V (Norton 1937, Proc. IRE 25, 1203).
class GroundReflections {
 public:
  /// Of a sweep and that along its paths, which it refers to. `middle`: of the target, in the mesh's own coordinates.
  GroundReflections(const Ground& ground, const Sweep& asked, const Sweep& paths, const dvec3& middle);

  /// Of a look along paths.
  const GroundPath& path(std::size_t look) const { return of_look_[look % of_look_.size()]; }
  /// The look asked for, from one along paths.
  std::size_t asked_look(std::size_t look) const { return look / of_look_.size(); }
  /// How many there are.
  std::size_t paths_of_a_look() const { return of_look_.size(); }

  PathFactors factors(std::size_t look, std::size_t frequency_index) const;  // of a look along a path

 private:
  GroundReflection reflection(const Direction& asked, const AntennaPosition& image, std::size_t frequency_index) const;
  GroundReflection reflection_of_ray(const AntennaPosition& image, std::size_t frequency_index) const;

  Ground ground_;
  const Sweep &asked_, &paths_;
  std::span<const GroundPath> of_look_;
  dvec3 middle_;
};

}  // namespace raytube
