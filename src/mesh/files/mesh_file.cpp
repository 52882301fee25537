#include "mesh/files/mesh_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "core/error.h"
#include "core/text.h"

namespace raytube {

namespace {

// An array of 10 000 antennas, each of 2000 facets and placed by a hundred bytes, comes to 20 facets a byte.
constexpr std::uintmax_t most_facets_per_byte = 100;
constexpr std::uintmax_t facets_always_allowed = 1'000'000;

}  // namespace

void MeshFile::reject(const std::string& sentence) const { throw InputError(fmt::format("mesh file '{}': {}", name, sentence)); }

std::uintmax_t installed_memory() {
  return static_cast<std::uintmax_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uintmax_t>(sysconf(_SC_PAGE_SIZE));
}

MeshFile read_bytes(const std::filesystem::path& path) {
  MeshFile file{path.string(), {}};
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    file.reject(fmt::format("not found; check the path, which in a case file is relative to it{}", backslash_remedy(file.name)));
  if (std::filesystem::is_directory(path, error)) file.reject("is a folder; name the mesh file in it");
  if (!std::filesystem::is_regular_file(path, error)) file.reject("is a pipe or a device; copy the mesh into a file");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (size > installed_memory()) file.reject("is larger than this machine's memory; take a larger machine, or divide the mesh");
  std::ifstream stream(path, std::ios::binary);
  if (!error) file.bytes.resize(size);
  stream.read(file.bytes.data(), static_cast<std::streamsize>(file.bytes.size()));
  file.bytes.resize(static_cast<std::size_t>(stream.gcount()));
  if (stream.bad() || !stream.is_open()) file.reject("cannot be read; check its permissions");
  if (file.bytes.empty()) file.reject("is empty; export the mesh again");
  return file;
}

void check_repetition(const MeshFile& file, std::uintmax_t bytes, std::uintmax_t facets) {
  const std::uintmax_t most = std::max(facets_always_allowed, most_facets_per_byte * bytes);
  if (facets > most)
    file.reject(
        fmt::format("places its parts so often that more than {} facets come of {} bytes; place them less often, or "
                    "export the whole as PLY",
                    most, bytes));
}

}  // namespace raytube
