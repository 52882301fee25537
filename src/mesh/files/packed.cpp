#include "mesh/files/packed.h"

#include <fmt/format.h>
#include <zip.h>
#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>
#include <string_view>

#include "core/text.h"
#include "mesh/files/file_contents.h"

namespace raytube {

namespace {

/// zlib's state, and what it has unpacked so far.
class Inflater {
 public:
  Inflater(const MeshFile& file, std::uintmax_t most_bytes) : file_(file), most_bytes_(most_bytes) {
    if (inflateInit2(&stream_, MAX_WBITS + 16) != Z_OK) throw std::bad_alloc();  // 16: gzip's frame and nothing else
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  std::string unpack() {
    std::string_view left = file_.bytes;
    do {
      left = unpack_member(left);
      if (inflateReset(&stream_) != Z_OK) throw std::bad_alloc();
    } while (is_gzip(left));
    if (left.find_first_not_of('\0') != std::string_view::npos)  // tapes and some servers pad with zeros
      file_.reject("goes on after its gzip data; compress the mesh again");
    return std::move(unpacked_);
  }

 private:
  // One of the members that a gzip file is made of; returns what follows it.
  std::string_view unpack_member(std::string_view bytes) {
    for (int state = Z_OK; state != Z_STREAM_END;) {
      const auto given = static_cast<uInt>(std::min<std::size_t>(bytes.size(), std::numeric_limits<uInt>::max()));
      stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));  // zlib reads it only
      stream_.avail_in = given;
      stream_.next_out = reinterpret_cast<Bytef*>(piece_.data());
      stream_.avail_out = static_cast<uInt>(piece_.size());
      state = inflate(&stream_, Z_NO_FLUSH);
      check(state);
      bytes.remove_prefix(given - stream_.avail_in);
      unpacked_.append(piece_.data(), piece_.size() - stream_.avail_out);
      check_unpacked_size(file_, unpacked_.size(), most_bytes_);
    }
    return bytes;
  }

  // Z_BUF_ERROR: there is room for more but nothing left to read.
  void check(int state) const {
    if (state == Z_MEM_ERROR) throw std::bad_alloc();
    if (state == Z_BUF_ERROR) file_.reject("its gzip data ends early; it is cut short, copy or compress it again");
    if (state != Z_OK && state != Z_STREAM_END) file_.reject("its gzip data is damaged; copy or compress it again");
  }

  const MeshFile& file_;
  std::uintmax_t most_bytes_;
  z_stream stream_{};
  std::string piece_ = std::string(1 << 18, '\0');
  std::string unpacked_;
};

struct CloseEntry {
  void operator()(zip_file_t* entry) const { zip_fclose(entry); }
};

}  // namespace

MeshFile unpacked(const MeshFile& file, std::uintmax_t most_bytes) {
  if (!is_gzip(file.bytes)) file.reject("is not gzip data, which the ending .gz stands for; rename it");
  return {file.name, Inflater(file, most_bytes).unpack()};
}

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
