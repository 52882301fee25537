#include "output/charts/chart_style.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "output/plots/curves.h"

namespace raytube {

namespace {

constexpr std::array<const char*, most_results> colours = {"#1f5fbf", "#d9480f", "#2e8b3d", "#8e44ad",
                                                           "#b8860b", "#00838f", "#c2185b", "#555555"};
constexpr std::array<const char*, most_results> greys = {"#000000", "#808080", "#000000", "#808080",
                                                         "#404040", "#a0a0a0", "#404040", "#a0a0a0"};
constexpr std::array<int, most_results> symbols = {7, 5, 6, 4, 9, 11, 8, 10};

constexpr std::array<const char*, 4> channel_colours = {"#1f5fbf", "#2e8b3d", "#c040c0", "#d9480f"};
constexpr std::array<const char*, 4> channel_greys = {"#000000", "#909090", "#909090", "#000000"};
constexpr std::array<const char*, 4> dashes = {"solid", "(2,4)", "(12,4,2,4)", "(10,6)"};
constexpr std::array<const char*, 4> dashes_of_one = {"solid", "solid", "(16,16)", "(10,6)"};
constexpr std::array<int, 4> channel_symbols = {7, 5, 4, 6};

constexpr std::size_t few_points = 60, symbols_of_a_curve = 12;

const char* colour_of(const CurveOf& curve) {
  if (curve.results == 1) return (curve.print ? channel_greys : channel_colours)[curve.channel];
  return (curve.print ? greys : colours)[curve.result];
}

}  // namespace

std::string curve_look(const CurveOf& curve) {
  const bool one = curve.results == 1, marked = curve.print && !one && curve.results > 2;
  const int symbol = one ? channel_symbols[curve.channel] : symbols[curve.result];
  const char* kind = curve.points == 1 ? "points" : curve.points <= few_points || marked ? "linespoints" : "lines";
  std::string text = fmt::format("with {} lc rgb '{}'", kind, colour_of(curve));
  if (curve.points > 1) text += fmt::format(" lw 2 dt {}", (one ? dashes_of_one : dashes)[curve.channel]);
  if (kind == std::string("lines")) return text;
  text += fmt::format(" pt {} ps 0.8", symbol);
  if (marked) text += fmt::format(" pi {}", std::max<std::size_t>(1, curve.points / symbols_of_a_curve));
  return text;
}

std::string map_palette(bool print) {
  return print ? "set palette defined (0 '#ffffff', 1 '#b0b0b0', 2 '#606060', 3 '#000000')\n" : level_palette;
}

}  // namespace raytube
