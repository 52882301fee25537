#include "output/plots/image_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <complex>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "core/decimal.h"
#include "output/files/files.h"
#include "output/plots/curves.h"
#include "output/plots/gnuplot.h"
#include "output/plots/image_window.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

constexpr double shown_range = 40.0;        // [dB] below the strongest cell
constexpr double window_wavelengths = 6.0;  // faces turned by 10 degrees and more then show their edges only
constexpr dvec2 most_dots{700.0, 560.0};    // of a panel, in pixels

// For angles, ends as it begins.
constexpr const char* phase_palette =
    "set palette defined (0 '#e2d9e2', 1 '#9fbbc9', 2 '#6587be', 3 '#5e43a5', 4 '#2f1436', 5 '#7c2051', 6 '#b25652', "
    "7 '#cb9d84', 8 '#e2d9e2')\n";

// What a picture can show of an image: of a block of cells the strongest, channel by channel.
struct Dots {
  std::uint32_t columns, rows, cells;  // cells along a dot's side
  std::vector<std::array<std::complex<float>, 4>> s;
  std::array<double, 4> peaks;  // of the channels [dBsm]
  double top;                   // of the colours [dBsm]

  double bottom() const { return top - shown_range; }
};

// Edges seen end-on are a few cells that outshine all others: of the dots that hold anything, one in `beyond` may lie above.
double top_level(const Dots& dots) {
  constexpr std::size_t beyond = 1000;
  std::vector<float> norms;
  for (const auto& dot : dots.s) {
    const float norm = std::ranges::max(std::array{std::norm(dot[0]), std::norm(dot[1]), std::norm(dot[2]), std::norm(dot[3])});
    if (norm > 0.0f) norms.push_back(norm);
  }
  if (norms.empty()) return 0.0;
  const auto nth = norms.begin() + static_cast<std::ptrdiff_t>(norms.size() / beyond);
  std::ranges::nth_element(norms, nth, std::greater{});
  return std::ceil(10.0 * std::log10(4.0 * pi * static_cast<double>(*nth)));
}

Dots dots_of(const ImageLattice& lattice, const std::vector<ScatteringMatrix>& parts) {
  const auto cells = static_cast<std::uint32_t>(std::ceil(std::max(lattice.columns / most_dots.x, lattice.rows / most_dots.y)));
  Dots dots{(lattice.columns + cells - 1) / cells, (lattice.rows + cells - 1) / cells, cells, {}, {}, 0.0};
  dots.s.resize(std::size_t{dots.columns} * dots.rows);
  dots.peaks.fill(sigma_dbsm(0.0));
  for (std::uint32_t row = 0; row < lattice.rows; ++row)
    for (std::uint32_t column = 0; column < lattice.columns; ++column)
      for (int channel = 0; channel < 4; ++channel) {
        const std::complex<float> s(parts[lattice.index({column, row})].at(channel / 2, channel % 2));
        std::complex<float>& dot = dots.s[std::size_t{row / cells} * dots.columns + column / cells][channel];
        if (std::norm(s) > std::norm(dot)) dot = s;
        dots.peaks[channel] = std::max(dots.peaks[channel], sigma_dbsm(s));
      }
  dots.top = top_level(dots);
  return dots;
}

enum class Shown { level, phase };

// Four numbers a dot, as gnuplot reads them; none where there is nothing, and no phase of what is too weak to be shown.
void write_dots(const fs::path& file, const Dots& dots, Shown shown) {
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  std::vector<float> numbers;
  for (const auto& dot : dots.s) {
    const bool empty = std::ranges::all_of(dot, [](const std::complex<float>& s) { return s == 0.0f; });
    for (const std::complex<float>& s : dot) {
      const double level = std::max(sigma_dbsm(s), dots.bottom());
      if (shown == Shown::level)
        numbers.push_back(empty ? none : static_cast<float>(level));
      else
        numbers.push_back(level > dots.bottom() ? std::arg(s) / static_cast<float>(degree) : none);
    }
  }
  OutputFile out(file);
  out.write({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float)});
  out.commit();
}

