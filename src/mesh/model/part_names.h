// What the polygons of a mesh go by.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace raytube {

/// Names of polygons, byte by byte as the file has them. A polygon may go by several, and most share theirs with many others:
/// each list of names is kept once.
class PartNames {
 public:
  /// Every name that some polygon goes by, once, in order of first appearance.
  const std::vector<std::string>& all() const { return names_; }

  /// The names of a polygon: indices in all(), ascending.
  std::span<const std::uint32_t> of(std::size_t polygon) const;

  /// The number of a list of names, for give(); an empty text is no name.
  std::uint32_t list(const std::vector<std::string>& names);

  /// Gives the polygon, which comes after all those that have a list already, this one.
  void give(std::size_t polygon, std::uint32_t list);

  /// Gives each of the first `polygons` a further name.
  void add_to_all(const std::string& name, std::size_t polygons);

  /// Takes over the names of another mesh, whose first polygon gets the number `polygons`.
  void append(const PartNames& other, std::size_t polygons);

 private:
  std::uint32_t index_of(const std::string& name);
  std::uint32_t number_of(std::vector<std::uint32_t> indices);

  std::vector<std::string> names_;
  std::unordered_map<std::string, std::uint32_t> index_;
  std::vector<std::vector<std::uint32_t>> lists_{{}};  // the first one is empty
  std::map<std::vector<std::uint32_t>, std::uint32_t> number_{{{}, 0u}};
  std::vector<std::uint32_t> list_of_polygon_;  // those behind its end have list 0, without a name
};

}  // namespace raytube
