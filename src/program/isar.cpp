// raytube isar: a sweep of frequencies and angles -> an image.
#include "imaging/isar.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/csv_reader.h"
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
#include "program/helping.h"
#include "program/products.h"

namespace raytube {

namespace {

constexpr const char* isar_examples =
    R"(Frequencies and one angle give an image in a plane; frequencies, azimuth and elevation an image in space. Writes isar.csv,
isar.png, isar_pauli.png and isar.vti (for ParaView). A case is run first, into the same folder; if that is interrupted,
finished looks are kept there for --resume. --plan prints the frequencies and looks that a target needs.

Examples:
  raytube isar --plan 6 0.1 --ghz 10
  raytube isar case.toml -o image
  raytube isar out/rcs.csv -o image --window hann --size 8x8)";

struct IsarRequest : SweepOptions {
  double pixels = 4.0;                        // cells of the image to a resolution cell
  std::vector<std::string> size_words;        // what follows --size; the last one may be the input
  std::vector<double> size;                   // of the image along its axes [m]; empty: the target's
  std::optional<std::array<double, 2>> plan;  // size and resolution of a target to plan for [m]; nothing is computed
  double plan_ghz = 10.0;                     // the middle of the planned band
};

IsarImage direct_image(const SweepOptions& asked, const ProductSource& source, const SweepSamples& samples, const AngleGrid& grid,
                       const IsarOptions& options) {
  double cell = std::numeric_limits<double>::infinity();
  for (const ImageAxis& axis : image_axes(samples, grid, options.window)) cell = std::min(cell, axis.cell / pieces_to_a_cell);
  DirectImage direct(samples, grid);
  const std::size_t middle =
      grid.looks[middle_index(grid.theta_deg.count) * grid.phi_deg.count + middle_index(grid.phi_deg.count)];
  direct_pieces(asked, source, middle, cell, [&](const PlacedScatterer& piece) { direct.add(piece); });
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

// The sections of a case for an image of a target of this size with cells of this resolution.
std::string planned_case(double size, double resolution, double ghz) {
  constexpr double room = 1.5;  // width of the image, in sizes of the target
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

void plan_image(const IsarRequest& asked) {
  const auto [size, resolution] = *asked.plan;
  const double band_ghz = 0.5e-9 * speed_of_light / resolution;
  if (band_ghz >= 2.0 * asked.plan_ghz)
    throw InputError(fmt::format(
        "--plan: a resolution of {:g} m takes a band of {:.4g} GHz, which does not fit around {:g} GHz; ask for a coarser "
        "one, or for a higher --ghz",
        resolution, band_ghz, asked.plan_ghz));
  if (size < resolution)
    throw InputError(
        fmt::format("--plan: a size of {:g} m is below the resolution of {:g} m; the size comes first", size, resolution));
  fmt::print("{}", planned_case(size, resolution, asked.plan_ghz));
}

void make_isar(const IsarRequest& asked) {
  Product product{.names = {{"isar.png", "isar_pauli.png"}, {"isar.csv", "isar.vti", "isar.nc"}},
                  .netcdf = "isar.nc",
                  .from_pieces = asked.direct};
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
    run_on_threads(asked.run.work.threads, [&] {
      image =
          asked.direct ? direct_image(asked, source, samples, grid, options) : isar_image(samples, grid, options, source.name);
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
  make_product(asked.run, product);
}

// The lengths of --size [m], "8 8", "8x8" or "8,8,2". If there is no input yet, the last word may be the input that follows them
// on the command line.
std::vector<double> lengths_of_size(const std::vector<std::string>& words, std::filesystem::path& input) {
  std::vector<double> lengths;
  for (const std::string& word : words) {
    const std::size_t before = lengths.size();
    for (std::size_t at = 0, end = 0; at <= word.size(); at = end + 1) {
      end = std::min(word.find_first_of("x,", at), word.size());
      const std::optional<double> length = parsed_number(word.substr(at, end - at));
      if (length && *length >= least_length && *length <= most_length) {
        lengths.push_back(*length);
        continue;
      }
      if (before < 2 || !input.empty() || &word != &words.back())
        throw InputError(
            fmt::format("--size: needs two lengths in metres, or three for an image in space, such as 8x8 (found {})", word));
      lengths.resize(before);
      input = word;
      break;
    }
  }
  if (!words.empty() && (lengths.size() < 2 || lengths.size() > 3))
    throw InputError(
        fmt::format("--size: needs two lengths in metres, or three for an image in space (found {})", fmt::join(words, " ")));
  return lengths;
}

// Options that do not go together.
void check_options(const CLI::App& isar, const IsarRequest& asked) {
  check_sidelobes(isar, asked.window);
  const bool has_input = !asked.run.input.file.empty();
  if (!asked.plan && !has_input)
    throw InputError("input is required: a result or a case, or --plan SIZE RESOLUTION; see raytube isar --help");
  if (asked.plan && has_input) throw InputError("--plan: computes nothing, and takes neither a result nor a case; leave one out");
  for (const char* option : {"--output", "--set", "--resume", "--size", "--pixels", "--window", "--sidelobes", "--direct"})
    if (asked.plan && isar.count(option) > 0)
      throw InputError(fmt::format("{}: has no effect with --plan; leave it out", option));
  if (!asked.plan && isar.count("--ghz") > 0) throw InputError("--ghz: has no effect without --plan; leave it out");
}

}  // namespace

CLI::App& add_isar(CommandLine& line) {
  const auto asked = std::make_shared<IsarRequest>();
  CLI::App& isar = add_command(line, "isar", "Image of a sweep over frequency and angle (ISAR)", isar_examples);
  add_sweep_input(isar, *asked, false);
  add_value(isar, "--size MxM[xM]", asked->size_words,
            "Size of the image along range, cross-range and height [m]: 8x8, or 8 8; default the target's")
      ->expected(1, 4);
  add_value(isar, "--pixels N", asked->pixels, "Cells of the image per resolution cell; default 4", number_between(1.0, 32.0));
  add_value(isar, "--plan SIZE RESOLUTION", asked->plan,
            "Print the sweep that a target of this size needs at this resolution [m]", number_between(least_length, most_length));
  add_value(isar, "--ghz F", asked->plan_ghz, "With --plan: the middle of the band; default 10", number_between(1e-6, 1e9));
  add_sweep_options(line, isar, *asked);
  const auto make = [asked, &isar] {
    asked->size = lengths_of_size(asked->size_words, asked->run.input.file);
    check_options(isar, *asked);
    asked->plan ? plan_image(*asked) : make_isar(*asked);
  };
  const auto help = [asked] {
    if (asked->plan) return;
    lengths_of_size(asked->size_words, asked->run.input.file);
    help_to_run(asked->run);
  };
  return set_action(line, isar, make, help);
}

}  // namespace raytube
