// raytube isar: a sweep of frequencies and angles -> an image.
#include "imaging/isar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/threads.h"
#include "imaging/range_profile.h"
#include "jobs/centres_of_look.h"
#include "jobs/imaged_target.h"
#include "output/products/isar_csv.h"
#include "output/products/isar_netcdf.h"
#include "output/products/sweep_samples.h"
#include "output/tables/csv.h"
#include "output/vtk/isar_vti.h"
#include "program/products.h"

namespace raytube {

namespace {

IsarImage direct_image(const Request& request, const ProductSource& source, const SweepSamples& samples, const AngleGrid& grid,
                       const IsarOptions& options) {
  double cell = std::numeric_limits<double>::infinity();
  for (const ImageAxis& axis : image_axes(samples, grid, options.window)) cell = std::min(cell, axis.cell / pieces_to_a_cell);
  DirectImage direct(samples, grid);
  const std::size_t middle =
      grid.looks[middle_index(grid.theta_deg.count) * grid.phi_deg.count + middle_index(grid.phi_deg.count)];
  direct_pieces(request, source, middle, cell, [&](const PlacedScatterer& piece) { direct.add(piece); });
  return direct.image(options, source.name);
}

std::string image_text(const IsarImage& image, const Window& window) {
  std::string text;
  for (std::size_t axis = 0; axis < image.axes.size(); ++axis) {
    const ImageAxis& a = image.axes[axis];
    text += fmt::format(
        "{:<18} along ({:.4g}, {:.4g}, {:.4g}): resolution {:.4g} m ({} window), unambiguous {:.4g} m, {} cells of {:.4g} m\n",
        axis_name(axis), a.direction.x + 0.0, a.direction.y + 0.0, a.direction.z + 0.0, a.resolution, name_of(window),
        a.unambiguous, image.grid.count[axis], image.grid.step[axis]);
  }
  const auto& [at, amplitude] = image.peak;
  return text + fmt::format("peak               {:.2f} dBsm at ({:.4g}, {:.4g}, {:.4g}) m\n", sigma_dbsm(amplitude), at.x + 0.0,
                            at.y + 0.0, at.z + 0.0);
}

// What a case needs for an image of a target of this size with cells of this resolution, as its sections.
std::string planned_case(double size, double resolution, double ghz) {
  constexpr double room = 1.5;  // beside the target
  const double band = 0.5 * speed_of_light / resolution, step = frequency_step_for(room * size), middle = ghz * 1e9;
  const double frequencies = std::ceil(band / step) + 1.0;
  const double wave = wavelength(middle), angle = 0.5 * wave / resolution / degree,
               angle_step = 0.5 * wave / (room * size) / degree;
  const double angles = std::ceil(angle / angle_step) + 1.0;
  constexpr double most_samples = 1e5;
  if (std::max(frequencies, angles) > most_samples)
    throw InputError(
        fmt::format("--plan: {:g} m at {:g} m takes {:.3g} frequencies and {:.3g} angles; ask for a coarser resolution", size,
                    resolution, frequencies, angles));
  return fmt::format(
      "# ISAR of a target {:g} m wide with cells of {:g} m: {} frequencies, {} angles. theta_deg, and the middle of phi_deg, are "
      "yours to set.\n\n[frequency]\nghz = {{ start = {:.9g}, stop = {:.9g}, count = {} }}\n\n[look]\ntheta_deg = 90.0\nphi_deg "
      "= {{ start = "
      "{:.9g}, stop = {:.9g}, count = {} }}\n",
      size, resolution, frequencies, angles, ghz - 0.5e-9 * band, ghz + 0.5e-9 * band, frequencies, -0.5 * angle, 0.5 * angle,
      angles);
}

void plan_image(const ProductRequest& asked) {
  const auto [size, resolution] = *asked.plan;
  const double band_ghz = 0.5e-9 * speed_of_light / resolution;
  if (band_ghz >= 2.0 * asked.plan_ghz)
    throw InputError(fmt::format(
        "--plan: a resolution of {:g} m takes a band of {:.4g} GHz, which does not fit about {:g} GHz; ask for a coarser "
        "one, or for a higher --ghz",
        resolution, band_ghz, asked.plan_ghz));
  if (size < resolution)
    throw InputError(
        fmt::format("--plan: a size of {:g} m is below the resolution of {:g} m; the size comes first", size, resolution));
  fmt::print("{}", planned_case(size, resolution, asked.plan_ghz));
}

}  // namespace

void isar_command(const Request& request) {
  const ProductRequest& asked = request.product;
  if (asked.plan) return plan_image(asked);
  Product product{.names = {{"isar.png", "isar_pauli.png"}, {"isar.csv", "isar.vti", "isar.nc"}}, .netcdf = "isar.nc"};
  ProductSource& source = product.source;
  AngleGrid grid;
  IsarOptions options{asked.window, {}, asked.pixels};
  IsarImage image;
  product.check = [&] {
    const SweepSamples samples = samples_of(source.result, source.name);
    require_several(samples, source.name);
    grid = grid_of_looks(source.result, source.name);
    if (grid.scan && asked.direct)
      throw InputError(source.name + ": --direct takes angles in even steps, not places of a scan; leave it out");
    const std::vector<ImageAxis> axes = image_axes(samples, grid, asked.window);
    if (asked.size.size() > axes.size())
      throw InputError("--size: an image over one angle is in a plane and has no height; leave out the third length");
    options.frame = image_frame(samples, grid, asked.window, source.outermost(), asked.size, source.name);
    require_cells(axes, options, source.name);
  };
  product.make = [&] {
    const SweepSamples samples = samples_of(source.result, source.name);
    run_on_threads(request.threads, [&] {
      image =
          asked.direct ? direct_image(request, source, samples, grid, options) : isar_image(samples, grid, options, source.name);
    });
    return image_text(image, asked.window);
  };
  product.write_files = [&](const std::filesystem::path& folder) {
    write_isar_csv(folder / "isar.csv", image, asked.window);
    stop_if_interrupted();
    write_isar_vti(folder / "isar.vti", image);
  };
  product.write_netcdf = [&](const std::filesystem::path& file) {
    write_isar_netcdf(file, source.result, image, asked.window, source.lines());
  };
  product.drawn = "isar.csv";
  make_product(request, product);
}

}  // namespace raytube
