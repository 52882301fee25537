// The bytes of mesh files on disk, and how much may come of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace raytube {

/// A mesh file in memory.
struct MeshFile {
  std::string name;
  std::string bytes;

  /// Throws InputError: the file, then `sentence`, which says what is wrong and what to do about it.
  [[noreturn]] void reject(const std::string& sentence) const;
};

/// The file in memory. Throws InputError: not there, no regular file, larger than this machine's memory, unreadable, empty.
MeshFile read_bytes(const std::filesystem::path& path);

/// Memory of this machine [bytes].
std::uintmax_t installed_memory();

/// Throws InputError if so many facets or vertices come of a file of `bytes`, with those it names, by putting the same part at
/// several places, that they are no target.
void check_repetition(const MeshFile& file, std::uintmax_t bytes, std::uintmax_t facets);

}  // namespace raytube
