// Text compressed with gzip, as files of meshes are.
#pragma once

#include <zlib.h>

#include <stdexcept>
#include <string>

namespace raytube::testing {

/// `piece` so many times, as one member of a gzip file.
inline std::string gzipped(const std::string& piece, std::size_t times = 1) {
  z_stream stream{};
  if (deflateInit2(&stream, 9, Z_DEFLATED, MAX_WBITS + 16, 8, Z_DEFAULT_STRATEGY) != Z_OK) throw std::runtime_error("deflate");
  std::string packed, room(1 << 16, '\0');
  const auto deflate_all = [&](int flush) {
    do {
      stream.next_out = reinterpret_cast<Bytef*>(room.data());
      stream.avail_out = static_cast<uInt>(room.size());
      deflate(&stream, flush);
      packed.append(room, 0, room.size() - stream.avail_out);
    } while (stream.avail_out == 0);
  };
  for (std::size_t i = 0; i < times; ++i) {
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(piece.data()));
    stream.avail_in = static_cast<uInt>(piece.size());
    deflate_all(Z_NO_FLUSH);
  }
  deflate_all(Z_FINISH);
  deflateEnd(&stream);
  return packed;
}

}  // namespace raytube::testing
