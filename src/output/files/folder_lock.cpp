#include "output/files/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "core/error.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

std::string owner_text(int descriptor) {
  std::array<char, 32> text{};
  const ssize_t size = pread(descriptor, text.data(), text.size(), 0);
  return size > 0 ? fmt::format(" (process {})", std::string_view(text.data(), static_cast<std::size_t>(size))) : "";
}

}  // namespace

bool is_still(int descriptor, const fs::path& file) {
  struct stat held, there;
  return fstat(descriptor, &held) == 0 && lstat(file.c_str(), &there) == 0 && held.st_ino == there.st_ino &&
         held.st_dev == there.st_dev;
}

FolderLock::FolderLock(const fs::path& folder, const std::string& name) : file_(folder / name) {
  while (!take()) continue;
  const std::string owner = std::to_string(getpid());
  // For those who are refused. A full disk may not take it, and then they are not told.
  [[maybe_unused]] const bool is_told =
      ftruncate(descriptor_, 0) == 0 && pwrite(descriptor_, owner.data(), owner.size(), 0) == static_cast<ssize_t>(owner.size());
}

// False if the owner before has just removed the file.
bool FolderLock::take() {
  const std::string folder = file_.parent_path().string();
  descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (descriptor_ < 0 && errno == ELOOP)
    throw InputError(
        fmt::format("{}: is a link, and is not followed; remove it, or choose another folder with -o DIR", file_.string()));
  if (descriptor_ < 0)
    throw InputError(
        fmt::format("output folder {}: cannot be written to ({}); choose another one with -o DIR", folder, std::strerror(errno)));
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    const std::string owner = owner_text(descriptor_);
    close(descriptor_);
    throw InputError(
        fmt::format("output folder {}: another raytube{} is at work for it; wait for its end, or choose another one with -o DIR",
                    folder, owner));
  }
  if (is_still(descriptor_, file_)) return true;
  close(descriptor_);
  return false;
}

FolderLock::~FolderLock() {
  remove_file();
  close(descriptor_);
}

bool FolderLock::holds() const { return is_still(descriptor_, file_); }

void FolderLock::remove_file() const {
  if (holds()) unlink(file_.c_str());
}

}  // namespace raytube
