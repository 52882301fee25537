// A plane ground below the target, by the method of images.
#pragma once

#include <array>
#include <span>

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

/// The looks along these paths, those of each look one after the other.
Sweep sweep_of_paths(const Sweep& sweep, const Ground& ground);

/// What the ground makes of unit waves V and H that come from this direction: those that leave it, in the basis of the mirrored
/// direction, both with their phase at the origin of the mesh's own coordinates. By reciprocity what reaches a receiver there.
/// Over media the direction is above the horizon.
/// `frequency_index` in the list that the material is given at.
std::array<Complex, 2> ground_reflection(const Ground& ground, const Direction& direction, std::size_t frequency_index,
                                         double frequency);

}  // namespace raytube
