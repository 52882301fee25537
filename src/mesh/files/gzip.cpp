#include "mesh/files/gzip.h"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>
#include <string_view>

#include "mesh/files/file_contents.h"
#include "mesh/files/mesh_file.h"

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

}  // namespace

MeshFile unpacked(const MeshFile& file, std::uintmax_t most_bytes) {
  if (!is_gzip(file.bytes)) file.reject("is not gzip data, which the ending .gz stands for; rename it");
  return {file.name, Inflater(file, most_bytes).unpack()};
}

}  // namespace raytube
