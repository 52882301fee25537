#include "mesh/model/part_names.h"

#include <algorithm>

namespace raytube {

std::span<const std::uint32_t> PartNames::of(std::size_t polygon) const {
  return lists_[polygon < list_of_polygon_.size() ? list_of_polygon_[polygon] : 0];
}

std::uint32_t PartNames::index_of(const std::string& name) {
  const auto [entry, is_new] = index_.try_emplace(name, static_cast<std::uint32_t>(names_.size()));
  if (is_new) names_.push_back(name);
  return entry->second;
}

std::uint32_t PartNames::number_of(std::vector<std::uint32_t> indices) {
  std::ranges::sort(indices);
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
  const auto [entry, is_new] = number_.try_emplace(indices, static_cast<std::uint32_t>(lists_.size()));
  if (is_new) lists_.push_back(std::move(indices));
  return entry->second;
}

std::uint32_t PartNames::list(const std::vector<std::string>& names) {
  std::vector<std::uint32_t> indices;
  for (const std::string& name : names)
    if (!name.empty()) indices.push_back(index_of(name));
  return number_of(std::move(indices));
}

void PartNames::give(std::size_t polygon, std::uint32_t list) {
  if (list == 0) return;
  list_of_polygon_.resize(polygon, 0);
  list_of_polygon_.push_back(list);
}

void PartNames::add_to_all(const std::string& name, std::size_t polygons) {
  const std::uint32_t index = index_of(name);
  std::vector<std::uint32_t> longer;
  for (std::size_t list = 0, count = lists_.size(); list < count; ++list) {
    std::vector<std::uint32_t> indices = lists_[list];
    indices.push_back(index);
    longer.push_back(number_of(std::move(indices)));
  }
  list_of_polygon_.resize(polygons, 0);
  for (std::uint32_t& list : list_of_polygon_) list = longer[list];
}

void PartNames::append(const PartNames& other, std::size_t polygons) {
  std::vector<std::uint32_t> number;
  for (const auto& indices : other.lists_) {
    std::vector<std::string> names;
    for (const std::uint32_t index : indices) names.push_back(other.names_[index]);
    number.push_back(list(names));
  }
  for (std::size_t i = 0; i < other.list_of_polygon_.size(); ++i) give(polygons + i, number[other.list_of_polygon_[i]]);
}

}  // namespace raytube
