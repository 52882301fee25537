#include "output/imaging/level_panels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "output/plots/curves.h"
#include "output/plots/gnuplot.h"

namespace raytube {

namespace {

constexpr std::size_t most_dots_along = 600;  // about the pixels of a panel
constexpr double most_panel_width = 560.0, most_panel_height = 560.0, least_panel_side = 160.0, usual_panel_height = 420.0;
constexpr double least_panels_left = 90.0, panels_right = 120.0, panels_top = 90.0, gap_below = 110.0, panels_bottom = 70.0;

// Blocks of values, each a dot.
struct DotsAlong {
  std::size_t values, together;
  EvenAxis dots;
};

DotsAlong dots_along(const EvenAxis& axis) {
  const std::size_t together = (axis.count + most_dots_along - 1) / most_dots_along,
                    dots = (axis.count + together - 1) / together;
  const double step = axis.count > 1 ? axis.step : 1.0;
  return {axis.count,
          together,
          {axis.first + 0.5 * step * static_cast<double>(together - 1), step * static_cast<double>(together), dots}};
}

double strongest(const std::vector<double>& levels, const DotsAlong& x, const DotsAlong& y, std::size_t column, std::size_t row) {
  double level = -std::numeric_limits<double>::infinity();
  for (std::size_t j = row * y.together; j < std::min((row + 1) * y.together, y.values); ++j)
    for (std::size_t i = column * x.together; i < std::min((column + 1) * x.together, x.values); ++i)
      level = std::max(level, levels[j * x.values + i]);
  return level;
}

std::string dots_data(std::size_t number, const std::vector<double>& levels, const DotsAlong& x, const DotsAlong& y,
                      double bottom) {
  std::string text = fmt::format("$levels{} << EOD\n", number);
  for (std::size_t row = 0; row < y.dots.count; ++row) {
    for (std::size_t column = 0; column < x.dots.count; ++column)
      text += fmt::format("{:.1f} ", std::max(bottom, strongest(levels, x, y, column, row)));
    text += '\n';
  }
  return text + "EOD\n";
}

double top_of(const LevelPanels& drawn) {
  double top = -std::numeric_limits<double>::infinity();
  for (const LevelPanel& panel : drawn.panels) top = std::max(top, std::ranges::max(panel.levels));
  return std::isfinite(top) ? std::ceil(top) : 0.0;
}

double length_of(const DotsAlong& along) { return std::abs(along.dots.step) * static_cast<double>(along.dots.count); }

dvec2 panel_size(const LevelPanels& drawn, const DotsAlong& x, const DotsAlong& y) {
  if (!drawn.alike) return {most_panel_width, usual_panel_height};
  const double pixels = std::min(most_panel_width / length_of(x), most_panel_height / length_of(y));
  return glm::max(pixels * dvec2(length_of(x), length_of(y)), dvec2(least_panel_side));
}

// Room for the ticks of the ordinate, a tenth of it apart at least, and its label.
double room_on_the_left(const EvenAxis& dots) {
  constexpr double label = 58.0, character = 9.0;
  const double length = std::abs(dots.step) * static_cast<double>(dots.count);
  const int decimals = std::clamp(static_cast<int>(-std::floor(std::log10(length / 5.0))), 0, 12);
  const auto width = [&](double value) { return static_cast<double>(fmt::formatted_size("{:.{}f}", value, decimals)); };
  return std::max(least_panels_left, label + character * std::max(width(dots.first), width(dots.last())));
}

// Where panels are on their canvas, in pixels from its lower left corner.
struct PanelLayout {
  dvec2 size;  // of a panel
  std::size_t panels, in_a_row;
  double left_of_each;

