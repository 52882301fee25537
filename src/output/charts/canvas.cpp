#include "output/charts/canvas.h"

#include <fmt/format.h>

#include <cmath>

#include "output/plots/gnuplot.h"

namespace raytube {

namespace {

constexpr double pixels_of_an_inch = 100.0;  // of a page: 12 points are then as large as in a PNG

// In pixels for a PNG and SVG, in inches on a page.
std::string terminal_of(const std::string& ending, double scale) {
  if (ending == ".svg") return fmt::format("svg fontscale {0:.4g} linewidth {0:.4g}", scale);
  return fmt::format("{0} fontscale {1:.4g} linewidth {1:.4g} pointscale {1:.4g}", ending == ".pdf" ? "pdfcairo" : "pngcairo",
                     scale);
}

}  // namespace

std::array<double, 2> laid_out(std::array<double, 2> wanted, const ChartOptions& options) {
  if (!options.size) return wanted;
  const double width = (*options.size)[0], height = (*options.size)[1];
  const double scale = std::sqrt(wanted[0] * wanted[1] / (width * height));
  return {scale * width, scale * height};
}

std::string chart_script(const Chart& chart, const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  const double width = chart.size ? (*chart.size)[0] : chart.design[0], height = chart.size ? (*chart.size)[1] : chart.design[1];
  const double scale = width / chart.design[0];
  const std::string canvas = ending == ".pdf"
                                 ? fmt::format("{:.4f}in,{:.4f}in", width / pixels_of_an_inch, height / pixels_of_an_inch)
                                 : fmt::format("{:.0f},{:.0f}", width, height);
  return gnuplot_preamble(terminal_of(ending, scale), canvas, file.string()) + chart.commands + "set output\n";
}

}  // namespace raytube
