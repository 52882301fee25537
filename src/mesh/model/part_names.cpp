#include "mesh/model/part_names.h"

#include <algorithm>

namespace raytube {

std::span<const std::uint32_t> PartNames::of(std::size_t polygon) const {
  return lists_[polygon < list_of_polygon_.size() ? list_of_polygon_[polygon] : 0];
}

std::uint32_t PartNames::place_of(const std::string& name) {
  const auto [entry, is_new] = place_.try_emplace(name, static_cast<std::uint32_t>(names_.size()));
  if (is_new) names_.push_back(name);
  return entry->second;
}

std::uint32_t PartNames::number_of(std::vector<std::uint32_t> places) {
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  const auto [entry, is_new] = number_.try_emplace(places, static_cast<std::uint32_t>(lists_.size()));
  if (is_new) lists_.push_back(std::move(places));
  return entry->second;
}

std::uint32_t PartNames::list(const std::vector<std::string>& names) {
  std::vector<std::uint32_t> places;
  for (const std::string& name : names)
    if (!name.empty()) places.push_back(place_of(name));
  return number_of(std::move(places));
}

void PartNames::give(std::size_t polygon, std::uint32_t list) {
  if (list == 0) return;
  list_of_polygon_.resize(polygon, 0);
  list_of_polygon_.push_back(list);
}

void PartNames::add_to_all(const std::string& name, std::size_t polygons) {
  const std::uint32_t place = place_of(name);
  std::vector<std::uint32_t> longer;
  for (std::size_t list = 0, count = lists_.size(); list < count; ++list) {
    std::vector<std::uint32_t> places = lists_[list];
    places.push_back(place);
    longer.push_back(number_of(std::move(places)));
  }
  list_of_polygon_.resize(polygons, 0);
  for (std::uint32_t& list : list_of_polygon_) list = longer[list];
}

void PartNames::append(const PartNames& other, std::size_t polygons) {
  std::vector<std::uint32_t> number;
  for (const auto& places : other.lists_) {
    std::vector<std::string> names;
    for (const std::uint32_t place : places) names.push_back(other.names_[place]);
    number.push_back(list(names));
  }
  for (std::size_t i = 0; i < other.list_of_polygon_.size(); ++i) give(polygons + i, number[other.list_of_polygon_[i]]);
}

}  // namespace raytube
