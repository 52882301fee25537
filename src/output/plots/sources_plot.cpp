#include "output/plots/sources_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/decimal.h"
#include "output/plots/gnuplot.h"

namespace raytube {

namespace {

constexpr std::size_t most_points = 20000;  // in one panel: more only cover one another
constexpr double least_error_percent = 1e-6, least_seconds = 1e-6;

constexpr const char* model_styles =
    "set style line 1 lc rgb '#888888' lw 2 pt 7 ps 0.9\nset style line 2 lc rgb '#1f5fbf' lw 2 pt 5 ps 0.9\n"
    "set style line 3 lc rgb '#2e8b3d' lw 2 pt 9 ps 1.1\nset style line 4 lc rgb '#d9480f' lw 2 pt 11 ps 1.1\n"
    "set style line 5 lc rgb '#8e44ad' lw 2 pt 13 ps 1.1\nset style line 6 lc rgb '#b8860b' lw 2 pt 6 ps 1.1\n"
    "set style line 7 lc rgb '#000000' lw 1.5 dt (8,6)\n";

int style(LaunchModel model) { return static_cast<int>(model) + 1; }

std::string panel_layout(std::size_t panels) {
  const std::size_t columns = panels < 3 ? panels : panels < 5 ? 2 : 3;
  return fmt::format("{},{}", (panels + columns - 1) / columns, columns);
}

std::string canvas_of_panels(std::size_t panels) { return panels < 3 ? "1400,640" : panels < 5 ? "1300,1000" : "1700,1000"; }

// ---- launch points

// 1, 2 or 5 times a power of ten, about a third of the extent.
double tic_step(double extent) {
  const double third = extent / 3.0, decade = std::pow(10.0, std::floor(std::log10(third)));
  return decade * (third < 2.0 * decade ? 1.0 : third < 5.0 * decade ? 2.0 : 5.0);
}

// Equal scale and step on all axes. A thin one has its two ends as tics, and room round what has no thickness at all.
std::string equal_axes(const std::vector<dvec3>& points) {
  dvec3 low(INFINITY), high(-INFINITY);
  for (const dvec3& p : points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const double largest = std::max({high.x - low.x, high.y - low.y, high.z - low.z, 1e-6}), step = tic_step(largest);
  std::string text;
  for (const int axis : {0, 1, 2}) {
    const double size = high[axis] - low[axis], margin = (size < 0.01 * largest ? 0.15 : 0.03) * largest;
    text += fmt::format("set {}range [{:.6g}:{:.6g}]\n", "xyz"[axis], low[axis] - margin, high[axis] + margin);
    text += size > step ? fmt::format("set {}tics {:.6g}\n", "xyz"[axis], step)
                        : fmt::format("set {0}tics ({1:.3g}, {2:.3g})\n", "xyz"[axis], low[axis], high[axis]);
  }
  return text + fmt::format("set xyplane at {:.6g}\n", low.z - 0.03 * largest);
}

std::string launch_panel(const SourceView& view) {
  std::string text = "$points << EOD\n";
  for (const dvec3& p : view.launch_points) text += fmt::format("{:.6g} {:.6g} {:.6g}\n", p.x, p.y, p.z);
  const bool all = view.launch_points.size() == view.launched;
  const std::string which = all ? "" : fmt::format(", {} of them shown", view.launch_points.size());
  return text + "EOD\n" + equal_axes(view.launch_points) +
         fmt::format("set title '{}: {} rays{}'\nsplot $points with points pt 7 ps 0.25 lc rgb '#1f5fbf' notitle\n",
                     launch_model_name(view.model), view.launched, which);
}

std::string launch_script(const std::string& terminal, const std::string& file, const SourceStudy& study) {
  std::string script = gnuplot_preamble(terminal, canvas_of_panels(study.views.size()), file);
  script += fmt::format("set multiplot layout {} title {}\n", panel_layout(study.views.size()),
                        gnuplot_quoted(study.title + ": launch points, which the rays go through or start from"));
  script += "set xlabel 'x (m)'\nset ylabel 'y (m)'\nset zlabel 'z (m)' rotate\nset view 62,28,1.25\nset view equal xyz\n";
  for (const SourceView& view : study.views) script += launch_panel(view);
  return script + "unset multiplot\nset output\n";
}

// ---- hits on the counted part

// The two axes along which the hits spread most, and their bounds.
struct HitFrame {
  std::array<int, 2> axes{0, 1};
  dvec2 low{0.0}, high{1.0};
  std::uint32_t most_bounces = 1;
};

HitFrame frame_of(const SourceStudy& study) {
  HitFrame frame;
  dvec3 low(INFINITY), high(-INFINITY);
  for (const SourceView& view : study.views)
    for (const CountedHit& hit : view.hits) {
      low = glm::min(low, hit.point);
      high = glm::max(high, hit.point);
      frame.most_bounces = std::max(frame.most_bounces, hit.bounce);
    }
  const dvec3 size = high - low;
  if (!(size.x >= 0.0)) return frame;  // not one hit
  const int thin = size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2;
  frame.axes = {thin == 0 ? 1 : 0, thin == 2 ? 1 : 2};
  for (const int i : {0, 1}) {
    const double margin = 0.02 * size[frame.axes[i]] + 1e-6;
    frame.low[i] = low[frame.axes[i]] - margin;
    frame.high[i] = high[frame.axes[i]] + margin;
  }
  return frame;
}

std::string hits_panel(const SourceView& view, const std::array<int, 2>& axes) {
  const std::size_t step = std::max<std::size_t>(1, (view.hits.size() + most_points - 1) / most_points);
  std::string text = "$hits << EOD\n";
  for (std::size_t i = 0; i < view.hits.size(); i += step) {
    const CountedHit& hit = view.hits[i];
    text += fmt::format("{:.6g} {:.6g} {}\n", hit.point[axes[0]], hit.point[axes[1]], hit.bounce);
  }
  const std::string which = step == 1 ? "" : fmt::format(" (1 in {} shown)", step);
  text += fmt::format("EOD\nset title '{}: {} rays, {} hits{}'\n", launch_model_name(view.model), view.traced, view.hits.size(),
                      which);
  // gnuplot draws no panel without a point.
  const char* points = view.hits.empty() ? "NaN" : "$hits using 1:2:3 with points pt 7 ps 0.3 lc palette";
  return text + fmt::format("plot {} notitle\n", points);
}

std::string hits_script(const std::string& terminal, const std::string& file, const SourceStudy& study) {
  const HitFrame frame = frame_of(study);
  const bool wide = frame.high.x - frame.low.x > 2.0 * (frame.high.y - frame.low.y);
  const std::size_t panels = study.views.size();
  std::string script =
      gnuplot_preamble(terminal, wide ? fmt::format("1500,{}", 60 + 300 * ((panels + 1) / 2)) : canvas_of_panels(panels), file);
  script += fmt::format("set multiplot layout {} title {}\n", wide ? fmt::format("{},2", (panels + 1) / 2) : panel_layout(panels),
                        gnuplot_quoted(study.title + ": hits on " + study.part_names[study.counted]));
  script += fmt::format("set xlabel '{} (m)'\nset ylabel '{} (m)'\nset size ratio -1\nset cblabel 'bounces before'\n",
                        "xyz"[frame.axes[0]], "xyz"[frame.axes[1]]);
  script += "set palette defined (0 '#1f5fbf', 0.15 '#2e8b3d', 0.5 '#e0b000', 1 '#d9480f')\n";
  script += fmt::format("set cbrange [0:{}]\nset xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\n", frame.most_bounces,
                        frame.low.x, frame.high.x, frame.low.y, frame.high.y);
  for (const SourceView& view : study.views) script += hits_panel(view, frame.axes);
  return script + "unset multiplot\nset output\n";
}

// ---- errors against rays and time

// Relative error of a share of the counted part [% of the exact one]; NaN where that is 0 or not known.
double error_percent(double share, const PartHits& part) {
  const double error = 100.0 * std::abs(share - part.exact) / part.exact;
  return std::isfinite(error) ? std::max(error, least_error_percent) : not_known;
}

// Rays, seconds, error of the direct share, error of the weighted estimate.
std::array<double, 4> error_row(const SourceRun& run, std::size_t counted) {
  const PartHits& part = run.parts[counted];
  const double rays = static_cast<double>(run.rays);
  return {rays, std::max(run.seconds, least_seconds), error_percent(static_cast<double>(part.first_hits) / rays, part),
          error_percent(part.estimate, part)};
}

std::string error_block(const SourceStudy& study, LaunchModel model) {
  std::string text = fmt::format("$model{} << EOD\n", style(model));
  for (const SourceRun& run : study.runs)
    if (run.model == model) {
      const auto [rays, seconds, direct, weighted] = error_row(run, study.counted);
      text += fmt::format("{:.6g} {:.6g} {:.6g} {:.6g}\n", rays, seconds, direct, weighted);
    }
  return text + "EOD\n";
}

// Whole decades round a column; gnuplot draws nothing, not even axes, if it has to find them without a point.
std::string decades(const SourceStudy& study, char axis, int column) {
  double low = INFINITY, high = 0.0;
  for (const SourceRun& run : study.runs) {
    const double value = error_row(run, study.counted)[column];
    if (std::isnan(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (high == 0.0) low = high = 1.0;
  const double bottom = std::floor(std::log10(low)), top = std::ceil(std::log10(high));
  return fmt::format("set {}range [1e{}:1e{}]\n", axis, bottom, top > bottom ? top : bottom + 1.0);
}

std::string error_panel(const SourceStudy& study, int x, int y, const char* title) {
  std::string text = decades(study, 'x', x) + decades(study, 'y', y);
  text += fmt::format("set title '{}'\nset xlabel '{}'\nplot NaN notitle", title, x == 0 ? "rays" : "seconds");
  for (const SourceView& view : study.views) {
    if (y == 3 && view.model == LaunchModel::plane_wave) continue;
    text += fmt::format(", \\\n     $model{0} using {1}:{2} with linespoints ls {0} title '{3}'", style(view.model), x + 1, y + 1,
                        launch_model_name(view.model));
  }
  return text + '\n';
}

std::string errors_script(const std::string& terminal, const std::string& file, const SourceStudy& study) {
  std::string script = gnuplot_preamble(terminal, "1500,1000", file) + model_styles;
  for (const SourceView& view : study.views) script += error_block(study, view.model);
  script += "set logscale xy\nset format '%g'\nset ylabel 'error (% of the exact share)'\n";
  script +=
      fmt::format("set multiplot layout 2,2 title {}\n",
                  gnuplot_quoted(study.title + ": error of the directly hit solid angle of " + study.part_names[study.counted]));
  const char *counted = "share of the rays, as counted", *weighted = "each ray weighted by its solid angle";
  script += error_panel(study, 0, 2, counted) + error_panel(study, 1, 2, counted);
  script += error_panel(study, 0, 3, weighted) + error_panel(study, 1, 3, weighted);
  return script + "unset multiplot\nset output\n";
}

// ---- shares against the position of the source, counted from 0

std::string response_block(const SourceStudy& study, LaunchModel model, std::uint64_t asked) {
  std::string text = fmt::format("$model{} << EOD\n", style(model));
  for (const SourceRun& run : study.runs) {
    if (run.model != model || run.rays_asked != asked) continue;
    const PartHits& part = run.parts[study.counted];
    const auto value = [](double share) { return std::isnan(share) ? std::string("NaN") : fmt::format("{:.6g}", 100.0 * share); };
    text += fmt::format("{} {} {} {}\n", run.position, value(part.response), value(part.estimate), value(part.exact));
  }
  return text + "EOD\n";
}

std::string response_script(const std::string& terminal, const std::string& file, const SourceStudy& study) {
  std::uint64_t asked = 0;
  for (const SourceRun& run : study.runs) asked = std::max(asked, run.rays_asked);
  std::string script = gnuplot_preamble(terminal, "1400,900", file) + model_styles;
  for (const SourceView& view : study.views) script += response_block(study, view.model, asked);
  script +=
      fmt::format("set multiplot layout 2,1 title {}\n",
                  gnuplot_quoted(fmt::format("{}: {}, about {} rays", study.title, study.part_names[study.counted], asked)));
  script += "set xlabel 'position of the source, counted from 0'\nset ylabel 'percent'\n";
  const auto panel = [&](const char* title, int column) {
    std::string text = fmt::format("set title '{}'\nplot NaN notitle", title);
    for (const SourceView& view : study.views)
      if (view.model != LaunchModel::plane_wave)
        text += fmt::format(", \\\n     $model{0} using 1:{2} with linespoints ls {0} title '{1}'", style(view.model),
                            launch_model_name(view.model), column);
    if (column == 3)
      text += fmt::format(", \\\n     $model{} using 1:4 with lines ls 7 title 'exact'", style(study.views[0].model));
    return text + '\n';
  };
  script += panel("direct and reflected: hits per hundred rays of a source that shines alike in all directions", 2) +
            panel("direct: share of the full solid angle", 3);
  return script + "unset multiplot\nset output\n";
}

}  // namespace

std::string plot_sources(const std::filesystem::path& folder, const SourceStudy& study) {
  using Script = std::string (*)(const std::string&, const std::string&, const SourceStudy&);
  // Parallel rays know no position.
  const bool one_position =
      study.runs.empty() || study.runs.back().position == 0 ||
      std::ranges::all_of(study.views, [](const SourceView& view) { return view.model == LaunchModel::plane_wave; });
  const std::array<std::pair<const char*, Script>, 3> pictures = {
      {{"launch", launch_script}, {"hits", hits_script}, {"sources", one_position ? errors_script : response_script}}};
  for (const auto& [name, script] : pictures) {
    const std::string trouble = draw_pictures(
        folder, name,
        [&, &draw = script](const std::string& terminal, const std::string& file) { return draw(terminal, file, study); });
    if (!trouble.empty()) return fmt::format("no picture \"{}\": {}; sources.csv holds the numbers", name, trouble);
  }
  return "";
}

}  // namespace raytube
