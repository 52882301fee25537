#include "output/imaging/centres_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "output/imaging/level_panels.h"
#include "output/plots/curves.h"
#include "output/plots/gnuplot.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

constexpr double shown_range = 40.0;  // [dB] below the strongest
constexpr std::size_t numbered = 10;  // as many as the command lists
constexpr double plot_width = 820.0, least_height = 260.0, most_height = 820.0, around_width = 280.0, around_height = 180.0;
constexpr double weakest_size = 0.7, strongest_size = 2.2, rim = 0.35;

// Word and symbol of gnuplot, in the order of scattering_mechanisms.
struct Symbol {
  const char* word;
  int type;
};
constexpr std::array<Symbol, scattering_mechanisms.size()> symbols = {{{"bounce 1", 7},
                                                                       {"bounce 2", 5},
                                                                       {"bounce 3 and later", 9},
                                                                       {"edges", 13},
                                                                       {"edge–face interaction", 11},
                                                                       {"waves over curved surfaces", 15}}};

double level_of(const ScatteringCentre& centre) { return sigma_dbsm(std::max(std::abs(centre.s.vv()), std::abs(centre.s.hh()))); }

struct Dot {
  dvec2 at;
  double level;
  std::size_t mechanism, number;  // from 1
};

// The strongest last, which lies over the others.
std::vector<Dot> dots_of(const ScatteringCentres& found, const LookAxes& axes) {
  std::vector<Dot> dots;
  double top = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < found.centres.size(); ++i) {
    const ScatteringCentre& centre = found.centres[i];
    dots.push_back({{glm::dot(centre.place, axes.cross_range), glm::dot(centre.place, axes.range)},
                    level_of(centre),
                    centre.mechanism(),
                    i + 1});
    top = std::max(top, dots.back().level);
  }
  std::erase_if(dots, [&](const Dot& dot) { return !(dot.level >= top - shown_range); });
  std::ranges::stable_sort(dots, {}, &Dot::level);
  return dots;
}

struct Extent {
  dvec2 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

  void hold(const dvec2& point) { low = glm::min(low, point), high = glm::max(high, point); }
  dvec2 size() const { return high - low; }
};

// Round what is drawn, with a margin.
Extent extent_of(const std::vector<Dot>& dots, const std::vector<std::array<dvec2, 2>>& lines) {
  Extent extent;
  for (const Dot& dot : dots) extent.hold(dot.at);
  for (const auto& [begin, end] : lines) extent.hold(begin), extent.hold(end);
  if (!(extent.low.x <= extent.high.x)) extent.hold(dvec2(0.0));
  const double margin = std::max(0.05 * std::max(extent.size().x, extent.size().y), 1e-6);
  return {extent.low - margin, extent.high + margin};
}

// x, y, size, symbol, level a row.
std::string dots_data(const std::vector<Dot>& dots, double top) {
  std::string text = "$dots << EOD\n";
  for (const Dot& dot : dots) {
    const double share = 1.0 - (top - dot.level) / shown_range;
    text += fmt::format("{:.6g} {:.6g} {:.3f} {} {:.2f}\n", dot.at.x, dot.at.y,
                        weakest_size + (strongest_size - weakest_size) * share, symbols[dot.mechanism].type, dot.level);
  }
  return text + "EOD\n";
}

struct Label {
  dvec2 at;
  std::string text;
};

// Numbers of the first, those that would cover one another as one.
std::string numbers_data(std::vector<Dot> dots, double apart) {
  std::ranges::sort(dots, {}, &Dot::number);
  std::vector<Label> labels;
  for (const Dot& dot : dots) {
    if (dot.number > numbered) break;
    const auto near = std::ranges::find_if(labels, [&](const Label& label) { return glm::distance(label.at, dot.at) < apart; });
    if (near == labels.end())
      labels.push_back({dot.at, std::to_string(dot.number)});
    else
      near->text += fmt::format(", {}", dot.number);
  }
  std::string text = "$numbers << EOD\n";
  for (const Label& label : labels) text += fmt::format("{:.6g} {:.6g} \"{}\"\n", label.at.x, label.at.y, label.text);
  return text + "EOD\n";
}

std::string canvas_of(const Extent& extent) {
  const double height = std::clamp(plot_width * extent.size().y / extent.size().x, least_height, most_height);
  return fmt::format("{:.0f},{:.0f}", plot_width + around_width, height + around_height);
}

std::string key_of(const std::vector<Dot>& dots) {
  std::string text;
  for (std::size_t i = 0; i < symbols.size(); ++i)
    if (std::ranges::find(dots, i, &Dot::mechanism) != dots.end())
      text += fmt::format(", \\\n     keyentry with points pt {} ps 1.4 lc rgb '#404040' title '{}'", symbols[i].type,
                          symbols[i].word);
  return text;
}

std::string words_of(const CentresHeading& heading, std::size_t shown, std::size_t all) {
  return fmt::format("{}\n{}; {} of {} within {} dB of the strongest", heading.title, heading.look, shown, all, shown_range);
}

std::string axes_of(const Extent& extent, double top) {
  return fmt::format(
      "set size ratio -1\nset key below center horizontal\nset bmargin 6\nset xlabel 'cross-range (m)'\nset ylabel 'range, away "
      "from the radar (m)'\nset xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\n"
      "set cbrange [{}:{}]\nset cblabel 'σ of VV or HH, the larger (dBsm)'\n",
      extent.low.x, extent.high.x, extent.low.y, extent.high.y, top - shown_range, top);
}

// Each dot has a rim, which keeps bright ones apart from the page.
std::string dots_plot(const std::vector<Dot>& dots) {
  if (dots.empty()) return "";
  return fmt::format(
             ", \\\n     $dots using 1:2:($3+{}):4 with points ps variable pt variable lc rgb '#202020' notitle, \\\n     $dots "
             "using 1:2:3:4:5 with points ps variable pt variable lc palette notitle, \\\n     $numbers using 1:2:3 with labels "
             "offset char 1.2,0.7 notitle",
             rim) +
         key_of(dots);
}

std::string centres_script(const std::string& terminal, const std::string& file, const CentresHeading& heading,
                           const ScatteringCentres& found, const LookAxes& axes,
                           std::span<const std::array<dvec3, 2>> target_lines) {
  const std::vector<Dot> dots = dots_of(found, axes);
  const std::vector<std::array<dvec2, 2>> lines = projected(target_lines, axes.cross_range, axes.range);
  const Extent extent = extent_of(dots, lines);
  const double top = dots.empty() ? 0.0 : std::ceil(dots.back().level);
  std::string script = gnuplot_preamble(terminal, canvas_of(extent), file) + level_palette + lines_data(lines) +
                       dots_data(dots, top) + numbers_data(dots, 0.02 * std::max(extent.size().x, extent.size().y));
  script += "set title " + gnuplot_quoted_lines(words_of(heading, dots.size(), found.centres.size())) + '\n';
  script += axes_of(extent, top);
  script += "plot NaN notitle";
  if (!lines.empty()) script += ", \\\n     $lines using 1:2 with lines lc rgb '#a0a0a0' lw 0.8 notitle";
  return script + dots_plot(dots) + "\nset output\n";
}

}  // namespace

std::string plot_centres(const std::filesystem::path& folder, const CentresHeading& heading, const ScatteringCentres& found,
                         const LookAxes& axes, std::span<const std::array<dvec3, 2>> target_lines) {
  return draw_pictures(folder, "centres", [&](const std::string& terminal, const std::string& file) {
    return centres_script(terminal, file, heading, found, axes, target_lines);
  });
}

}  // namespace raytube
