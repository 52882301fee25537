// raytube report: the results of a run -> one page of HTML.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "core/error.h"
#include "core/text.h"
#include "jobs/imaged_target.h"
#include "output/products/sweep_samples.h"
#include "output/report/imaging_json.h"
#include "output/report/page.h"
#include "output/report/sweep_json.h"
#include "output/report/words_json.h"
#include "program/report/report_centres.h"
#include "program/report/report_scene.h"
#include "program/work/interrupt.h"

namespace raytube {

namespace {

constexpr const char* report_name = "report.html";
constexpr int ranges_a_cell = 8;  // smooth to the eye
constexpr const char* three_js = RAYTUBE_THREE_JS;

std::filesystem::path report_file(const Request& request, const ReportSource& source) {
  if (request.report.file.empty()) return std::filesystem::absolute(source.file).parent_path() / report_name;
  const std::filesystem::path& file = request.report.file;
  const std::string ending = lower_case(file.extension().string());
  if (ending != ".html" && ending != ".htm")
    throw InputError(fmt::format("-o {}: a report is a page of HTML; name a file that ends in .html", file.string()));
  return std::filesystem::absolute(file);
}

// A view, or a note why there is none: sweeps that it cannot be made of are no fault.
template <class View>
JsonValue view_or_note(ReportSource& source, const char* name, const View& view) {
  try {
    return view();
  } catch (const InputError& error) {
    source.notes.push_back(fmt::format("{}: {}.", name, error.what()));
    return {};
  }
}

JsonValue profiles_of(const ProductSource& product) {
  const Window window;
  const SweepSamples samples = samples_of(product.result, product.name);
  const double middle = middle_range(samples, product.outermost(), product.name);
  return profiles_json(range_profiles(samples, {window, ranges_a_cell, middle}), product.result.looks.size(), window);
}

// Cells of the image to a resolution cell: as raytube isar has them, or as many as a page is worth.
double shown_pixels(const std::vector<ImageAxis>& axes, const std::array<double, 3>& size, double most) {
  constexpr double most_cells = 2e6;
  double cells = 1.0;
  for (std::size_t i = 0; i < axes.size(); ++i) cells *= (size[i] > 0.0 ? size[i] : axes[i].unambiguous) / axes[i].cell;
  const double pixels = std::min(most, std::pow(most_cells / cells, 1.0 / static_cast<double>(axes.size())));
  if (pixels < 1.0)
    throw InputError(fmt::format("{:.3g} resolution cells are too many for a page; raytube isar makes it", cells));
  return pixels;
}

JsonValue isar_of(const ProductSource& product) {
  const ProductRequest plain;
  const SweepSamples samples = samples_of(product.result, product.name);
  const AngleGrid grid = grid_of_looks(product.result, product.name);
  const ImageFrame frame = image_frame(samples, grid, plain.window, product.outermost(), {}, product.name);
  const double pixels = shown_pixels(image_axes(samples, grid, plain.window), frame.size, plain.pixels);
  return isar_json(isar_image(samples, grid, {plain.window, frame, pixels}, product.name), plain.window);
}

JsonValue notes_json(const std::vector<std::string>& notes) {
  JsonValue json{std::vector<std::string>{}};
  for (const std::string& note : notes) json.append(note);
  return json;
}

JsonValue report_data(ReportSource& source, const std::vector<std::size_t>& looks) {
  const ProductSource& product = source.product;
  JsonValue data = {{"title", product.title}, {"file", source.file.filename().string()}};
  data["sentences"] = sentences_json(product.result, source.run);
  data["sweep"] = sweep_json(product.result);
  data["map"] = view_or_note(source, "Map", [&] { return map_json(product.result, product.name); });
  data["profiles"] = view_or_note(source, "Range profiles", [&] { return profiles_of(product); });
  data["isar"] = view_or_note(source, "Image of frequency and angle", [&] { return isar_of(product); });
  data["centres"] = report_centres(source);
  data["scene"] = scene_json(report_scene(source, looks));
  data["record"] = record_json(source.run);
  data["notes"] = notes_json(source.notes);
  return data;
}

// Empty if it is not installed.
std::string library_in_space() {
  std::ifstream in(three_js, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (text.empty()) warn(fmt::format("{}: is not there, so the report has no view in space; install libjs-three", three_js));
  return text;
}

void write_page(const std::filesystem::path& file, const std::string& page) {
  const OutputFolder folder(file.parent_path());
  AllOrNothing ending(folder);
  const InterruptFlag interrupt_flag([&ending] { return ending.last_words(); });
  NewResults results(folder.path());
  OutputFile out(results.folder() / file.filename());
  out.write(page);
  out.commit();
  stop_if_interrupted();
  replace_results(results, folder.path(), {{}, {file.filename().string()}}, {}, [&ending] { ending.complete(); });
}

}  // namespace

void report_command(const Request& request) {
  ReportSource source = report_source(request);
  const std::filesystem::path file = report_file(request, source);
  check_output(file.parent_path(), {{}, {file.filename().string()}}, {{"the result", source.file}});
  const JsonValue data = report_data(source, request.report.looks);
  const std::string page = report_page(data, source.product.title, library_in_space());
  write_page(file, page);
  if (!request.quiet)
    fmt::print("report             {}: {:.1f} MB, for any browser\n", file.string(), static_cast<double>(page.size()) * 1e-6);
}

}  // namespace raytube
