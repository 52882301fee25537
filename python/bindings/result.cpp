#include "bindings/result.h"

#include <fmt/format.h>
#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <limits>
#include <memory>

#include "bindings/values.h"
#include "core/error.h"
#include "output/files/sha256.h"
#include "output/netcdf/netcdf_file.h"
#include "output/netcdf/stored_result.h"
#include "output/tables/csv.h"
#include "output/tables/stored.h"

namespace raytube::python {

namespace py = pybind11;

namespace {

using Shared = std::shared_ptr<StoredResult>;
using Amplitudes = py::array_t<Complex, py::array::c_style | py::array::forcecast>;
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

static_assert(sizeof(ScatteringMatrix) == 4 * sizeof(Complex) && sizeof(ChannelErrors) == 4 * sizeof(double));

// An array over memory that `owner` keeps, read-only: results are what they are.
template <class Value>
py::object view(const void* data, std::vector<py::ssize_t> shape, const py::handle& owner) {
  py::array_t<Value> array(std::move(shape), static_cast<const Value*>(data), owner);
  array.attr("flags").attr("writeable") = false;
  return py::object(std::move(array));
}

std::vector<py::ssize_t> shape_of(const StoredResult& r, std::vector<py::ssize_t> more) {
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(r.looks.size()), static_cast<py::ssize_t>(r.frequency_hz.size())};
  shape.insert(shape.end(), more.begin(), more.end());
  return shape;
}

const StoredResult& of(const py::handle& self) { return self.cast<const StoredResult&>(); }

py::object amplitudes(const py::handle& self, const std::vector<ScatteringMatrix>& rows) {
  return view<Complex>(rows.data(), shape_of(of(self), {2, 2}), self);
}

// None where the rows are not known.
py::object levels(const py::handle& self, const std::vector<ChannelErrors>& rows) {
  if (rows.empty()) return py::none();
  return view<double>(rows.data(), shape_of(of(self), {2, 2}), self);
}

py::array_t<double> of_looks(const StoredResult& r, double StoredLook::*member) {
  py::array_t<double> values(static_cast<py::ssize_t>(r.looks.size()));
  for (std::size_t i = 0; i < r.looks.size(); ++i) values.mutable_data()[i] = r.looks[i].*member;
  return values;
}

void require(bool good, const char* sentence) {
  if (!good) throw InputError(sentence);
}

ChannelErrors sigma_of(const ScatteringMatrix& s) {
  return {{{sigma_dbsm(s.at(0, 0)), sigma_dbsm(s.at(0, 1))}, {sigma_dbsm(s.at(1, 0)), sigma_dbsm(s.at(1, 1))}}};
}

void fill_looks(StoredResult& r, const Numbers& looks) {
  for (py::ssize_t i = 0; i < looks.shape(0); ++i)
    r.looks.push_back({looks.at(i, 0), looks.at(i, 1), looks.at(i, 2), looks.at(i, 3)});
  r.moving = looks.shape(1) == 5;
  for (py::ssize_t i = 0; r.moving && i < looks.shape(0); ++i) r.looks[static_cast<std::size_t>(i)].time_s = looks.at(i, 4);
}

// Amplitudes from elsewhere, of which no error is known. A fifth number of a look is its time.
Shared from_arrays(const Numbers& frequency_hz, const Numbers& looks, bool bistatic, const Amplitudes& s,
                   const std::vector<std::pair<std::string, std::string>>& attributes) {
  require(frequency_hz.ndim() == 1 && frequency_hz.size() > 0, "frequency_hz: give one or more frequencies");
  require(looks.ndim() == 2 && looks.shape(0) > 0 && (looks.shape(1) == 4 || looks.shape(1) == 5),
          "looks: give rows of four angles, and perhaps a time");
  require(
      s.ndim() == 4 && s.shape(0) == looks.shape(0) && s.shape(1) == frequency_hz.size() && s.shape(2) == 2 && s.shape(3) == 2,
      "S: give amplitudes of the shape (looks, frequencies, 2, 2)");
  auto r = std::make_shared<StoredResult>();
  r->frequency_hz.assign(frequency_hz.data(), frequency_hz.data() + frequency_hz.size());
  fill_looks(*r, looks);
  r->bistatic = bistatic;
  const auto* rows = reinterpret_cast<const ScatteringMatrix*>(s.data());
  r->s.assign(rows, rows + r->rows());
  for (const ScatteringMatrix& row : r->s) r->sigma_dbsm.push_back(sigma_of(row));
  r->err_db.assign(r->rows(), {{{unknown, unknown}, {unknown, unknown}}});
  r->model_db = r->err_db;
  r->comment = conventions(SweepResult{});
  r->attributes = attributes;
  return r;
}

// Removed again, whatever happens.
struct ScratchFile {
  std::filesystem::path path;

