// Bytes as choices.
#pragma once

#include <cstddef>
#include <cstdint>

namespace raytube::fuzz {

/// The bytes as a row of small choices; zeros behind their end.
class Choices {
 public:
  Choices(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  unsigned byte() { return at_ < size_ ? data_[at_++] : 0; }
  unsigned below(unsigned count) { return byte() % count; }
  bool flag() { return byte() % 2 != 0; }
  bool end() const { return at_ >= size_; }

 private:
  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
};

}  // namespace raytube::fuzz
