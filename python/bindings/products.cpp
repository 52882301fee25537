// Range profiles, images and Doppler of results.
#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>

#include "bindings/interruptible.h"
#include "bindings/job.h"
#include "bindings/result.h"
#include "imaging/doppler.h"
#include "imaging/isar.h"
#include "imaging/range_profile.h"
#include "jobs/imaged_target.h"
#include "output/products/sweep_samples.h"
#include "output/tables/stored.h"

namespace raytube::python {

namespace py = pybind11;

namespace {

using SharedResult = std::shared_ptr<StoredResult>;
using PointRows = std::vector<std::array<double, 3>>;

constexpr const char* what = "the result";  // in sentences

// An array that keeps the rows themselves.
template <class Value, class Row>
py::object owned_array(std::vector<Row> rows, std::vector<py::ssize_t> shape) {
  auto kept = std::make_unique<std::vector<Row>>(std::move(rows));
  const void* data = kept->data();
  const py::capsule owner(kept.release(), [](void* memory) { delete static_cast<std::vector<Row>*>(memory); });
  return py::array_t<Value>(std::move(shape), static_cast<const Value*>(data), owner);
}

py::tuple direction_tuple(const dvec3& v) { return py::make_tuple(v.x + 0.0, v.y + 0.0, v.z + 0.0); }

std::vector<dvec3> vectors_of(const PointRows& points) {
  std::vector<dvec3> vectors;
  for (const auto& [x, y, z] : points) vectors.emplace_back(x, y, z);
  return vectors;
}

Window window_of(const std::string& name, double sidelobe_db) { return {*window_of_name(name), sidelobe_db}; }

void keep_look(SweepSamples& samples, std::size_t look) {
  const auto keep = [&](auto& rows, std::size_t count) {
    const auto first = rows.begin() + static_cast<std::ptrdiff_t>(look * count);
    rows = {first, first + static_cast<std::ptrdiff_t>(count)};
  };
  keep(samples.looks, 1);
  keep(samples.s, samples.frequency.count);
  keep(samples.error, samples.frequency.count);
  keep(samples.model, samples.frequency.count);
}

// Of one look, or of all.
py::dict profiles(const SharedResult& result, std::optional<std::size_t> look, const PointRows& outermost,
                  const std::string& window, double sidelobe_db, int padding) {
  RangeProfiles made =
      interruptibly([result, look, points = vectors_of(outermost), w = window_of(window, sidelobe_db), padding](Watch&) {
        SweepSamples samples = samples_of(*result, what);
        if (look) keep_look(samples, *look);
        return range_profiles(samples, {w, padding, middle_range(samples, points, what)});
      });
  const auto looks = static_cast<py::ssize_t>(made.error.size()), ranges = static_cast<py::ssize_t>(made.range.count);
  std::vector<double> range_m;
  for (std::size_t i = 0; i < made.range.count; ++i) range_m.push_back(made.range.at(i));
  py::dict d;
  d["range_m"] = owned_array<double>(std::move(range_m), {ranges});
  d["S"] = owned_array<Complex>(std::move(made.s), {looks, ranges, 4});
  d["error_m"] = owned_array<double>(std::move(made.error), {looks, 1, 4});
  d["model_m"] = owned_array<double>(std::move(made.model), {looks, 1, 4});
  d["resolution_m"] = made.limits.resolution;
  d["unambiguous_m"] = made.limits.unambiguous;
  return d;
}

std::vector<double> values_of(const EvenAxis& axis) {
  std::vector<double> values;
  for (std::size_t i = 0; i < axis.count; ++i) values.push_back(axis.at(i) + 0.0);
  return values;
}

void put_axis(py::dict& d, const char* name, const EvenAxis& axis) {
  d[name] = owned_array<double>(values_of(axis), {static_cast<py::ssize_t>(axis.count)});
}

template <class Product>
void put_velocities(py::dict& d, const Product& made) {
  put_axis(d, "velocity_m_per_s", made.velocity);
  std::vector<double> doppler = values_of(made.velocity);
  for (double& each : doppler) each = made.doppler_of(each);
  const auto count = static_cast<py::ssize_t>(doppler.size());
  d["doppler_hz"] = owned_array<double>(std::move(doppler), {count});
  d["doppler_frequency_hz"] = made.frequency;
  d["velocity_resolution_m_per_s"] = made.velocity_limits.resolution;
  d["velocity_unambiguous_m_per_s"] = made.velocity_limits.unambiguous;
}

// Of one look of the pulses, or of all of them as an array.
py::dict doppler(const SharedResult& result, std::size_t look, bool angle, const std::string& mechanism, double range,
                 double velocity, const std::string& window, double sidelobe_db, int padding) {
  const DopplerOptions options{look, window_of(window, sidelobe_db), padding, range, velocity};
  DopplerMap made = interruptibly(
      [=](Watch&) { return (angle ? range_doppler_angle : doppler_map)(samples_of(*result, what, mechanism), options, what); });
  py::dict d;
  put_axis(d, "range_m", made.range);
  put_velocities(d, made);
  put_axis(d, "cosine", made.cosine);
  d["S"] = owned_array<Complex>(std::move(made.s),
                                {static_cast<py::ssize_t>(made.range.count), static_cast<py::ssize_t>(made.velocity.count),
                                 static_cast<py::ssize_t>(made.cosine.count), 4});
  d["time_s"] = made.time.middle();
  if (made.range_limits) {
    d["range_resolution_m"] = made.range_limits->resolution;
    d["range_unambiguous_m"] = made.range_limits->unambiguous;
  }
  if (made.cosine_limits) {
    d["cosine_resolution"] = made.cosine_limits->resolution;
    d["cosine_unambiguous"] = made.cosine_limits->unambiguous;
    d["array_direction"] = direction_tuple(made.array);
  }
  return d;
}

py::dict spectrogram_of(const SharedResult& result, std::size_t look, std::size_t length, double overlap,
                        std::optional<double> gate, const std::string& mechanism, double range, double velocity,
                        const std::string& window, double sidelobe_db, int padding) {
  const SpectrogramOptions options{{look, window_of(window, sidelobe_db), padding, range, velocity}, length, overlap, gate};
  Spectrogram made = interruptibly([=](Watch&) { return spectrogram(samples_of(*result, what, mechanism), options, what); });
  py::dict d;
  put_axis(d, "time_s", made.time);
  put_velocities(d, made);
  d["sigma_m2"] = owned_array<double>(
      std::move(made.sigma), {static_cast<py::ssize_t>(made.time.count), static_cast<py::ssize_t>(made.velocity.count), 4});
  d["window_pulses"] = made.length;
  return d;
}

// The times of pulses, whose looks follow one another.
std::vector<double> pulse_times(const SharedResult& result) { return pulse_grid(sweep_of(*result).times, what).times; }

py::dict axis_of(const IsarImage& image, std::size_t axis) {
  std::vector<double> at;
  for (std::size_t i = 0; i < image.grid.count[axis]; ++i) at.push_back(image.coordinate(axis, i));
  const auto count = static_cast<py::ssize_t>(at.size());
  py::dict d;
  d["at_m"] = owned_array<double>(std::move(at), {count});
  d["direction"] = direction_tuple(image.axes[axis].direction);
  d["resolution_m"] = image.axes[axis].resolution;
  d["unambiguous_m"] = image.axes[axis].unambiguous;
  return d;
}

py::tuple isar(const SharedResult& result, const PointRows& outermost, const std::vector<double>& size, double pixels,
               const std::string& window, double sidelobe_db) {
  IsarImage image =
      interruptibly([result, points = vectors_of(outermost), size, pixels, w = window_of(window, sidelobe_db)](Watch&) {
        const SweepSamples samples = samples_of(*result, what);
        const AngleGrid grid = grid_of_looks(*result, what);
        return isar_image(samples, grid, {w, image_frame(samples, grid, w, points, size, what), pixels}, what);
      });
  py::list axes;
  std::vector<py::ssize_t> shape;
  for (std::size_t axis = 0; axis < image.axes.size(); ++axis) {
    axes.append(axis_of(image, axis));
    shape.push_back(static_cast<py::ssize_t>(image.grid.count[axis]));
  }
  shape.push_back(4);
  return py::make_tuple(axes, owned_array<Complex>(std::move(image.s), std::move(shape)));
}

// PointRows as wide as the target, lines to be drawn over it, and the corners of its triangles, which make its silhouette.
py::tuple outline(const std::shared_ptr<Job>& job) {
  const auto& mesh = job->built->target.mesh;
  std::vector<dvec3> points = outermost_of(job->built->target);
  std::vector<std::array<dvec3, 2>> lines = lines_of(job->built->target);
  std::vector<std::array<glm::vec3, 3>> triangles;
  for (const auto& corners : mesh.triangles) {
    const auto at = [&](int corner) { return glm::vec3(mesh.vertices[corners[corner]] + mesh.center); };
    triangles.push_back({at(0), at(1), at(2)});
  }
  static_assert(sizeof(dvec3) == 3 * sizeof(double) && sizeof(glm::vec3) == 3 * sizeof(float));
  const auto count = static_cast<py::ssize_t>(points.size()), line_count = static_cast<py::ssize_t>(lines.size()),
             triangle_count = static_cast<py::ssize_t>(triangles.size());
  return py::make_tuple(owned_array<double>(std::move(points), {count, 3}),
                        owned_array<double>(std::move(lines), {line_count, 2, 3}),
                        owned_array<float>(std::move(triangles), {triangle_count, 3, 3}));
}

py::dict centres(const std::shared_ptr<Job>& job, std::size_t look, std::size_t count, double resolution, int threads,
                 const py::object& progress) {
  const LookCentres all = interruptibly(
      [=](Watch& watch) {
        return job->centres({look, count, resolution}, threads, watch);
      },
      progress);
  const auto number = static_cast<py::ssize_t>(all.found.centres.size());
  std::vector<double> places, persistence;
  std::vector<ScatteringMatrix> s;
  py::list mechanisms;
  for (const ScatteringCentre& centre : all.found.centres) {
    places.insert(places.end(), {centre.place.x, centre.place.y, centre.place.z});
    persistence.insert(persistence.end(), {centre.band * all.frequency, centre.azimuth / degree, centre.elevation / degree});
    s.push_back(centre.s);
    mechanisms.append(all.found.mechanism_of(centre));
  }
  py::dict d;
  d["place"] = owned_array<double>(std::move(places), {number, 3});
  d["persistence"] = owned_array<double>(std::move(persistence), {number, 3});
  d["S"] = owned_array<Complex>(std::move(s), {number, 2, 2});
  d["rest"] = owned_array<Complex>(std::vector<ScatteringMatrix>{all.found.rest}, {2, 2});
  d["mechanism"] = mechanisms;
  d["frequency_hz"] = all.frequency;
  d["resolution_m"] = all.side;
  return d;
}

}  // namespace

void bind_products(py::module_& module) {
  module.def("centres", &centres);
  module.def("range_profiles", &profiles);
  module.def("isar", &isar);
  module.def("doppler", &doppler);
  module.def("spectrogram", &spectrogram_of);
  module.def("pulse_times", &pulse_times);
  module.def("outline", &outline);
  module.def("sidelobe_limits_db", [] { return py::make_tuple(least_sidelobe_db, most_sidelobe_db); });
}

}  // namespace raytube::python
