// raytube doppler: pulses of a scene that moves -> a range-Doppler map, a spectrogram or the cube of data.
#include "imaging/doppler.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "core/error.h"
#include "core/threads.h"
#include "output/products/doppler_csv.h"
#include "output/products/doppler_netcdf.h"
#include "output/products/sweep_samples.h"
#include "output/tables/csv.h"
#include "output/tables/stored.h"
#include "program/helping.h"
#include "program/products.h"

namespace raytube {

namespace {

constexpr const char* doppler_examples =
    R"(Of a case with [motion], or its result. Writes doppler.csv and doppler.png: of several frequencies a map over range and velocity,
of one the Doppler spectrum; with --spectrogram spectrogram.csv and .png, with --raw raw.nc. Velocities are towards the radar; the
Doppler frequency is 2 v / lambda.

Examples:
  raytube doppler out/rcs.csv
  raytube doppler case.toml -o doppler --window hann
  raytube doppler out/rcs.nc --spectrogram --window-length 64 --overlap 0.9
  raytube doppler out/rcs.nc --raw -o raw.nc)";

struct DopplerRequest : SweepOptions {
  SpectrogramOptions options;
  std::string mechanism;  // empty: all together
  bool spectrogram = false, raw = false, angle = false;
};

std::string limits_text(const AxisLimits& limits, double frequency, const Window& window) {
  const double hertz = 2.0 / wavelength(frequency);
  return fmt::format("velocity           resolution {:.4g} m/s ({:.4g} Hz, {} window), unambiguous {:.4g} m/s ({:.4g} Hz)\n",
                     limits.resolution, hertz * limits.resolution, name_of(window), limits.unambiguous,
                     hertz * limits.unambiguous);
}

std::string map_text(const DopplerMap& map, const Window& window) {
  std::string text, place;
  if (map.range_limits) {
    text = fmt::format("range              resolution {:.4g} m ({} window), unambiguous {:.4g} m\n", map.range_limits->resolution,
                       name_of(window), map.range_limits->unambiguous);
    place = fmt::format("{:.4g} m beyond the origin, ", map.peak.range);
  }
  text += limits_text(map.velocity_limits, map.frequency, window);
  if (map.cosine_limits) {
    text += fmt::format(
        "angle              along ({:.4g}, {:.4g}, {:.4g}): resolution of its cosine {:.4g}, unambiguous {:.4g}\n",
        map.array.x + 0.0, map.array.y + 0.0, map.array.z + 0.0, map.cosine_limits->resolution, map.cosine_limits->unambiguous);
    place += fmt::format("cosine {:.4g}, ", map.peak.cosine);
  }
  return text + fmt::format("peak               {:.2f} dBsm at {}{:.4g} m/s ({:.4g} Hz)\n", sigma_dbsm(map.peak.amplitude), place,
                            map.peak.velocity, map.doppler_of(map.peak.velocity));
}

std::string spectrogram_text(const Spectrogram& made, const Window& window) {
  return fmt::format("windows            {} of {} pulses, every {:.4g} s\n", made.time.count, made.length, made.time.step) +
         limits_text(made.velocity_limits, made.frequency, window);
}

void make_doppler(const DopplerRequest& asked) {
  const std::string name = asked.spectrogram ? "spectrogram" : "doppler";
  Product product{.names = {{name + ".png"}, {name + ".csv", name + ".nc"}}, .netcdf = name + ".nc", .drawn = name + ".csv"};
  if (asked.raw) product.names = {{}, {"raw.nc"}}, product.netcdf = "raw.nc", product.drawn = "";
  ProductSource& source = product.source;
  SpectrogramOptions options = asked.options;
  options.window = asked.window;
  DopplerMap map;
  Spectrogram made;
  product.check = [&] {
    if (asked.raw)
      pulse_grid(sweep_of(source.result).times, source.name);
    else
      require_pulses(samples_of(source.result, source.name), options, source.name);
  };
  product.make = [&] {
    if (asked.raw) return std::string();
    const SweepSamples samples = samples_of(source.result, source.name, asked.mechanism);
    run_on_threads(asked.run.work.threads, [&] {
      if (asked.spectrogram)
        made = spectrogram(samples, options, source.name);
      else
        map = (asked.angle ? range_doppler_angle : doppler_map)(samples, options, source.name);
    });
    return asked.spectrogram ? spectrogram_text(made, asked.window) : map_text(map, asked.window);
  };
  product.write_netcdf = [&](const std::filesystem::path& file) {
    if (asked.raw) return write_raw_netcdf(file, source.result, source.name);
    if (asked.spectrogram) return write_spectrogram_netcdf(file, source.result, made, asked.window);
    write_doppler_netcdf(file, source.result, map, asked.window);
  };
  product.write_files = [&](const std::filesystem::path& folder) {
    if (asked.raw) return product.write_netcdf(folder / "raw.nc");
    if (asked.spectrogram) return write_spectrogram_csv(folder / "spectrogram.csv", made, asked.window);
    write_doppler_csv(folder / "doppler.csv", map, asked.window);
  };
  make_product(asked.run, product);
}

}  // namespace

