#include <fmt/format.h>
#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <map>

#include "bindings/result.h"
#include "bindings/values.h"
#include "core/error.h"
#include "output/compare/comparison_report.h"
#include "output/tables/column_map.h"
#include "output/tables/csv.h"
#include "output/tables/image_file.h"

namespace raytube::python {

namespace py = pybind11;

namespace {

using Range = std::pair<double, double>;

template <class Value, class Member>
py::array_t<Value> columns_of(const ResultTable& table, Member ResultTable::Row::*member) {
  py::array_t<Value> array({table.rows.size(), std::tuple_size_v<Member>});
  Value* next = array.mutable_data();
  for (const ResultTable::Row& row : table.rows) next = std::ranges::copy(row.*member, next).out;
  return array;
}

ResultTable::Key key_of(const std::string& column) {
  const auto key = std::ranges::find(key_names, column);
  if (key == key_names.end())
    throw InputError(fmt::format(
        "only: there is no column {}; choose among freq_hz, theta_deg, phi_deg, rx_theta_deg, rx_phi_deg, time_s", column));
  return static_cast<ResultTable::Key>(key - key_names.begin());
}

Comparison compare(ResultTable result, ResultTable reference, const std::map<std::string, Range>& only, double within_db,
                   bool free_scale) {
  const py::gil_scoped_release others_go_on;
  for (const auto& [column, range] : only) {
    keep_rows(result, key_of(column), range.first, range.second);
    keep_rows(reference, key_of(column), range.first, range.second);
  }
  return compare_results(std::move(result), std::move(reference), within_db, free_scale);
}

py::dict measures(const ErrorMeasures& e) {
  py::dict d;
  d["rows_within"] = e.within;
  const auto add = [&](const auto& measures) {
    for (const NamedMeasure& measure : measures) d[measure.name] = e.*measure.value;
  };
  add(peak_measures), add(near_peak_measures), add(all_rows_measures);
  return d;
}

// A channel that both results have, and in which there is something to compare.
py::dict channels(const Comparison& comparison) {
  py::dict d;
  for (std::size_t c = 0; c < channel_names.size(); ++c)
    if (comparison.signal[c]) d[channel_names[c]] = measures(comparison.errors[c]);
  return d;
}

}  // namespace

void bind_comparison(py::module_& module) {
  py::class_<ResultTable>(module, "Table")
      .def_static("of_file",
                  [](const std::filesystem::path& file, const std::string& columns, const std::string& name) {
                    return read_result_table(file, parsed_column_map(name, columns), name);
                  })
      .def_static("of_stored", &table_of)
      .def_readonly("has_key", &ResultTable::has_key)
      .def_readonly("has_channel", &ResultTable::has_channel)
      .def_readonly("has_phase", &ResultTable::has_phase)
      .def_property_readonly("keys", [](const ResultTable& t) { return columns_of<double>(t, &ResultTable::Row::key); })
      .def_property_readonly("S", [](const ResultTable& t) { return columns_of<Complex>(t, &ResultTable::Row::s); })
      .def_property_readonly("sigma_dbsm",
                             [](const ResultTable& t) { return columns_of<double>(t, &ResultTable::Row::sigma_dbsm); });
  py::class_<Comparison>(module, "Comparison")
      .def_property_readonly("text", [](const Comparison& comparison) { return python_text(comparison_text(comparison)); })
      .def_property_readonly("rows", &Comparison::rows)
      .def_property_readonly("channels", &channels)
      .def_property_readonly("relative_error", &relative_error)
      .def("above_tolerance", &above_tolerance);
  module.def("compare", &compare);
  module.def("is_image_file", [](const std::filesystem::path& file, const std::string& columns) {
    return is_image_file(file, parsed_column_map("columns", columns));
  });
}

}  // namespace raytube::python
