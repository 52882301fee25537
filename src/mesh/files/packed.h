// Mesh files that are packed: by gzip (zlib), or in a zip archive (libzip).
#pragma once

#include <memory>
#include <string>

#include "mesh/files/mesh_file.h"

struct zip;

namespace raytube {

/// The file unpacked, under its own name. Throws InputError: no gzip data, damaged, cut short, more than `most_bytes`, or so
/// many times the bytes there are that it is no mesh.
MeshFile unpacked(const MeshFile& file, std::uintmax_t most_bytes);

/// An archive in memory, which must outlive it.
class ZipArchive {
 public:
  /// Throws InputError if the file is not a zip archive or is damaged.
  explicit ZipArchive(const MeshFile& file);

  /// Throws InputError if the entry is missing, damaged, encrypted, or far larger than the archive.
  std::string read(const std::string& entry) const;

 private:
  struct Close {
    void operator()(zip* archive) const;
  };
  const MeshFile& file_;
  std::unique_ptr<zip, Close> archive_;
};

}  // namespace raytube
