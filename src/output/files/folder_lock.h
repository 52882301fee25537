// One program at a time writes into a folder.
#pragma once

#include <filesystem>
#include <string>

namespace raytube {

/// The right to write into a folder, or one of a name of its own to write something there: a lock of the kernel on a hidden file
/// in it, which goes with the process, however that ends. The file is removed with the lock; one that a killed process has left
/// means nothing. On a file system without locks nobody is refused.
class FolderLock {
 public:
  /// Throws InputError if another one has it, or if the file cannot be made.
  explicit FolderLock(const std::filesystem::path& folder, const std::string& name = ".raytube.lock");
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// False once the file was removed: others may take it then.
  bool holds() const;

  /// Removes the file; the lock goes with this object.
  void remove_file() const;

 private:
  bool take();

  std::filesystem::path file_;
  int descriptor_ = -1;
};

/// True if the file of that name is the one that is open; it may be another one by now, a link, or none.
bool is_still(int descriptor, const std::filesystem::path& file);

}  // namespace raytube
