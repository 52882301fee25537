// The ways that all tubes of a look take.
#pragma once

#include "sbr/replay.h"
#include "scene/tube_paths.h"

namespace raytube {

/// Replays the tubes of the launch grid with which a run begins: all, or where that are more than `most` the middle one of every
/// block of s x s cells, s the smallest number for which there are at most so many blocks; it stands for its block's area. Throws
/// InputError as TubeReplay does. The result does not depend on the number of threads.
TubePaths tube_paths(const ReplayScene& scene, const Look& look, double frequency_hz, const TubeOptions& options,
                     std::uint64_t most);

}  // namespace raytube
