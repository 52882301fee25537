#include "mesh/read/gmsh_numbers.h"

#include <fmt/format.h>

#include <cmath>

#include "core/text.h"
#include "mesh/files/numbers.h"

namespace raytube {

void GmshNumbers::read_format() {
  const std::string_view version = scanner_.word_of_any_line();
  version_4_ = version == "4.1";
  if (!version_4_ && version != "2" && version != "2.0" && version != "2.1" && version != "2.2")
    scanner_.reject(
        fmt::format("version '{}' of the Gmsh format is not read; save it as 4.1: gmsh in.msh -save -format msh41 -o "
                    "out.msh",
                    quotable(version)));
  const std::string_view kind = scanner_.word(), size = scanner_.word();
  if (kind != "0" && kind != "1")
    scanner_.reject(fmt::format("'{}' is neither 0 (text) nor 1 (binary); the file is damaged, export it again", quotable(kind)));
  binary_ = kind == "1";
  if (binary_ && size != "8")
    scanner_.reject(fmt::format("binary numbers of '{}' bytes are not read; save the mesh as text", quotable(size)));
  if (binary_) read_byte_order();
}

void GmshNumbers::read_byte_order() {
  begin();
  swapped_ = false;
  const auto one = binary<std::int32_t>();
  swapped_ = one == 1 << 24;
  if (one != 1 && !swapped_) scanner_.reject("the head of its binary numbers is damaged; export the mesh again");
}

void GmshNumbers::begin() {
  if (binary_) scanner_.skip_line();
}

template <class Number>
Number GmshNumbers::binary() {
  return number_at<Number>(scanner_.raw_bytes(sizeof(Number)).data(), swapped_);
}

std::int64_t GmshNumbers::integer() {
  if (binary_) return binary<std::int32_t>();
  const std::string_view word = scanner_.word_of_any_line();
  const double value = scanner_.number(word);
  if (value != std::trunc(value) || std::abs(value) > 0x7FFFFFFF)
    scanner_.reject(
        fmt::format("a whole number was expected instead of '{}'; the file is damaged, export it again", quotable(word)));
  return static_cast<std::int64_t>(value);
}

std::uint64_t GmshNumbers::size() { return binary_ ? binary<std::uint64_t>() : scanner_.count(scanner_.word_of_any_line()); }

std::uint64_t GmshNumbers::tag() {
  return binary_ && !version_4_ ? static_cast<std::uint64_t>(std::int64_t{binary<std::int32_t>()}) : size();
}

double GmshNumbers::coordinate() {
  if (!binary_) return scanner_.coordinate(scanner_.word_of_any_line());
  const auto value = binary<double>();
  if (!std::isfinite(value)) scanner_.reject("a node has a coordinate that is not finite; correct it or export the mesh again");
  return value;
}

}  // namespace raytube
