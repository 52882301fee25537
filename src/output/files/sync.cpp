#include "output/files/sync.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace raytube {

void refuse_unwritten(const std::filesystem::path& file, int error) {
  const std::string reason = error == 0 ? "" : fmt::format(" ({})", std::strerror(error));
  throw std::runtime_error(fmt::format(
      "{}: cannot be written completely{}; is the disk full? Make room, or write elsewhere with -o", file.string(), reason));
}

void sync_file(const std::filesystem::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  const int error = descriptor < 0 || fsync(descriptor) != 0 ? errno : 0;
  if (descriptor >= 0) close(descriptor);
  if (error != 0 && error != EINVAL) refuse_unwritten(file, error);  // EINVAL: a file system that cannot
}

void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

}  // namespace raytube