  std::size_t rows() const { return (panels + in_a_row - 1) / in_a_row; }
  double across() const { return static_cast<double>(std::min(panels, in_a_row)) * (left_of_each + size.x) + panels_right; }
  double down() const {
    return panels_top + static_cast<double>(rows()) * size.y + static_cast<double>(rows() - 1) * gap_below + panels_bottom;
  }
  std::string margins(std::size_t number) const {
    const double left = left_of_each + static_cast<double>(number % in_a_row) * (size.x + left_of_each),
                 top = down() - panels_top - static_cast<double>(number / in_a_row) * (size.y + gap_below);
    return fmt::format(
        "set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\nset tmargin at screen {:.5f}\nset bmargin at "
        "screen {:.5f}\n",
        left / across(), (left + size.x) / across(), top / down(), (top - size.y) / down());
  }
  std::string color_box() const {
    return fmt::format("set colorbox vertical user origin screen {:.5f}, screen {:.5f} size screen {:.5f}, screen {:.5f}\n",
                       (across() - panels_right + 24.0) / across(), panels_bottom / down(), 20.0 / across(),
                       (down() - panels_top - panels_bottom) / down());
  }
};

std::string limits_text(const EvenAxis& dots) {
  const double first = dots.first - 0.5 * dots.step, last = dots.last() + 0.5 * dots.step;
  return fmt::format("[{:.9g}:{:.9g}]", std::min(first, last), std::max(first, last));
}

std::string axes_text(const LevelPanels& drawn, const DotsAlong& x, const DotsAlong& y) {
  return fmt::format(
      "unset key\nset xtics out nomirror\nset ytics out nomirror\nset grid noxtics noytics\nset xrange {}\nset yrange {}\nset "
      "xlabel '{}'\nset ylabel '{}'\n",
      limits_text(x.dots), limits_text(y.dots), drawn.x.label, drawn.y.label);
}

std::string lines_plot(const LevelPanels& drawn) {
  return drawn.lines.empty() ? "\n" : ", \\\n  $lines using 1:2 with lines lc rgb '#80ffffff' lw 1 notitle\n";
}

}  // namespace

std::vector<std::array<dvec2, 2>> projected(std::span<const std::array<dvec3, 2>> lines, const dvec3& across, const dvec3& up) {
  std::vector<std::array<dvec2, 2>> result;
  for (const auto& [begin, end] : lines)
    result.push_back({dvec2(glm::dot(begin, across), glm::dot(begin, up)), dvec2(glm::dot(end, across), glm::dot(end, up))});
  return result;
}

std::string lines_data(const std::vector<std::array<dvec2, 2>>& lines) {
  if (lines.empty()) return "";
  std::string text = "$lines << EOD\n";
  for (const auto& [begin, end] : lines) text += fmt::format("{:.6g} {:.6g}\n{:.6g} {:.6g}\n\n", begin.x, begin.y, end.x, end.y);
  return text + "EOD\n";
}

std::string colors_panel_script(const std::string& file, const LevelPanels& axes, const std::string& colors) {
  const DotsAlong x = dots_along(axes.x.values), y = dots_along(axes.y.values);
  const PanelLayout layout{panel_size(axes, x, y), 1, 1, room_on_the_left(y.dots)};
  std::string script = gnuplot_preamble("pngcairo", fmt::format("{:.0f},{:.0f}", layout.across(), layout.down()), file);
  script += lines_data(axes.lines) + colors + "set title " + gnuplot_quoted_lines(axes.heading) + '\n';
  script += axes_text(axes, x, y) + layout.margins(0) + "plot $colors using 1:2:3:4:5 with rgbimage notitle" + lines_plot(axes);
  return script + "set output\n";
}

std::string level_panels_script(const std::string& terminal, const std::string& file, const LevelPanels& drawn) {
  const DotsAlong x = dots_along(drawn.x.values), y = dots_along(drawn.y.values);
  const PanelLayout layout{panel_size(drawn, x, y), drawn.panels.size(), drawn.in_a_row, room_on_the_left(y.dots)};
  const double top = top_of(drawn), bottom = top - drawn.range;
  std::string script =
      gnuplot_preamble(terminal, fmt::format("{:.0f},{:.0f}", layout.across(), layout.down()), file) + lines_data(drawn.lines);
  for (std::size_t i = 0; i < drawn.panels.size(); ++i) script += dots_data(i, drawn.panels[i].levels, x, y, bottom);
  script += "set multiplot title " + gnuplot_quoted_lines(drawn.heading) + '\n' + level_palette;
  script += fmt::format("set cbrange [{}:{}]\nset cblabel '{}'\n", bottom, top, drawn.level_label) + axes_text(drawn, x, y);
  for (std::size_t i = 0; i < drawn.panels.size(); ++i) {
    script += layout.margins(i) + fmt::format("set title '{}'\n", drawn.panels[i].title) +
              (i == 0 ? layout.color_box() : "unset colorbox\n");
    script += fmt::format("plot $levels{} using ({:.9g}+{:.9g}*$1):({:.9g}+{:.9g}*$2):3 matrix with image notitle", i,
                          x.dots.first, x.dots.step, y.dots.first, y.dots.step);
    script += lines_plot(drawn);
  }
  return script + "unset multiplot\nset output\n";
}

}  // namespace raytube
