// The module raytube._core: what the package raytube calls. Its words are for the package; users read those of python/raytube.
#include <fmt/format.h>
#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "bindings/job.h"
#include "bindings/ranks.h"
#include "bindings/result.h"
#include "bindings/target_state.h"
#include "bindings/values.h"
#include "core/error.h"
#include "core/threads.h"
#include "jobs/check_text.h"
#include "jobs/shared_work.h"

namespace raytube::python {

namespace py = pybind11;

namespace {

using Points = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Corners = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;
using SharedTarget = std::shared_ptr<TargetSource>;
using SharedJob = std::shared_ptr<const Job>;

// Rows of numbers, copied out of Python.
template <class Number>
struct Rows {
  std::vector<Number> numbers;
  std::size_t count, width;

  template <class Array>
  explicit Rows(const Array& array)
      : numbers(array.data(), array.data() + array.size()),
        count(static_cast<std::size_t>(array.shape(0))),
        width(static_cast<std::size_t>(array.shape(1))) {}
  std::span<const Number> row(std::size_t i) const { return {numbers.data() + i * width, width}; }
};

std::vector<dvec3> points_of(const Rows<double>& vertices) {
  std::vector<dvec3> points;
  points.reserve(vertices.count);
  for (std::size_t i = 0; i < vertices.count; ++i) {
    const auto xyz = vertices.row(i);
    if (!std::ranges::all_of(xyz, [](double x) { return std::isfinite(x); }))
      throw InputError(fmt::format("vertices: vertex {} is ({}, {}, {}); give finite coordinates", i, xyz[0], xyz[1], xyz[2]));
    points.emplace_back(xyz[0], xyz[1], xyz[2]);
  }
  return points;
}

std::vector<std::uint32_t> polygon_of(std::span<const std::int64_t> row, std::size_t face, std::size_t points) {
  const auto end = std::ranges::find(row, -1);
  if (!std::all_of(end, row.end(), [](std::int64_t corner) { return corner == -1; }))
    throw InputError(fmt::format("faces: face {} has a -1 before its last corner; -1 stands behind the last one only", face));
  if (end - row.begin() < 3)
    throw InputError(fmt::format("faces: face {} has {} corners; give three or more", face, end - row.begin()));
  for (const std::int64_t corner : std::span(row.begin(), end))
    if (corner < 0 || corner >= static_cast<std::int64_t>(points))
      throw InputError(
          fmt::format("faces: face {} has the corner {}, but there are {} vertices, counted from 0", face, corner, points));
  return {row.begin(), end};
}

SharedTarget target_of_rows(const Rows<double>& vertices, const Rows<std::int64_t>& faces, const std::vector<std::string>& names,
                            const std::string& unit) {
  std::vector<dvec3> points = points_of(vertices);
  std::vector<std::vector<std::uint32_t>> polygons;
  polygons.reserve(faces.count);
  for (std::size_t i = 0; i < faces.count; ++i) polygons.push_back(polygon_of(faces.row(i), i, points.size()));
  return std::make_shared<TargetSource>(soup_of(std::move(points), std::move(polygons), names), unit);
}

SharedTarget target_of_arrays(const Points& vertices, const Corners& faces, const std::vector<std::string>& names,
                              const std::string& unit) {
  if (vertices.ndim() != 2 || vertices.shape(0) == 0 || vertices.shape(1) != 3)
    throw InputError("vertices: give an array of the shape (n, 3), one row or more");
  if (faces.ndim() != 2 || faces.shape(0) == 0 || faces.shape(1) < 3)
    throw InputError("faces: give an array of the shape (n, 3), one row or more, or a wider one with -1 after the last corner");
  return interruptibly([v = Rows<double>(vertices), f = Rows<std::int64_t>(faces), names, unit](Watch&) {
    return target_of_rows(v, f, names, unit);
  });
}

SharedTarget target_of_files(const std::vector<std::filesystem::path>& files, const std::string& unit) {
  return interruptibly([=](Watch&) { return std::make_shared<TargetSource>(files, unit); });
}

SharedJob job_of_file(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return interruptibly([=](Watch&) { return Job::of_file(file, overrides); });
}

// The case of a run.json with the settings that it was run with; None where its files are gone or have changed.
std::shared_ptr<Job> job_of_run(const std::string& text) {
  return std::const_pointer_cast<Job>(interruptibly([=](Watch&) -> SharedJob {
    const Json run = json_of(text);
    try {
      SharedJob job = Job::of_file(text_at(run, "case_file"), settings_of_run(run));
      const std::vector<std::string> meshes = mesh_sha256_of_run(run);
      return meshes.empty() || meshes == job->mesh_sha256 ? job : nullptr;
    } catch (const InputError&) {
      return nullptr;
    }
  }));
}

std::shared_ptr<const LookNumbers> look_numbers(const py::object& rows, bool bistatic) {
  if (rows.is_none()) return nullptr;
  const auto angles = rows.cast<Points>();
  auto numbers = std::make_shared<LookNumbers>();
  numbers->bistatic = bistatic;
  for (py::ssize_t i = 0; i < angles.shape(0); ++i)
    numbers->rows.push_back({angles.at(i, 0), angles.at(i, 1), angles.at(i, 2), angles.at(i, 3)});
  return numbers;
}

SharedJob job_of_target(const SharedTarget& target, const py::dict& values, const std::string& name, const py::object& looks,
                        bool bistatic) {
  const CaseValue root = case_value(values, name);
  const auto numbers = look_numbers(looks, bistatic);
  return interruptibly([=](Watch&) { return Job::of_target(*target, root, numbers.get()); });
}

// None on ranks that do not lead.
std::shared_ptr<StoredResult> solve(const SharedJob& job, int threads, bool parts, const py::object& progress,
                                    const SharedRanks& ranks) {
  const auto work = [=](Watch& watch) {
    auto found = shared_by(ranks, [&] { return job->solve(threads, parts, watch, ranks.get()); });
    return found ? std::make_shared<StoredResult>(std::move(*found)) : nullptr;
  };
  return interruptibly(work, progress);
}

py::tuple check(const SharedJob& job, int threads) {
  const Json report = interruptibly([=](Watch&) { return job->check(threads); });
  return py::make_tuple(python_text(check_text(report)), python_value(report));
}

py::object array_of(const std::vector<ScatteringMatrix>& cells, std::vector<py::ssize_t> shape) {
  py::array_t<Complex> array(std::move(shape));
  static_assert(sizeof(ScatteringMatrix) == 4 * sizeof(Complex));
  std::copy_n(reinterpret_cast<const Complex*>(cells.data()), 4 * cells.size(), array.mutable_data());
  return py::object(std::move(array));
}

py::tuple image(const SharedJob& job, std::size_t look, double per_wavelength, int threads, const py::object& progress) {
  const LookImage image = interruptibly([=](Watch& watch) { return job->image(look, per_wavelength, threads, watch); }, progress);
  const ImageLattice& lattice = image.lattice;
  py::list u, v;
  for (std::uint32_t i = 0; i < lattice.columns; ++i) u.append(lattice.middle({i, 0}).x);
  for (std::uint32_t i = 0; i < lattice.rows; ++i) v.append(lattice.middle({0, i}).y);
  return py::make_tuple(image.frequency, u, v, array_of(image.cells, {lattice.rows, lattice.columns, 2, 2}));
}

py::tuple tuple_of(const dvec3& p) { return py::make_tuple(p.x, p.y, p.z); }

py::tuple field_of(const ComplexVector& e) {
  return py::make_tuple(Complex(e.re.x, e.im.x), Complex(e.re.y, e.im.y), Complex(e.re.z, e.im.z));
}

py::dict bounce_of(const TubeBounce& bounce, const dvec3& center) {
  py::dict d;
  d["triangle"] = bounce.triangle;
  d["patch"] = bounce.patch;
  d["point_m"] = tuple_of(bounce.point + center);
  d["normal"] = tuple_of(bounce.normal);
  d["direction_out"] = tuple_of(bounce.direction_out);
  d["path_m"] = bounce.path;
  d["field_v"] = field_of(bounce.field[0]);
  d["field_h"] = field_of(bounce.field[1]);
  d["goes_on"] = bounce.goes_on;
  return d;
}

py::dict trace(const SharedJob& job, std::size_t look, double u, double v) {
  const TubeTrace trace = interruptibly([=](Watch&) { return job->trace(look, {u, v}); });
  py::list bounces;
  for (const TubeBounce& bounce : trace.bounces) bounces.append(bounce_of(bounce, job->built->target.mesh.center));
  py::dict d;
  d["column"] = trace.column;
  d["row"] = trace.row;
  d["u_m"] = trace.center.x;
  d["v_m"] = trace.center.y;
  d["direction"] = tuple_of(trace.direction);
  d["bounces"] = bounces;
  d["end"] = trace.end;
  return d;
}

py::dict density_of(const DensityResult& result, const DensityErrors& errors, const std::vector<py::ssize_t>& shape) {
  py::dict d;
  d["per_wavelength"] = result.per_wavelength;
  d["tubes"] = result.tubes;
  d["rays"] = result.rays;
  d["solve_s"] = result.solve_s;
  d["relative_change"] = errors.relative_change;
  d["order"] = errors.order;
  d["relative_error"] = errors.relative_error;
  d["rms_db"] = errors.rms_db;
  d["S"] = array_of(result.total, shape);
  return d;
}

py::tuple study_found(const Study& study, const SharedJob& job) {
  const Sweep& sweep = job->asked.sweep;
  const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(sweep.looks.size()),
                                       static_cast<py::ssize_t>(sweep.frequencies.size()), 2, 2};
  py::list rows;
  for (std::size_t i = 0; i < study.results.size(); ++i)
    rows.append(density_of(study.results[i], study.convergence.densities[i], shape));
  py::dict found;
  found["densities"] = rows;
  if (const auto& fine = study.convergence.recommended) found["recommended"] = study.results[*fine].per_wavelength;
  if (const auto& endless = study.convergence.extrapolation) {
    found["order"] = endless->order;
    found["extrapolated_S"] = array_of(endless->total, shape);
    found["relative_uncertainty"] = endless->relative_uncertainty;
  }
  found["warnings"] = python_texts(study.warnings);
  return py::make_tuple(python_text(study.text), found);
}

// None on ranks that do not lead.
py::object converge(const SharedJob& job, const std::vector<double>& densities, int threads, const py::object& progress,
                    const SharedRanks& ranks) {
  const auto work = [=](Watch& watch) {
    return shared_by(ranks, [&] { return job->converge(densities, threads, watch, ranks.get()); });
  };
  const std::optional<Study> study = interruptibly(work, progress);
  return study ? py::object(study_found(*study, job)) : py::none();
}

py::array_t<double> vertices_of(const TargetSource& target) {
  const std::vector<dvec3>& points = target.made_of().soup.points;
  py::array_t<double> array({static_cast<py::ssize_t>(points.size()), py::ssize_t{3}});
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) array.mutable_at(i, axis) = points[i][axis];
  return array;
}

