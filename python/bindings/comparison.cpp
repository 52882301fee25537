#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <map>

#include "bindings/result.h"
#include "bindings/values.h"
#include "core/error.h"
#include "output/compare/comparison_report.h"
#include "output/image_compare/image_report.h"
#include "output/image_compare/read_image.h"
#include "output/tables/column_map.h"
#include "output/tables/csv.h"

namespace raytube::python {

namespace py = pybind11;

namespace {

using Range = std::pair<double, double>;

ResultTable::Key key_of(const std::string& column) {
  const auto key = std::ranges::find(key_names, column);
  if (key == key_names.end())
    throw InputError(
        fmt::format("only: there is no column {}; choose among freq_hz, theta_deg, phi_deg, rx_theta_deg, rx_phi_deg", column));
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
  d["result_peak_dbsm"] = e.result_peak_dbsm;
  d["reference_peak_dbsm"] = e.reference_peak_dbsm;
  d["rows_within"] = e.within;
  d["rms_db"] = e.rms_db;
  d["mean_abs_db"] = e.mean_abs_db;
  d["median_abs_db"] = e.median_abs_db;
  d["p95_abs_db"] = e.p95_abs_db;
  d["largest_abs_db"] = e.largest_abs_db;
  d["bias_db"] = e.bias_db;
  d["relative_error"] = e.relative_error;
  d["austin_db"] = e.austin_db;
  d["correlation"] = e.correlation;
  return d;
}

py::dict image_measures(const ImageMeasures& m) {
  py::dict d = measures(m.errors);
  d["pixels_within"] = d.attr("pop")("rows_within");
  d.attr("pop")("austin_db");
  d["correlation"] = m.correlation;
  d["magnitude_error"] = m.magnitude_error;
  d["power_ratio_db"] = m.power_ratio_db;
  d["ssim"] = m.similarity;
  return d;
}

// A channel that both results have, and in which there is something to compare.
py::dict channels(const Comparison& comparison) {
  py::dict d;
  for (std::size_t c = 0; c < channel_names.size(); ++c)
    if (comparison.signal[c]) d[channel_names[c]] = measures(comparison.errors[c]);
  return d;
}

py::dict channels_of_images(const ImageComparison& comparison) {
  py::dict d;
  for (std::size_t c = 0; c < channel_names.size(); ++c)
    if (comparison.signal[c]) d[channel_names[c]] = image_measures(comparison.measures[c]);
  return d;
}

NamedFile named_file(const std::filesystem::path& file, const std::string& columns, const std::string& name) {
  return {file, parsed_column_map(name, columns), name};
}

}  // namespace

void bind_comparison(py::module_& module) {
  py::class_<ResultTable>(module, "Table")
      .def_static("of_file",
                  [](const std::filesystem::path& file, const std::string& columns, const std::string& name) {
                    return read_result_table(file, parsed_column_map(name, columns), name);
                  })
      .def_static("of_stored", &table_of);
  py::class_<Comparison>(module, "Comparison")
      .def_property_readonly("text", [](const Comparison& comparison) { return python_text(comparison_text(comparison)); })
      .def_property_readonly("rows", &Comparison::rows)
      .def_property_readonly("channels", &channels)
      .def_property_readonly("relative_error", py::overload_cast<const Comparison&>(&relative_error))
      .def("above_tolerance", py::overload_cast<const Comparison&, double>(&above_tolerance));
  module.def("compare", &compare);
  py::class_<NamedFile>(module, "NamedFile").def(py::init(&named_file));
  py::class_<ImageComparison>(module, "ImageComparison")
      .def_property_readonly("text", [](const ImageComparison& comparison) { return python_text(comparison_text(comparison)); })
      .def_property_readonly("rows", &ImageComparison::pixels)
      .def_property_readonly("channels", &channels_of_images)
      .def_property_readonly("relative_error", py::overload_cast<const ImageComparison&>(&relative_error))
      .def_property_readonly("shift",
                             [](const ImageComparison& comparison) { return std::pair(comparison.shift.x, comparison.shift.y); })
      .def("above_tolerance", py::overload_cast<const ImageComparison&, double>(&above_tolerance));
  module.def("are_images", &are_images);
  module.def("compare_images",
             [](const NamedFile& result, const NamedFile& reference, double within_db, bool free_scale, bool registered) {
               const py::gil_scoped_release others_go_on;
               return compare_images(read_image(result), read_image(reference), {within_db, free_scale, registered});
             });
}

}  // namespace raytube::python
