#include "bindings/target_state.h"

#include <pybind11/numpy.h>

#include <algorithm>
#include <map>

namespace raytube::python {

namespace py = pybind11;

namespace {

using Indices = std::vector<std::uint32_t>;

template <class Value>
py::array_t<Value> array_of(const std::vector<Value>& values) {
  return py::array_t<Value>(static_cast<py::ssize_t>(values.size()), values.data());
}

template <class Value>
std::vector<Value> values_of(const py::handle& array) {
  const auto values = array.cast<py::array_t<Value, py::array::c_style>>();
  return {values.data(), values.data() + values.size()};
}

// Bytes, for a name need not be UTF-8.
py::list bytes_of(const std::vector<std::string>& texts) {
  py::list list;
  for (const std::string& text : texts) list.append(py::bytes(text));
  return list;
}

std::vector<std::string> texts_of(const py::handle& list) {
  std::vector<std::string> texts;
  for (const py::handle text : list) texts.push_back(text.cast<py::bytes>());
  return texts;
}

py::array_t<double> points_of(const PolygonSoup& soup) {
  py::array_t<double> array(static_cast<py::ssize_t>(3 * soup.points.size()));
  for (std::size_t i = 0; i < soup.points.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) array.mutable_data()[3 * i + axis] = soup.points[i][axis];
  return array;
}

// How many corners each polygon has, and all of them.
py::tuple polygons_of(const PolygonSoup& soup) {
  Indices sizes, corners;
  for (const Indices& polygon : soup.polygons) {
    sizes.push_back(static_cast<std::uint32_t>(polygon.size()));
    corners.insert(corners.end(), polygon.begin(), polygon.end());
  }
  return py::make_tuple(array_of(sizes), array_of(corners));
}

// Every list of names once, and the number of each polygon's.
py::tuple names_of(const PolygonSoup& soup) {
  std::map<Indices, std::uint32_t> numbers;
  py::list lists;
  Indices of_polygon;
  for (std::size_t i = 0; i < soup.polygons.size(); ++i) {
    const std::span<const std::uint32_t> names = soup.names.of(i);
    const auto [known, is_new] = numbers.emplace(Indices(names.begin(), names.end()), static_cast<std::uint32_t>(numbers.size()));
    of_polygon.push_back(known->second);
    if (!is_new) continue;
    std::vector<std::string> texts;
    for (const std::uint32_t name : names) texts.push_back(soup.names.all()[name]);
    lists.append(bytes_of(texts));
  }
  return py::make_tuple(lists, array_of(of_polygon));
}

void put_points(const std::vector<double>& coordinates, PolygonSoup& soup) {
  for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3)
    soup.points.emplace_back(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
}

void put_polygons(const py::tuple& polygons, PolygonSoup& soup) {
  const Indices corners = values_of<std::uint32_t>(polygons[1]);
  auto next = corners.begin();
  for (const std::uint32_t size : values_of<std::uint32_t>(polygons[0])) {
    soup.polygons.emplace_back(next, next + size);
    next += size;
  }
}

void put_names(const py::tuple& names, PolygonSoup& soup) {
  std::vector<std::vector<std::string>> lists;
  for (const py::handle list : names[0]) lists.push_back(texts_of(list));
  const Indices of_polygon = values_of<std::uint32_t>(names[1]);
  for (std::size_t i = 0; i < of_polygon.size(); ++i)
    if (const std::vector<std::string>& list = lists.at(of_polygon[i]); !list.empty()) soup.names.give(i, soup.names.list(list));
}

}  // namespace

py::tuple state_of(const TargetSource& target) {
  const TargetParts& parts = target.made_of();
  const PolygonSoup& soup = parts.soup;
  return py::make_tuple(py::bytes(parts.name), parts.unit, bytes_of(parts.meshes), bytes_of(parts.sha256), points_of(soup),
                        polygons_of(soup), names_of(soup), soup.free_forms);
}

std::shared_ptr<TargetSource> target_of_state(const py::tuple& state) {
  TargetParts parts{state[0].cast<py::bytes>(), state[1].cast<std::string>(), texts_of(state[2]), {}, texts_of(state[3])};
  put_points(values_of<double>(state[4]), parts.soup);
  put_polygons(state[5], parts.soup);
  put_names(state[6], parts.soup);
  parts.soup.free_forms = state[7].cast<std::uint64_t>();
  return std::make_shared<TargetSource>(std::move(parts));
}

}  // namespace raytube::python
