// Tables of the poses of a body over time.
#pragma once

#include <filesystem>

#include "case/text/document.h"
#include "scene/motion.h"

namespace raytube {

/// Of a file with the columns time_s,x_m,y_m,z_m,qw,qx,qy,qz, or the first four of them, which are all where nothing `may_turn`.
/// Throws InputError, which names `key` if there is no such file.
std::vector<PoseSample> read_poses_csv(const std::filesystem::path& file, const std::string& key, bool may_turn = true);

/// Of a list of lists with the same columns. Throws InputError.
std::vector<PoseSample> read_pose_list(const CaseValue& value, const std::string& key);

}  // namespace raytube
