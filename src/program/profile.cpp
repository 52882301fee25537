// raytube profile: a sweep of frequencies -> range profiles.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "imaging/range_profile.h"
#include "jobs/centres_of_look.h"
#include "jobs/imaged_target.h"
#include "output/imaging/profile_plot.h"
#include "output/products/profile_csv.h"
#include "output/products/profile_netcdf.h"
#include "output/products/sweep_samples.h"
#include "output/tables/csv.h"
#include "program/products.h"

namespace raytube {

namespace {

ProductNames profile_names(const StoredResult& result) {
  ProductNames names{{{"profile.png", "profile.svg"}, {"profile.csv"}}, "profile.nc"};
  std::vector<std::string>& pictures = names.files.pictures;
  if (result.looks.size() > 1) pictures.insert(pictures.end(), {"waterfall.png", "waterfall.svg"});
  return names;
}

// S of each look from its pieces.
void fill_from_pieces(const Request& request, const ProductSource& source, SweepSamples& samples) {
  const double cell = range_limits(samples.frequency, {}).cell / pieces_to_a_cell;
  samples.s.clear();
  for (std::size_t look = 0; look < samples.looks.size(); ++look) {
    DirectSweep direct(samples.frequency, samples.looks[look].transmit);
    direct_pieces(request, source, look, cell, [&](const PlacedScatterer& piece) { direct.add(piece); });
    std::ranges::copy(direct.scattering(), std::back_inserter(samples.s));
  }
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

std::string peak_text(const ProductSource& source, const RangeProfiles& profiles) {
  const auto peak = std::ranges::max_element(profiles.s, {}, largest_amplitude);
  const auto index = static_cast<std::size_t>(peak - profiles.s.begin());
  const StoredLook& look = source.result.looks[index / profiles.range.count];
  return fmt::format("peak               {:.2f} dBsm at {:.4g} m beyond the origin, theta {:g}, phi {:g}\n",
                     sigma_dbsm(largest_amplitude(*peak)), profiles.range.at(index % profiles.range.count), look.theta_deg,
                     look.phi_deg);
}

std::string limits_text(const RangeProfiles& profiles, const Window& window) {
  const RangeLimits& limits = profiles.limits;
  return fmt::format("range              resolution {:.4g} m ({} window), unambiguous {:.4g} m\n", limits.resolution,
                     name_of(window), limits.unambiguous);
}

}  // namespace

void profile_command(const Request& request) {
  const ProductRequest& asked = request.product;
  ProductNames names;
  double middle = 0.0;
  const ProductSource source = product_source(request, [&](const ProductSource& unsolved) {
    names = profile_names(unsolved.result);
    check_products(request, unsolved, names);
    warn_of_repeated_looks(unsolved);
    middle = middle_range(samples_of(unsolved.result, unsolved.name), unsolved.outermost(), unsolved.name);
  });
  SweepSamples samples = samples_of(source.result, source.name);
  if (asked.direct) fill_from_pieces(request, source, samples);
  const RangeProfiles profiles = range_profiles(samples, {asked.window, asked.padding, middle});
  if (!request.quiet) fmt::print("{}{}", limits_text(profiles, asked.window), peak_text(source, profiles));
  const auto write_files = [&](const std::filesystem::path& folder) {
    write_profile_csv(folder / "profile.csv", source.result, profiles, asked.window);
    stop_if_interrupted();
    if (const std::string trouble = plot_profiles(folder, source.title, source.result, profiles); !trouble.empty()) warn(trouble);
  };
  write_products(request, source, names, {write_files, [&](const std::filesystem::path& file) {
                                            write_profile_netcdf(file, source.result, profiles, asked.window);
                                          }});
}

}  // namespace raytube
