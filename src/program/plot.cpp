// raytube plot: results -> a picture of them; a single look -> a table on stdout.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "core/error.h"
#include "core/text.h"
#include "output/charts/chart.h"
#include "output/charts/look_table.h"
#include "output/netcdf/netcdf_file.h"
#include "output/plots/gnuplot.h"
#include "output/tables/csv.h"
#include "output/tables/stored.h"
#include "program/result_commands.h"
#include "program/work/interrupt.h"
#include "program/work/results.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::pair<const char*, ChartKind>, 4> kinds = {
    {{"auto", ChartKind::automatic}, {"curves", ChartKind::curves}, {"map", ChartKind::map}, {"polar", ChartKind::polar}}};
constexpr std::array<std::pair<const char*, ChartUnit>, 3> units = {
    {{"dbsm", ChartUnit::dbsm}, {"m2", ChartUnit::square_metres}, {"db-peak", ChartUnit::db_of_peak}}};
constexpr std::array<std::pair<const char*, bool>, 2> styles = {{{"screen", false}, {"print", true}}};
constexpr int least_pixels = 100, most_pixels = 20000, most_elongated = 4;
constexpr double most_pixels_in_all = 2e8;

template <class Choices>
auto chosen(const char* option, const std::string& word, const Choices& choices) {
  std::string all;
  for (const auto& [name, value] : choices) {
    if (word == name) return value;
    all += (all.empty() ? "" : ", ") + std::string(name);
  }
  throw InputError(fmt::format("{} {}: is none; choose among {}", option, quotable(word), all));
}

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

std::vector<std::size_t> channels_of(const std::string& text) {
  if (text.empty()) return {};
  std::vector<std::size_t> channels;
  for (const std::string& word : words_of(text)) {
    const auto found = std::ranges::find(channel_names, lower_case(word));
    const auto channel = static_cast<std::size_t>(found - channel_names.begin());
    if (found == channel_names.end() || std::ranges::find(channels, channel) != channels.end())
      throw InputError(fmt::format("--channels {}: write some of vv,vh,hv,hh, each once", quotable(text)));
    channels.push_back(channel);
  }
  std::ranges::sort(channels);
  return channels;
}

int pixels_of(std::string_view text) {
  int pixels = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), pixels);
  return error == std::errc() && end == text.data() + text.size() ? pixels : 0;
}

std::optional<std::array<int, 2>> size_of(const std::string& text) {
  if (text.empty()) return {};
  const std::size_t by = std::min(text.find('x'), text.size());
  const int width = pixels_of(std::string_view(text).substr(0, by));
  const int height = by < text.size() ? pixels_of(std::string_view(text).substr(by + 1)) : 0;
  const int shorter = std::min(width, height), longer = std::max(width, height);
  const bool fits = shorter >= least_pixels && longer <= most_pixels && longer <= most_elongated * shorter &&
                    static_cast<double>(width) * height <= most_pixels_in_all;
  if (!fits)
    throw InputError(
        fmt::format("--size {}: write WIDTHxHEIGHT in pixels from {} to {}, {:g} together at most and one no more than {} "
                    "times the other, for example 1600x900",
                    quotable(text), least_pixels, most_pixels, most_pixels_in_all, most_elongated));
  return std::array{width, height};
}

ChartOptions options_of(const PlotRequest& request) {
  ChartOptions options{chosen("--kind", request.kind, kinds),
                       channels_of(request.channels),
                       request.range_db,
                       chosen("--unit", request.unit, units),
                       size_of(request.size),
                       chosen("--style", request.style, styles),
                       request.title};
  if (options.range_db && options.unit == ChartUnit::square_metres)
    throw InputError("--range: square metres have no range in dB; leave it out, or take --unit dbsm");
  return options;
}

// Where pictures go, and their names.
struct Pictures {
  fs::path folder;
  std::vector<std::string> names;
};

bool is_picture(const std::string& ending) { return ending == ".png" || ending == ".svg" || ending == ".pdf"; }

Pictures pictures_of(const PlotRequest& request) {
  const fs::path first = fs::absolute(request.results.front()).parent_path();
  if (request.output.empty()) return {first, {"plot.png", "plot.svg"}};
  const std::string ending = request.output.extension().string();
  if (is_picture(ending) && !fs::is_directory(request.output))
    return {fs::absolute(request.output).parent_path(), {request.output.filename().string()}};
  constexpr std::array<std::string_view, 8> others = {".jpg", ".jpeg", ".eps", ".ps", ".gif", ".tif", ".tiff", ".bmp"};
  if (std::ranges::find(others, lower_case(ending)) != others.end() || is_picture(lower_case(ending)))
    throw InputError(
        fmt::format("-o {}: no such picture is drawn; name a .png, .svg or .pdf, or a folder", request.output.string()));
  return {request.output, {"plot.png", "plot.svg"}};
}

std::optional<StoredResult> with_errors(const fs::path& file) {
  if (is_netcdf_name(file)) return read_netcdf(file);
  return has_rcs_columns(file) ? std::optional(read_rcs_csv(file)) : std::nullopt;
}

void print_look(const ResultTable& table, const ChartOptions& options) {
  fmt::print("{}: a single look, as a table in place of a picture\n{}", table.file.string(),
             look_table(table, with_errors(table.file), options.channels));
}

void refuse_single_looks(const std::vector<ResultTable>& tables) {
  for (const ResultTable& table : tables)
    if (table.rows.size() == 1)
      throw InputError(fmt::format("{}: a single look makes no curve beside others; plot it alone, which prints it as a table",
                                   table.file.string()));
}

void draw(const Chart& chart, const Pictures& pictures, bool quiet) {
  const OutputFolder folder(pictures.folder);
  AllOrNothing ending(folder);
  const InterruptFlag interrupt_flag([&ending] { return ending.last_words(); });
  NewResults results(folder.path());
  for (const std::string& name : pictures.names) {
    const fs::path picture = results.folder() / name;
    const std::string trouble = draw_picture(picture, chart_script(chart, picture));
    stop_if_interrupted();
    if (!trouble.empty()) throw std::runtime_error(fmt::format("no picture {}: {}", name, trouble));
  }
  replace_results(results, folder.path(), {{}, pictures.names}, {}, [&ending] { ending.complete(); });
  if (!quiet)
    fmt::print("picture in {}: {}\n", folder.path().string(), joined(std::span<const std::string>(pictures.names), ", "));
}

}  // namespace

void plot_command(const PlotRequest& request) {
  const ChartOptions options = options_of(request);
  const Pictures pictures = pictures_of(request);
  std::vector<ResultTable> tables;
  for (const fs::path& file : request.results) tables.push_back(read_result_table(file));
  if (tables.size() == 1 && tables.front().rows.size() == 1) return print_look(tables.front(), options);
  refuse_single_looks(tables);
  const Chart chart = made_chart(chart_results(tables), options);
  std::vector<InputFile> inputs;
  for (const fs::path& file : request.results) inputs.emplace_back("a result to draw", file);
  check_output(pictures.folder, {{}, pictures.names}, inputs);
  draw(chart, pictures, request.quiet);
}

}  // namespace raytube