PyObject* input_error = nullptr;  // the class, which the module keeps

void translate(std::exception_ptr pointer) {
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const InputError& error) {
    PyErr_SetObject(input_error, python_text(error.what()).ptr());
  } catch (const Interrupted&) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
  } catch (const RankFailed& failure) {
    constexpr int bad_input = 2;
    PyErr_SetObject(failure.code() == bad_input ? input_error : PyExc_RuntimeError, python_text(failure.what()).ptr());
  }
}

void bind_target_and_job(py::module_& module) {
  py::class_<TargetSource, SharedTarget>(module, "Target")
      .def(py::pickle(&state_of, &target_of_state))
      .def_static("of_files", &target_of_files)
      .def_static("of_arrays", &target_of_arrays)
      .def_property_readonly("name", [](const TargetSource& target) { return python_text(target.made_of().name); })
      .def_property_readonly("meshes", [](const TargetSource& target) { return python_texts(target.made_of().meshes); })
      .def_property_readonly("unit", [](const TargetSource& target) { return target.made_of().unit; })
      .def_property_readonly("parts", [](const TargetSource& target) { return python_texts(target.made_of().soup.names.all()); })
      .def_property_readonly("facets", [](const TargetSource& target) { return target.made_of().soup.polygons.size(); })
      .def_property_readonly("vertices", &vertices_of)
      .def_property_readonly("polygons", [](const TargetSource& target) { return target.made_of().soup.polygons; });
  py::class_<Job, std::shared_ptr<Job>>(module, "Job").def_property_readonly("title", [](const Job& job) {
    return job.asked.title;
  });
  module.def("job_of_file", [](const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    return std::const_pointer_cast<Job>(job_of_file(file, overrides));
  });
  module.def("job_of_run", &job_of_run);
  module.def("job_of_target",
             [](const SharedTarget& target, const py::dict& values, const std::string& name, const py::object& looks,
                bool bistatic) { return std::const_pointer_cast<Job>(job_of_target(target, values, name, looks, bistatic)); });
  module.def("solve", &solve);
  module.def("check", &check);
  module.def("image", &image);
  module.def("trace", &trace);
  module.def("converge", &converge);
}

}  // namespace

}  // namespace raytube::python

PYBIND11_MODULE(_core, module) {
  using namespace raytube;
  using namespace raytube::python;
  namespace py = pybind11;
  input_error = py::exception<InputError>(module, "InputError", PyExc_ValueError).release().ptr();
  py::register_exception_translator(&translate);
  module.attr("__version__") = RAYTUBE_VERSION;
  module.def("all_threads", &all_threads);
  bind_target_and_job(module);
  bind_ranks(module);
  bind_stored(module);
  bind_products(module);
  bind_report(module);
  bind_comparison(module);
  py::module_::import("atexit").attr("register")(py::cpp_function([] {
    const py::gil_scoped_release others_go_on;
    Workers::leave();
  }));
}