CLI::App& add_doppler(CommandLine& line) {
  const auto asked = std::make_shared<DopplerRequest>();
  SpectrogramOptions& options = asked->options;
  CLI::App& doppler = add_command(line, "doppler", "Range-Doppler map or spectrogram of a scene that moves", doppler_examples);
  add_sweep_input(doppler, *asked, true);
  CLI::Option* spectrogram =
      doppler.add_flag("--spectrogram", asked->spectrogram, "Velocities over time, from windows of pulses one after the other");
  CLI::Option* raw =
      doppler.add_flag("--raw", asked->raw, "S by pulse, frequency and receiver, with the places of antennas, as netCDF");
  CLI::Option* angle = doppler.add_flag(
      "--angle", asked->angle, "A map also over the angle: the looks of a pulse are antennas in even steps on a straight line");
  raw->excludes(spectrogram), angle->excludes(spectrogram), angle->excludes(raw);
  add_value(doppler, "--window-length N", options.length, "Pulses of a window; default the root of their number",
            whole_number(2, 1'000'000))
      ->needs(spectrogram);
  add_value(doppler, "--overlap SHARE", options.overlap, "Of a window with the next one; default 0.75",
            number_between(0.0, 0.999))
      ->needs(spectrogram);
  add_value(doppler, "--gate M", options.gate, "Width of the ranges that count, about --middle-range [m]; default all",
            number_between(0.0, most_length))
      ->needs(spectrogram);
  add_value(doppler, "--middle-range M", options.range,
            "Middle of the ranges [m]; default 0, the origin of the mesh's coordinates",
            number_between(-most_length, most_length));
  add_value(doppler, "--middle-velocity V", options.velocity, "Middle of the velocities [m/s]; default 0",
            number_between(-speed_of_light, speed_of_light));
  add_value(doppler, "--padding N", options.padding, "Ranges and velocities per resolution cell; default 2", whole_number(1, 64));
  add_value(doppler, "--look N", options.look, "Of the looks of a pulse this alone, from 0; default all",
            whole_number(0, 1'000'000))
      ->excludes(angle);
  add_value(doppler, "--mechanism NAME", asked->mechanism,
            "S of this mechanism alone, by the names of parts.csv; a case is run with --parts");
  add_window_options(doppler, asked->window);
  add_product_options(line, doppler, asked->run);
  const auto make = [asked, &doppler] {
    check_sidelobes(doppler, asked->window);
    asked->run.parts = !asked->mechanism.empty();
    make_doppler(*asked);
  };
  return set_action(line, doppler, make, [asked] { help_to_run(asked->run); });
}

}  // namespace raytube
