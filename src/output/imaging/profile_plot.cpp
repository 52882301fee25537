#include "output/imaging/profile_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/decimal.h"
#include "output/plots/curves.h"
#include "output/plots/cut_panel.h"
#include "output/plots/gnuplot.h"
#include "output/imaging/level_panels.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

constexpr double profile_range = 60.0;  // [dB] below the peak that a profile shows

std::span<const ScatteringMatrix> profile_of(const RangeProfiles& profiles, std::size_t look) {
  return std::span(profiles.s).subspan(look * profiles.range.count, profiles.range.count);
}

std::size_t strongest_look(const RangeProfiles& profiles) {
  const auto strongest = std::ranges::max_element(profiles.s, {}, largest_amplitude);
  return static_cast<std::size_t>(strongest - profiles.s.begin()) / profiles.range.count;
}

std::string look_text(const StoredLook& look) {
  return fmt::format("θ {}°, φ {}°", number_text(look.theta_deg), number_text(look.phi_deg));
}

std::string heading(const std::string& title, const RangeProfiles& profiles, const std::string& what) {
  return fmt::format("{}\n{}; resolution {:.3g} m, unambiguous {:.4g} m", title, what, profiles.limits.resolution,
                     profiles.limits.unambiguous);
}

std::string profile_data(std::span<const ScatteringMatrix> profile, const EvenAxis& range, double bottom) {
  std::string text = "$profile << EOD\n";
  for (std::size_t i = 0; i < profile.size(); ++i) {
    text += fmt::format("{:.6g}", range.at(i));
    for (const int channel : {0, 1, 2, 3})
      text += fmt::format(" {:.3f}", std::max(bottom - 1.0, sigma_dbsm(profile[i].at(channel / 2, channel % 2))));
    text += '\n';
  }
  return text + "EOD\n";
}

std::string curves(std::span<const ScatteringMatrix> profile, double bottom, double top) {
  std::string text;
  for (const int channel : {0, 1, 2, 3}) {
    const bool shown = std::ranges::any_of(
        profile, [&](const ScatteringMatrix& s) { return sigma_dbsm(s.at(channel / 2, channel % 2)) >= bottom; });
    text += shown ? fmt::format(", \\\n  $profile using 1:{} with lines ls {} title '{}'", channel + 2, channel + 1,
                                channel_titles[static_cast<std::size_t>(channel)])
                  : channel_below(channel, true, {bottom, top, bottom});
  }
  return text;
}

// A level line where all of an uncertainty would be at one range, of the stronger co-polar channel.
std::string floor_line(const ChannelErrors& errors, double bottom, const char* name, const char* color) {
  const double level = sigma_dbsm(std::max(errors[0][0], errors[1][1]));
  if (!(level >= bottom) || !std::isfinite(level)) return "";
  return fmt::format(", \\\n  {:.3f} with lines lc rgb '{}' lw 1.5 dt (4,4) title '{}, if all at one range'", level, color, name);
}

std::string profile_script(const std::string& terminal, const std::string& file, const std::string& title,
                           const StoredResult& result, const RangeProfiles& profiles) {
  const std::size_t look = strongest_look(profiles);
  const std::span<const ScatteringMatrix> profile = profile_of(profiles, look);
  double peak = sigma_dbsm(0.0);
  for (const ScatteringMatrix& s : profile) peak = std::max(peak, sigma_dbsm(largest_amplitude(s)));
  const double top = std::isfinite(peak) ? 5.0 * std::ceil(peak / 5.0 + 0.2) : 0.0, bottom = top - profile_range;
  std::string script =
      gnuplot_preamble(terminal, "1100,560", file) + channel_styles + profile_data(profile, profiles.range, bottom);
  script +=
      "set title " + gnuplot_quoted_lines(heading(title, profiles, "range profile, " + look_text(result.looks[look]))) + '\n';
  script += fmt::format(
      "set xlabel 'range beyond the origin (m)'\nset ylabel 'σ (dBsm)'\nset xrange [{}:{}]\nset yrange [{}:{}]\nset bmargin 9\n"
      "set key at screen 0.5, screen 0.08 center center horizontal maxcols 3\n",
      profiles.range.first, profiles.range.last(), bottom, top);
  script += "plot NaN notitle" + curves(profile, bottom, top) +
            floor_line(profiles.model[look], bottom, "model uncertainty", "#808080") +
            floor_line(profiles.error[look], bottom, "numerical error", "#b0b0b0");
  return script + "\nset output\n";
}

// The angle that varies alone from look to look in even steps, else their number.
PanelAxis look_axis(const StoredResult& result) {
  const auto evenly = [&](auto angle, const char* label) -> std::optional<PanelAxis> {
    const std::size_t count = result.looks.size();
    const EvenAxis axis{angle(result.looks.front()),
                        (angle(result.looks.back()) - angle(result.looks.front())) / static_cast<double>(count - 1), count};
    for (std::size_t i = 0; i < count; ++i)
      if (axis.step == 0.0 || std::abs(angle(result.looks[i]) - axis.at(i)) > 0.01 * std::abs(axis.step)) return {};
    return PanelAxis{axis, label};
  };
  const auto theta = evenly([](const StoredLook&look) { return look.theta_deg; }, "θ (°)"),
             phi = evenly([](const StoredLook&look) { return look.phi_deg; }, "φ (°)");
  if (phi) return *phi;
  if (theta) return *theta;
  return {{0.0, 1.0, result.looks.size()}, "look"};
}

LevelPanels waterfall(const std::string& title, const StoredResult& result, const RangeProfiles& profiles) {
  LevelPanels drawn{.heading = heading(title, profiles, "range profiles by look"),
                    .x = {profiles.range, "range beyond the origin (m)"},
                    .y = look_axis(result),
                    .level_label = "σ (dBsm)",
                    .panels = {}};
  for (const int channel : {0, 3}) {
    LevelPanel& panel = drawn.panels.emplace_back(LevelPanel{channel_titles[static_cast<std::size_t>(channel)], {}});
    for (const ScatteringMatrix& s : profiles.s) panel.levels.push_back(sigma_dbsm(s.at(channel / 2, channel % 2)));
  }
  return drawn;
}

}  // namespace

std::string plot_profiles(const std::filesystem::path& folder, const std::string& title, const StoredResult& result,
                          const RangeProfiles& profiles) {
  const std::string trouble = draw_pictures(folder, "profile", [&](const std::string& terminal, const std::string& file) {
    return profile_script(terminal, file, title, result, profiles);
  });
  if (result.looks.size() < 2) return trouble;
  const LevelPanels drawn = waterfall(title, result, profiles);
  const std::string of_waterfall = draw_pictures(folder, "waterfall", [&](const std::string& terminal, const std::string& file) {
    return level_panels_script(terminal, file, drawn);
  });
  return trouble.empty() ? of_waterfall : trouble;
}

}  // namespace raytube
