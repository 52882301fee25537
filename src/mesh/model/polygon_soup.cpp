#include "mesh/model/polygon_soup.h"

#include <algorithm>
#include <map>

namespace raytube {

void add_name(PolygonSoup& soup, const std::string& name) { soup.names.add_to_all(name, soup.polygons.size()); }

void number_parts(PolygonSoup& soup) {
  std::map<std::vector<std::uint32_t>, std::uint32_t> known;
  for (std::size_t i = 0; i < soup.polygons.size(); ++i) {
    const std::span<const std::uint32_t> names = soup.names.of(i);
    const auto [found, is_new] = known.try_emplace({names.begin(), names.end()}, static_cast<std::uint32_t>(known.size()));
    soup.parts.push_back(found->second);
    if (!is_new) continue;
    std::string& text = soup.part_names.emplace_back();
    for (const std::uint32_t name : names) text += (text.empty() ? "" : ", ") + soup.names.all()[name];
  }
}

void add_polygons(const PolygonSoup& part, PolygonSoup& whole) {
  const auto first_point = static_cast<std::uint32_t>(whole.points.size());
  const std::size_t first_polygon = whole.polygons.size();
  whole.points.insert(whole.points.end(), part.points.begin(), part.points.end());
  whole.polygons.insert(whole.polygons.end(), part.polygons.begin(), part.polygons.end());
  for (std::size_t i = first_polygon; i < whole.polygons.size(); ++i)
    for (std::uint32_t& corner : whole.polygons[i]) corner += first_point;
  whole.free_forms += part.free_forms;
  whole.step = std::max(whole.step, part.step);
  whole.remarks.insert(whole.remarks.end(), part.remarks.begin(), part.remarks.end());
  whole.names.append(part.names, first_polygon);
  whole.further_files.insert(whole.further_files.end(), part.further_files.begin(), part.further_files.end());
  if (whole.materials.empty() && part.materials.empty()) return;
  whole.materials.resize(first_polygon, no_index);
  whole.materials.insert(whole.materials.end(), part.materials.begin(), part.materials.end());
  whole.materials.resize(whole.polygons.size(), no_index);
}

}  // namespace raytube
