// What is to outlive a loss of power has to be brought to the disk itself.
#pragma once

#include <filesystem>

namespace raytube {

/// Throws std::runtime_error that says that the disk did not take all of the file, with the error number of the system if there
/// is one.
[[noreturn]] void refuse_unwritten(const std::filesystem::path& file, int error = 0);

/// Throws std::runtime_error if the disk did not take all of the file: some say so no earlier than now.
void sync_file(const std::filesystem::path& file);

/// Brings the names in a folder to the disk, without which a new file there may be lost with the power; does nothing where the
/// file system cannot do that.
void sync_folder(const std::filesystem::path& folder);

}  // namespace raytube