// Two by two panels, in pixels: as large as a screen allows, metres alike on both axes, a whole number of pixels a dot.
struct Layout {
  double left = 110, gap_across = 90, right = 150, top = 120, gap_down = 84, bottom = 70;
  double width, height;  // of a panel
  dvec2 low, high;       // what it shows [m]

  Layout(const ImageLattice& lattice, const Dots& dots) {
    constexpr double border = 20.0, least_width = 260.0, least_height = 200.0;
    const dvec2 count(dots.columns, dots.rows), dot = static_cast<double>(dots.cells) * lattice.cell;
    const double across = std::floor(std::min(most_dots.x / count.x, most_dots.y / count.y));
    const dvec2 pixels =
        dvec2(across, std::clamp(std::round(across * dot.y / dot.x), 1.0, std::max(1.0, std::floor(most_dots.y / count.y)))) *
            count +
        2.0 * border;
    width = std::max(least_width, pixels.x);
    height = std::max(least_height, pixels.y);
    const dvec2 middle = lattice.corner + 0.5 * count * dot;
    const dvec2 half = 0.5 * dvec2(width, height) / (pixels - 2.0 * border) * count * dot;
    low = middle - half;
    high = middle + half;
  }
  double across() const { return left + 2 * width + gap_across + right; }
  double down() const { return top + 2 * height + gap_down + bottom; }

  std::string panel(int channel) const {
    const double from = left + (channel % 2) * (width + gap_across), up = bottom + (1 - channel / 2) * (height + gap_down);
    return fmt::format("set lmargin at screen {}\nset rmargin at screen {}\nset bmargin at screen {}\nset tmargin at screen {}\n",
                       from / across(), (from + width) / across(), up / down(), (up + height) / down());
  }
  std::string color_box() const {
    return fmt::format("set colorbox vertical user origin screen {}, screen {} size screen {}, screen {}\n",
                       (left + 2 * width + gap_across + 24) / across(), bottom / down(), 22 / across(),
                       (2 * height + gap_down) / down());
  }
};

std::string direction_text(const Direction& d) {
  return fmt::format("θ {:.6g}°, φ {:.6g}°", decimal_degrees(d.theta), decimal_degrees(d.phi));
}

std::string place_text(const Direction& direction, double range) {
  return direction_text(direction) + (std::isinf(range) ? "" : fmt::format(", {:.6g} m", range));
}

std::string heading(const std::string& title, const Sweep& sweep, const LookImage& image) {
  const Look& look = sweep.looks[image.look];
  std::string text = fmt::format("{}\nlook {}: {}", title, image.look, place_text(look.transmit, look.transmit_range));
  if (sweep.bistatic) text += " to " + place_text(look.receive, look.receive_range);
  return text + fmt::format("; {:.6g} GHz; cells of {:.3g} × {:.3g} mm", image.frequency / 1e9, 1e3 * image.lattice.cell.x,
                            1e3 * image.lattice.cell.y);
}

// Where, and in which channel.
std::string strongest(const LookImage& image) {
  const auto cell = std::ranges::max_element(image.cells, {}, largest_amplitude);
  const auto index = static_cast<std::uint32_t>(cell - image.cells.begin());
  int most = 0;
  for (int channel = 1; channel < 4; ++channel)
    if (std::abs(cell->at(channel / 2, channel % 2)) > std::abs(cell->at(most / 2, most % 2))) most = channel;
  const dvec2 middle = image.lattice.middle({index % image.lattice.columns, index / image.lattice.columns});
  return fmt::format("\nstrongest {}: {:.1f} dBsm at u = {:.4g}, v = {:.4g} m", channel_titles[most],
                     sigma_dbsm(cell->at(most / 2, most % 2)), middle.x, middle.y);
}

std::string plot_command(const fs::path& data, const ImageLattice& lattice, const Dots& dots, int number) {
  const dvec2 dot = static_cast<double>(dots.cells) * lattice.cell, first = lattice.corner + 0.5 * dot;
  return fmt::format("plot {} binary array=({},{}) dx={} dy={} origin=({},{}) format='%4float' using {} with image notitle\n",
                     gnuplot_quoted(data.string()), dots.columns, dots.rows, dot.x, dot.y, first.x, first.y, number);
}

