// raytube profile: a sweep of frequencies -> range profiles.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <map>

#include "core/threads.h"
#include "imaging/range_profile.h"
#include "jobs/centres_of_look.h"
#include "jobs/imaged_target.h"
#include "output/products/profile_csv.h"
#include "output/products/profile_netcdf.h"
#include "output/products/sweep_samples.h"
#include "output/tables/csv.h"
#include "program/helping.h"
#include "program/products.h"

namespace raytube {

namespace {

constexpr const char* profile_examples =
    R"(Writes profile.csv, profile.png and .svg, and for several looks waterfall.png and .svg. A case is run first, into the same
folder; if that is interrupted, finished looks are kept there for --resume.

Examples:
  raytube profile out/rcs.csv
  raytube profile case.toml -o profile --window hann
  raytube profile rcs.nc -o profile.nc --window taylor --sidelobes 50)";

struct ProfileRequest : SweepOptions {
  int padding = 4;  // ranges to a resolution cell
};

// Sweeps from several files may contain a look twice.
void warn_of_repeated_looks(const ProductSource& source) {
  std::map<std::array<double, 7>, std::size_t> known;
  for (std::size_t i = 0; i < source.result.looks.size(); ++i) {
    const StoredLook& look = source.result.looks[i];
    const auto [first, is_new] = known.try_emplace(
        {look.theta_deg, look.phi_deg, look.rx_theta_deg, look.rx_phi_deg, look.range_m, look.rx_range_m, look.time_s}, i);
    if (is_new) continue;
    return warn(fmt::format("{}: look {} (theta {:g}, phi {:g}) has the directions of look {}; both are shown", source.name, i,
                            look.theta_deg, look.phi_deg, first->second));
  }
}

std::string peak_text(const ProductSource& source, const RangePeak& peak) {
  const StoredLook& look = source.result.looks[peak.look];
  return fmt::format("peak               {:.2f} dBsm at {:.4g} m beyond the origin, theta {:g}, phi {:g}\n",
                     sigma_dbsm(peak.amplitude), peak.range, look.theta_deg, look.phi_deg);
}

std::string limits_text(const RangeProfiles& profiles, const Window& window) {
  const AxisLimits& limits = profiles.limits;
  return fmt::format("range              resolution {:.4g} m ({} window), unambiguous {:.4g} m\n", limits.resolution,
                     name_of(window), limits.unambiguous);
}

void make_profile(const ProfileRequest& asked) {
  Product product{.names = {{"profile.png", "profile.svg", "waterfall.png", "waterfall.svg"}, {"profile.csv", "profile.nc"}},
                  .netcdf = "profile.nc",
                  .from_pieces = asked.direct};
  ProductSource& source = product.source;
  std::size_t look = 0;  // of the direct sweep
  double middle = 0.0;
  RangeProfiles profiles;
  product.check = [&] {
    look = middle_index(source.result.looks.size());
    if (asked.direct) source.result.looks = {source.result.looks[look]};
    warn_of_repeated_looks(source);
    middle = middle_range(samples_of(source.result, source.name), source.outermost(), source.name);
  };
  product.make = [&] {
    SweepSamples samples = samples_of(source.result, source.name);
    if (asked.direct) {
      DirectSweep direct(samples.frequency, samples.looks.front().transmit);
      const double cell = range_limits(samples.frequency, {}).cell / pieces_to_a_cell;
      direct_pieces(asked, source, look, cell, [&](const PlacedScatterer& piece) { direct.add(piece); });
      samples.s = direct.scattering();
    }
    run_on_threads(asked.run.work.threads, [&] { profiles = range_profiles(samples, {asked.window, asked.padding, middle}); });
    return limits_text(profiles, asked.window) + peak_text(source, profiles.peak);
  };
  product.write_files = [&](const std::filesystem::path& folder) {
    write_profile_csv(folder / "profile.csv", source.result, profiles, asked.window);
  };
  product.write_netcdf = [&](const std::filesystem::path& file) {
    write_profile_netcdf(file, source.result, profiles, asked.window);
  };
  product.drawn = "profile.csv";
  make_product(asked.run, product);
}

}  // namespace

CLI::App& add_profile(CommandLine& line) {
  const auto asked = std::make_shared<ProfileRequest>();
  CLI::App& profile =
      add_command(line, "profile", "Range profiles of a sweep over frequency, and their waterfall", profile_examples);
  add_sweep_input(profile, *asked, true);
  add_value(profile, "--padding N", asked->padding, "Ranges per resolution cell; default 4", whole_number(1, 64));
  add_sweep_options(line, profile, *asked);
  const auto make = [asked, &profile] {
    check_sidelobes(profile, asked->window);
    make_profile(*asked);
  };
  return set_action(line, profile, make, [asked] { help_to_run(asked->run); });
}

}  // namespace raytube
