// What a report shows beside the rows of a result: the target in space, where a look's return comes from, and sentences.
#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>

#include "bindings/interruptible.h"
#include "bindings/job.h"
#include "bindings/result.h"
#include "bindings/values.h"
#include "core/threads.h"
#include "imaging/isar.h"
#include "jobs/imaged_target.h"
#include "jobs/solvable.h"
#include "output/products/sweep_samples.h"
#include "output/words/summary.h"
#include "plan/ground_paths.h"
#include "sbr/tube_paths.h"
#include "scene/sampling.h"
#include "solve/image.h"

namespace raytube::python {

namespace py = pybind11;

namespace {

using Shape = std::vector<py::ssize_t>;

template <class Value, class Row>
py::array_t<Value> copied(const std::vector<Row>& rows, Shape shape) {
  py::array_t<Value> made(std::move(shape));
  static_assert(sizeof(Row) % sizeof(Value) == 0);
  std::copy_n(reinterpret_cast<const Value*>(rows.data()), made.size(), made.mutable_data());
  return made;
}

py::ssize_t count_of(const auto& rows) { return static_cast<py::ssize_t>(rows.size()); }

py::tuple vector_tuple(const dvec3& v) { return py::make_tuple(v.x, v.y, v.z); }

// The mesh as traced, in its own coordinates, and how many looks and frequencies its result has.
py::dict traced_target(const std::shared_ptr<Job>& job) {
  const TriangleMesh& mesh = job->built->target.mesh;
  std::vector<dvec3> vertices = mesh.vertices;
  for (dvec3& vertex : vertices) vertex += mesh.center;
  py::dict d;
  d["looks"] = job->asked.sweep.looks.size();
  d["frequencies"] = job->asked.sweep.frequencies.size();
  d["vertices"] = copied<double>(vertices, {count_of(vertices), 3});
  d["triangles"] = copied<std::uint32_t>(mesh.triangles, {count_of(mesh.triangles), 3});
  return d;
}

Case case_of_image(const Job& job, std::size_t look) { return case_of_look(job.asked, look, image_frequency(job.asked.sweep)); }

// The image of a look in `most_cells` cells across at most, and what its facets and edges scatter.
py::dict look_in_space(const std::shared_ptr<Job>& job, std::size_t look, double most_cells) {
  const LookImage image = interruptibly([=](Watch& watch) {
    const Case one = case_of_image(*job, look);
    return naming_the_case(one, [&] {
      const SolvePlan plan = plan_of_case(job->built->target, one, all_threads(), false);
      const double across = 2.0 * job->built->target.mesh.radius / wavelength(one.sweep.frequencies.front());
      return image_of_look(plan, 0, std::min(most_cells / across, one.image_per_wavelength), watch.progress());
    });
  });
  const ImageLattice& lattice = image.lattice;
  const dvec2 corner = lattice.corner + lattice.shift_of_perspective();  // laid over the target without perspective
  std::vector<dvec3> ends;
  std::vector<ScatteringMatrix> edges;
  for (const ImageEdge& edge : image.edges) ends.insert(ends.end(), {edge.begin, edge.end}), edges.push_back(edge.s);
  py::dict d;
  d["frequency_hz"] = image.frequency;
  d["triangles"] = copied<Complex>(image.triangles, {count_of(image.triangles), 4});
  d["edge_ends"] = copied<double>(ends, {count_of(edges), 2, 3});
  d["edges"] = copied<Complex>(edges, {count_of(edges), 4});
  d["cells"] = copied<Complex>(image.cells, {lattice.rows, lattice.columns, 4});
  d["u"] = vector_tuple(lattice.u_hat);
  d["v"] = vector_tuple(lattice.v_hat);
  d["corner"] = py::make_tuple(corner.x, corner.y);
  d["cell"] = py::make_tuple(lattice.cell.x, lattice.cell.y);
  return d;
}

// Segments of `most` tubes at most, the number of surfaces met before each, and how many tubes met the target.
py::tuple tubes(const std::shared_ptr<Job>& job, std::size_t look, std::uint64_t most) {
  const TubePaths paths = interruptibly([=](Watch&) {
    const Case one = case_of_image(*job, look);
    const auto lit_from = [&](const Look& from) {
      return tube_paths({job->built->target.tracer, one.sweep.materials, one.sweep.radar}, from, one.sweep.frequencies.front(),
                        one.tubes, most);
    };
    return naming_the_case(one, [&] {
      const std::vector<Look> lighting = lighting_looks(one.sweep.looks.front(), one.ground);
      TubePaths all = lit_from(lighting.front());
      if (lighting.size() > 1) add_lit_by_ground(all, lit_from(lighting.back()));
      return all;
    });
  });
  std::vector<dvec3> ends;
  std::vector<std::uint32_t> bounces;
  for (const TubePath& path : paths.paths)
    for (std::size_t i = 1; i < path.points.size(); ++i) {
      ends.insert(ends.end(), {path.points[i - 1].position, path.points[i].position});
      bounces.push_back(static_cast<std::uint32_t>(path.points[i - 1].bounce));
    }
  return py::make_tuple(copied<double>(ends, {count_of(bounces), 2, 3}), copied<std::uint32_t>(bounces, {count_of(bounces)}),
                        paths.met_target());
}

// Numerical error and model uncertainty in words.
py::tuple error_sentences(const StoredResult& result) {
  SweepResult whole;
  whole.total = result.s;
  whole.error = errors_in_metres(result);
  whole.model = model_in_metres(result);
  return py::make_tuple(python_text(numerical_error_text(whole)), python_text(model_uncertainty_text(whole)));
}

// Resolution cells of the ISAR image along each of its axes.
std::vector<double> isar_cells(const StoredResult& result, const std::vector<std::array<double, 3>>& outermost) {
  constexpr const char* named = "the result";  // in sentences
  std::vector<dvec3> points;
  for (const auto& [x, y, z] : outermost) points.emplace_back(x, y, z);
  const SweepSamples samples = samples_of(result, named);
  const AngleGrid grid = grid_of_looks(result, named);
  const ImageFrame frame = image_frame(samples, grid, {}, points, {}, named);
  std::vector<double> cells;
  for (const ImageAxis& axis : image_axes(samples, grid, {})) {
    const double size = frame.size[cells.size()];
    cells.push_back((size > 0.0 ? size : axis.unambiguous) / axis.cell);
  }
  return cells;
}

}  // namespace

void bind_report(py::module_& module) {
  module.def("traced_target", &traced_target);
  module.def("look_in_space", &look_in_space);
  module.def("tubes", &tubes);
  module.def("error_sentences", &error_sentences);
  module.def("isar_cells", &isar_cells);
}

}  // namespace raytube::python
