#include "mesh/files/zip_archive.h"

#include <fmt/format.h>
#include <zip.h>

#include "core/text.h"
#include "mesh/files/mesh_file.h"

namespace raytube {

namespace {

struct CloseEntry {
  void operator()(zip_file_t* entry) const { zip_fclose(entry); }
};

}  // namespace

void ZipArchive::Close::operator()(zip* archive) const { zip_discard(archive); }

ZipArchive::ZipArchive(const MeshFile& file) : file_(file) {
  zip_source_t* source = zip_source_buffer_create(file.bytes.data(), file.bytes.size(), 0, nullptr);
  if (!source) throw std::bad_alloc();
  archive_.reset(zip_open_from_source(source, ZIP_RDONLY, nullptr));
  if (archive_) return;
  zip_source_free(source);
  file.reject("is not a zip archive, as a 3MF file is one, or is damaged; copy or export it again");
}

std::string ZipArchive::read(const std::string& name) const {
  const std::unique_ptr<zip_file_t, CloseEntry> entry(zip_fopen(archive_.get(), name.c_str(), 0));
  if (!entry) {
    const std::string_view why = zip_get_error(archive_.get())->zip_err == ZIP_ER_NOENT ? "lacks" : "does not give";
    file_.reject(fmt::format("its archive {} '{}'; copy or export it again", why, quotable(name)));
  }
  std::string bytes, piece(1 << 18, '\0');
  for (zip_int64_t count = 1; count > 0;) {
    count = zip_fread(entry.get(), piece.data(), piece.size());
    if (count < 0) file_.reject(fmt::format("'{}' in its archive is damaged; copy or export it again", quotable(name)));
    bytes.append(piece, 0, static_cast<std::size_t>(count));
    check_unpacked_size(file_, bytes.size(), installed_memory());
  }
  return bytes;
}

}  // namespace raytube
