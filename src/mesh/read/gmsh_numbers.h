// The numbers of a Gmsh file, which are text or binary as its head says, between words that are text in both.
#pragma once

#include <cstdint>

#include "mesh/files/text_scanner.h"

namespace raytube {

/// Numbers one by one, whichever way they are written. Each rejects the file if it ends before.
class GmshNumbers {
 public:
  explicit GmshNumbers(TextScanner& scanner) : scanner_(scanner) {}

  /// Reads what follows the line $MeshFormat; rejects versions other than 2.0 to 2.2 and 4.1.
  void read_format();

  bool is_version_4() const { return version_4_; }
  bool is_binary() const { return binary_; }

  /// Passes the end of the line behind which binary numbers begin.
  void begin();

  std::int64_t integer();  // 32 bits, with its sign
  std::uint64_t size();    // 64 bits
  double coordinate();     // finite

  /// The number that an element or a node goes by: 32 bits in version 2, 64 bits in version 4.1.
  std::uint64_t tag();

 private:
  template <class Number>
  Number binary();
  void read_byte_order();

  TextScanner& scanner_;
  bool version_4_ = false, binary_ = false, swapped_ = false;
};

}  // namespace raytube
