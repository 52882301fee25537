// raytube profile: a sweep of frequencies -> range profiles.
#include <fmt/format.h>

#include <algorithm>
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
#include "program/products.h"

namespace raytube {

namespace {

// The look in the middle alone.
std::size_t keep_middle_look(StoredResult& result) {
  const std::size_t look = middle_index(result.looks.size());
  result.looks = {result.looks[look]};
  return look;
}

std::vector<ScatteringMatrix> direct_sweep(const Request& request, const ProductSource& source, std::size_t look,
                                           const SweepSamples& samples) {
  DirectSweep direct(samples.frequency, samples.looks.front().transmit);
  direct_pieces(request, source, look, range_limits(samples.frequency, {}).cell / pieces_to_a_cell,
                [&](const PlacedScatterer& piece) { direct.add(piece); });
  return direct.scattering();
}

// Sweeps from several files may have a look twice.
void warn_of_repeated_looks(const ProductSource& source) {
  std::map<std::array<double, 6>, std::size_t> known;
  for (std::size_t i = 0; i < source.result.looks.size(); ++i) {
    const StoredLook& look = source.result.looks[i];
    const auto [first, is_new] =
        known.try_emplace({look.theta_deg, look.phi_deg, look.rx_theta_deg, look.rx_phi_deg, look.range_m, look.rx_range_m}, i);
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
  const RangeLimits& limits = profiles.limits;
  return fmt::format("range              resolution {:.4g} m ({} window), unambiguous {:.4g} m\n", limits.resolution,
                     name_of(window), limits.unambiguous);
}

}  // namespace

void profile_command(const Request& request) {
  const ProductRequest& asked = request.product;
  Product product{.names = {{"profile.png", "profile.svg", "waterfall.png", "waterfall.svg"}, {"profile.csv", "profile.nc"}},
                  .netcdf = "profile.nc"};
  ProductSource& source = product.source;
  std::size_t look = 0;  // of the pieces
  double middle = 0.0;
  RangeProfiles profiles;
  product.check = [&] {
    if (asked.direct) look = keep_middle_look(source.result);
    warn_of_repeated_looks(source);
    middle = middle_range(samples_of(source.result, source.name), source.outermost(), source.name);
  };
  product.make = [&] {
    SweepSamples samples = samples_of(source.result, source.name);
    if (asked.direct) samples.s = direct_sweep(request, source, look, samples);
    run_on_threads(request.threads, [&] { profiles = range_profiles(samples, {asked.window, asked.padding, middle}); });
    return limits_text(profiles, asked.window) + peak_text(source, profiles.peak);
  };
  product.write_files = [&](const std::filesystem::path& folder) {
    write_profile_csv(folder / "profile.csv", source.result, profiles, asked.window);
  };
  product.write_netcdf = [&](const std::filesystem::path& file) {
    write_profile_netcdf(file, source.result, profiles, asked.window);
  };
  product.drawn = "profile.csv";
  make_product(request, product);
}

}  // namespace raytube