std::string panels(const Layout& layout, const fs::path& data, const ImageLattice& lattice, const Dots& dots) {
  const std::string where = lattice.curvature == 0.0 ? "" : " at the middle of the target";
  std::string text;
  for (int channel = 0; channel < 4; ++channel) {
    text += layout.panel(channel);
    text += fmt::format("set title '{}' offset 0,-0.5\nset xlabel '{}'\nset ylabel '{}'\n", channel_titles[channel],
                        channel / 2 == 1 ? "u (m)" + where : "", channel % 2 == 0 ? "v (m)" + where : "");
    if (dots.peaks[channel] < dots.bottom())
      text += fmt::format("set label 1 'all below {:.0f} dBsm' at graph 0.5, graph 0.5 center front textcolor rgb '#909090'\n",
                          dots.bottom());
    text += channel == 3 ? layout.color_box() : "unset colorbox\n";
    text += plot_command(data, lattice, dots, channel + 1) + "unset label 1\n";
  }
  return text + "unset multiplot\nset output\n";
}

std::string preamble(const Layout& layout, const fs::path& picture, const std::string& title) {
  return gnuplot_preamble("pngcairo", fmt::format("{:.0f},{:.0f}", layout.across(), layout.down()), picture.string()) +
         fmt::format("set multiplot title {}\nset xrange [{}:{}]\nset yrange [{}:{}]\n", title, layout.low.x, layout.high.x,
                     layout.low.y, layout.high.y) +
         "unset key\nset tics out nomirror\nset grid noxtics noytics\n"
         "set object 1 rectangle from graph 0, graph 0 to graph 1, graph 1 behind fillcolor rgb '#ececec' fillstyle solid "
         "noborder\n";
}

std::string colors(const Dots& dots, Shown shown, const std::string& label) {
  const std::string label_command = "set cblabel " + gnuplot_quoted(label) + " offset 2\n";
  if (shown == Shown::phase) return std::string(phase_palette) + "set cbrange [-180:180]\nset cbtics 45\n" + label_command;
  return level_palette + fmt::format("set cbrange [{}:{}]\n", dots.bottom(), dots.top) + label_command;
}

// One picture: `parts` are what its cells hold.
std::string draw(const fs::path& picture, const std::string& heading, const ImageLattice& lattice,
                 const std::vector<ScatteringMatrix>& parts, Shown shown, const std::string& label) {
  const Dots dots = dots_of(lattice, parts);
  const Layout layout(lattice, dots);
  const fs::path data = picture.string() + ".dots";
  write_dots(data, dots, shown);
  std::string trouble = draw_picture(picture, preamble(layout, picture, gnuplot_quoted_lines(heading)) +
                                                  colors(dots, shown, label) + panels(layout, data, lattice, dots));
  fs::remove(data);
  return trouble;
}

}  // namespace

std::string draw_image(const fs::path& folder, const std::string& name, const std::string& title, const Sweep& sweep,
                       LookImage image) {
  const std::string head = heading(title, sweep, image);
  const double width = window_wavelengths * wavelength(image.frequency);
  std::string trouble =
      draw(folder / (name + ".png"), head + strongest(image), image.lattice, image.cells, Shown::level, "σ of a cell (dBsm)");
  if (trouble.empty())
    trouble = draw(folder / (name + "_phase.png"), head, image.lattice, image.cells, Shown::phase, "phase of a cell (°)");
  image.cells = seen_through_window(image.lattice, std::move(image.cells), width);
  if (trouble.empty())
    trouble = draw(folder / (name + "_window.png"),
                   head + fmt::format("\nwindow of {:.3g} mm ({} λ)", 1e3 * width, window_wavelengths) + strongest(image),
                   image.lattice, image.cells, Shown::level, "σ in the window (dBsm)");
  return trouble.empty() ? "" : fmt::format("no picture of look {}: {}; {}.csv holds the same", image.look, trouble, name);
}

}  // namespace raytube
