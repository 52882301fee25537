#include "output/plots/parts_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "output/plots/cut_panel.h"
#include "output/plots/gnuplot.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

constexpr std::array<int, 2> shown_channels = {0, 3};  // VV and HH
constexpr std::array<const char*, 8> mechanism_colors = {"#1f5fbf", "#d9480f", "#2e8b3d", "#8e44ad",
                                                         "#b8860b", "#17a2b8", "#c2437f", "#7f5539"};

struct MechanismCurve {
  std::string label, style;
  DrawnCut drawn;

  bool has_anything(int channel) const {
    return std::ranges::any_of(drawn.cut.sigma_dbsm[channel], [](double level) { return std::isfinite(level); });
  }
};

// That through the peak.
CutRows chosen_rows(const CutPlan& plan, const SweepResult& result) {
  return plan.cuts[choice_with(plan.cuts, peak_row(result), 1).front()];
}

// All together first, then bounce by bounce, then what is dashed: all else.
std::vector<MechanismCurve> curves_by_mechanism(const CutPlan& plan, const Sweep& sweep, const SweepResult& result,
                                                std::span<const dvec3> outermost) {
  const CutRows rows = chosen_rows(plan, result);
  std::vector<MechanismCurve> curves;
  const auto add = [&](const std::string& label, const std::string& style, const std::vector<ScatteringMatrix>& s) {
    curves.push_back({label, style, drawn_cut(curves_of(rows, plan.quantity, s), sweep, outermost)});
  };
  const auto color = [&] { return mechanism_colors[(curves.size() - 1) % mechanism_colors.size()]; };
  add("all together", "lc rgb '#000000' lw 3", result.total);
  for (std::size_t m = 0; m < result.bounces.size(); ++m)
    add(part_label(fmt::format("bounce{}", m + 1)), fmt::format("lc rgb '{}' lw 2", color()), result.bounces[m]);
  for (const Part part : all_parts)
    add(part_label(column_of(part)), fmt::format("lc rgb '{}' lw 2 dt (8,5)", color()), result.parts[part]);
  return curves;
}

Scale common_scale(const std::vector<MechanismCurve>& curves) {
  std::vector<Cut> cuts;
  for (const MechanismCurve& curve : curves) cuts.push_back(curve.drawn.cut);
  return scale_of(cuts);
}

// Of rows that may not be joined the median of sectors, where there are any.
std::string curve_text(std::size_t number, const MechanismCurve& curve, int channel, const Scale& scale) {
  if (!curve.has_anything(channel)) return "";
  if (!is_shown(curve.drawn.cut, channel, scale))
    return fmt::format(", \\\n     keyentry with lines {} title '{} < {:.0f} dBsm'", curve.style, curve.label, scale.floor);
  if (curve.drawn.sectors)
    return fmt::format(", \\\n     $sectors{} using 1:{} with lines {} title '{}'", number, 3 * channel + 3, curve.style,
                       curve.label);
  return fmt::format(", \\\n     $cut{} using 1:{} with {} {} pt 7 ps 0.5 title '{}'", number, channel + 2,
                     curve_style(curve.drawn.cut.x.size(), curve.drawn.joined), curve.style, curve.label);
}

std::string parts_panel(const std::vector<MechanismCurve>& curves, int channel, const Scale& scale) {
  const DrawnCut& drawn = curves.front().drawn;
  const std::string fixed = drawn.cut.fixed.empty() ? "" : "; " + drawn.cut.fixed;
  std::string text = "set title " + gnuplot_quoted(channel_titles[channel] + fixed) + '\n';
  text += drawn.sectors ? fmt::format("set key title 'median of sectors of {}'\n", width_text(drawn)) : "set key notitle\n";
  text += xrange_of(drawn.cut) + "plot NaN notitle";
  for (std::size_t i = 0; i < curves.size(); ++i) text += curve_text(i, curves[i], channel, scale);
  return text + '\n';
}

std::string parts_heading(const std::string& title, const CutPlan& plan) {
  const char* which = plan.cuts.size() > 1 ? " (cut through the peak)" : "";
  return title + ": by mechanism, which add up with their phases" + which;
}

}  // namespace

std::string parts_plot_script(const std::string& terminal, const std::string& file, const std::string& title, const Sweep& sweep,
                              const SweepResult& result, std::span<const dvec3> outermost) {
  const CutPlan plan = plan_cuts(coordinates_of_rows(sweep));
  const std::vector<MechanismCurve> curves = curves_by_mechanism(plan, sweep, result, outermost);
  const Scale scale = common_scale(curves);
  std::string script = gnuplot_preamble(terminal, "1200,1000", file);
  script += fmt::format("set xlabel '{}'\nset ylabel 'σ (dBsm)'\nset yrange [{}:{}]\n", plan.axis, scale.bottom, scale.top);
  for (std::size_t i = 0; i < curves.size(); ++i) script += cut_data(i, curves[i].drawn, scale);
  script += "set multiplot layout 2,1 title " + gnuplot_quoted(parts_heading(title, plan)) + '\n';
  for (const int channel : shown_channels) script += parts_panel(curves, channel, scale);
  return script + "unset multiplot\nset output\n";
}

std::string plot_parts(const std::filesystem::path& folder, const std::string& title, const Sweep& sweep,
                       const SweepResult& result, std::span<const dvec3> outermost) {
  const std::string trouble = draw_pictures(folder, "parts", [&](const std::string& terminal, const std::string& file) {
    return parts_plot_script(terminal, file, title, sweep, result, outermost);
  });
  return trouble.empty() ? "" : fmt::format("no plot by mechanism: {}; parts.csv holds the numbers", trouble);
}

}  // namespace raytube