  ~ScratchFile() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
};

// As a run does, the file says which rcs.csv belongs to it. That costs the writing of the table, so not before it is wanted.
void complete_hash(StoredResult& r, const std::filesystem::path& scratch) {
  for (auto& [name, text] : r.attributes) {
    if (name != "rcs_csv_sha256" || !text.empty()) continue;
    const ScratchFile file{scratch};
    write_rcs_csv(scratch, r);
    text = sha256_of_file(scratch);
  }
}

void save_netcdf(StoredResult& r, const std::filesystem::path& file) {
  complete_hash(r, file.string() + ".csv");
  write_netcdf(file, r);
}

Shared load_csv(const std::filesystem::path& file) {
  auto r = std::make_shared<StoredResult>(read_rcs_csv(file));
  r->attributes = {{"rcs_csv_sha256", sha256_of_file(file)}};
  return r;
}

py::dict attributes_of(const StoredResult& r) {
  py::dict attributes;
  for (const auto& [name, text] : r.attributes) attributes[python_text(name)] = python_text(text);
  return attributes;
}

py::dict mechanisms_of(const py::object& self) {
  py::dict mechanisms;
  for (const StoredPart& part : of(self).parts) mechanisms[python_text(part.name)] = amplitudes(self, part.s);
  return mechanisms;
}

py::dict model_parts_of(const py::object& self) {
  py::dict parts;
  for (const StoredModelPart& part : of(self).model_parts) parts[python_text(part.name)] = levels(self, part.m);
  return parts;
}

py::object incoherent_of(const py::object& self) {
  const StoredResult& r = of(self);
  if (r.incoherent_m2.empty()) return py::none();
  return view<double>(r.incoherent_m2.data(), shape_of(r, {2}), self);
}

}  // namespace

void bind_stored(py::module_& module) {
  py::class_<StoredResult, Shared> stored(module, "Stored");
  stored.def_static("from_arrays", &from_arrays);
  stored.def_static("read_netcdf",
                    [](const std::filesystem::path& file) { return std::make_shared<StoredResult>(read_netcdf(file)); });
  stored.def_static("read_csv", &load_csv);
  stored.def("write_netcdf", &save_netcdf);
  stored.def("write_csv", [](const StoredResult& r, const std::filesystem::path& file) { write_rcs_csv(file, r); });
  stored.def_property_readonly("frequency_hz", [](const py::object& self) {
    const std::vector<double>& hertz = of(self).frequency_hz;
    return view<double>(hertz.data(), {static_cast<py::ssize_t>(hertz.size())}, self);
  });
  stored.def_property_readonly("theta_deg", [](const StoredResult& r) { return of_looks(r, &StoredLook::theta_deg); });
  stored.def_property_readonly("phi_deg", [](const StoredResult& r) { return of_looks(r, &StoredLook::phi_deg); });
  stored.def_property_readonly("rx_theta_deg", [](const StoredResult& r) { return of_looks(r, &StoredLook::rx_theta_deg); });
  stored.def_property_readonly("rx_phi_deg", [](const StoredResult& r) { return of_looks(r, &StoredLook::rx_phi_deg); });
  stored.def_property_readonly("range_m", [](const StoredResult& r) { return of_looks(r, &StoredLook::range_m); });
  stored.def_property_readonly("rx_range_m", [](const StoredResult& r) { return of_looks(r, &StoredLook::rx_range_m); });
  stored.def_property_readonly("time_s", [](const StoredResult& r) { return of_looks(r, &StoredLook::time_s); });
  stored.def_readonly("moving", &StoredResult::moving);
  stored.def_readonly("bistatic", &StoredResult::bistatic);
  stored.def_property_readonly("comment", [](const StoredResult& r) { return python_text(r.comment); });
  stored.def_property_readonly("S", [](const py::object& self) { return amplitudes(self, of(self).s); });
  stored.def_property_readonly("sigma_dbsm", [](const py::object& self) { return levels(self, of(self).sigma_dbsm); });
  stored.def_property_readonly("error_db", [](const py::object& self) { return levels(self, of(self).err_db); });
  stored.def_property_readonly("model_db", [](const py::object& self) { return levels(self, of(self).model_db); });
  stored.def_property_readonly("error_m", [](const py::object& self) { return levels(self, of(self).error_m); });
  stored.def_property_readonly("model_m", [](const py::object& self) { return levels(self, of(self).model_m); });
  stored.def_property_readonly("mechanisms", &mechanisms_of);
  stored.def_property_readonly("model_parts", &model_parts_of);
  stored.def_property_readonly("incoherent_m2", &incoherent_of);
  stored.def_property_readonly("attributes", &attributes_of);
}

}  // namespace raytube::python
