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

// Tables of numbers shrink to a third or a tenth, regular grids in a plane to a twentieth; deflate itself reaches 1/1032 (zlib,
// technical details), of zeros.
constexpr std::uintmax_t most_expansion = 200;
constexpr std::uintmax_t always_allowed = 1 << 20;  // [bytes]: the bound is for what can do harm

/// Throws InputError if `bytes` unpacked are more than `most_bytes`, or so many times those of the packed `file` that they are no
/// mesh.
void check_unpacked_size(const MeshFile& file, std::uintmax_t bytes, std::uintmax_t most_bytes) {
  if (bytes > most_bytes) file.reject("unpacks to more than this machine's memory; take a larger machine, or divide the mesh");
  if (bytes > always_allowed && bytes > most_expansion * file.bytes.size())
    file.reject(fmt::format("unpacks to more than {} times its {} bytes, which no mesh does; if it is one, unpack it first",
                            most_expansion, file.bytes.size()));
}

// Z_BUF_ERROR: there is room for more but nothing left to read.
void check_state(const MeshFile& file, int state) {
  if (state == Z_MEM_ERROR) throw std::bad_alloc();
  if (state == Z_BUF_ERROR) file.reject("its gzip data ends early; it is cut short, copy or compress it again");
  if (state != Z_OK && state != Z_STREAM_END) file.reject("its gzip data is damaged; copy or compress it again");
}

/// All members that a gzip file is made of, one after the other.
std::string inflated(const MeshFile& file, std::uintmax_t most_bytes) {
  z_stream stream{};
  if (inflateInit2(&stream, MAX_WBITS + 16) != Z_OK) throw std::bad_alloc();  // 16: gzip's frame and nothing else
  const std::unique_ptr<z_stream, decltype(&inflateEnd)> until_the_end(&stream, inflateEnd);
  std::string_view left = file.bytes;
  std::string whole, piece(1 << 18, '\0');
  do {
    for (int state = Z_OK; state != Z_STREAM_END;) {
      const auto given = static_cast<uInt>(std::min<std::size_t>(left.size(), std::numeric_limits<uInt>::max()));
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(left.data()));  // zlib reads it only
      stream.avail_in = given;
      stream.next_out = reinterpret_cast<Bytef*>(piece.data());
      stream.avail_out = static_cast<uInt>(piece.size());
      state = inflate(&stream, Z_NO_FLUSH);
      check_state(file, state);
      left.remove_prefix(given - stream.avail_in);
      whole.append(piece.data(), piece.size() - stream.avail_out);
      check_unpacked_size(file, whole.size(), most_bytes);
    }
    if (inflateReset(&stream) != Z_OK) throw std::bad_alloc();
  } while (is_gzip(left));
  if (left.find_first_not_of('\0') != std::string_view::npos)  // tapes and some servers pad with zeros
    file.reject("goes on after its gzip data; compress the mesh again");
  return whole;
}

struct CloseEntry {
  void operator()(zip_file_t* entry) const { zip_fclose(entry); }
};

}  // namespace

MeshFile unpacked(const MeshFile& file, std::uintmax_t most_bytes) {
  if (!is_gzip(file.bytes)) file.reject("is not gzip data, which the ending .gz stands for; rename it");
  return {file.name, inflated(file, most_bytes)};
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
