#include "program/run/case_of_mesh.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>
#include <tuple>

#include "core/csv_reader.h"
#include "core/error.h"
#include "core/text.h"
#include "output/files/files.h"
#include "output/netcdf/netcdf_file.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view written_head = "# Written by raytube run for a mesh.";

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> pieces(1);
  for (const char c : text)
    if (c == separator)
      pieces.emplace_back();
    else
      pieces.back() += c;
  return pieces;
}

// Turns "10", "9,10,11" or "0:360:1" into the value of a key.
std::string value_of(const char* option, const std::string& text, const char* third) {
  const bool is_range = text.find(':') != std::string::npos;
  const std::vector<std::string> words = split(text, is_range ? ':' : ',');
  const bool are_numbers = std::ranges::all_of(words, [](const std::string& word) { return parsed_number(word).has_value(); });
  if (!are_numbers || (is_range && words.size() != 3))
    throw InputError(fmt::format("{} {}: write a number, numbers separated by commas, or START:STOP:{}", option, quotable(text),
                                 std::string_view(third) == "count" ? "COUNT" : "STEP"));
  if (is_range) return fmt::format("{{ start = {}, stop = {}, {} = {} }}", words[0], words[1], third, words[2]);
  return words.size() == 1 ? words[0] : fmt::format("[{}]", fmt::join(words, ", "));
}

std::string toml_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return quoted + '"';
}

std::string case_text(const MeshOptions& asked, const fs::path& mesh, const fs::path& folder) {
  const fs::path beside = fs::proximate(fs::absolute(mesh), fs::absolute(folder));
  return fmt::format(
      "{}\ntitle = {}\n\n[target]\nmesh = {}\nunit = {}\n\n[frequency]\nghz = {}\n\n[look]\nazimuth_deg = {}\nelevation_deg = "
      "{}\n",
      written_head, toml_text(mesh.stem().string()), toml_text(beside.string()), toml_text(asked.unit),
      value_of("--ghz", asked.ghz, "count"), value_of("--azimuth", asked.azimuth.empty() ? "0" : asked.azimuth, "step"),
      value_of("--elevation", asked.elevation.empty() ? "0" : asked.elevation, "step"));
}

void require_free(const fs::path& file) {
  if (!fs::exists(file)) return;
  std::string first_line;
  std::ifstream in(file);
  std::getline(in, first_line);
  if (first_line != written_head)
    throw InputError(
        fmt::format("{}: exists and was not written by raytube run; run it as a case, or give another -o", file.string()));
}

void write_case(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  const fs::path beside = file.string() + ".new";
  OutputFile out(beside);
  out.write(text);
  out.commit();
  fs::rename(beside, file);
}

}  // namespace

void add_mesh_options(CLI::App& run, MeshOptions& mesh) {
  add_value(run, "--unit UNIT", mesh.unit, "For a mesh: its unit of length (m, cm, mm, um, in, ft)", [](const std::string& unit) {
    constexpr std::array<std::string_view, 6> units = {"m", "cm", "mm", "um", "in", "ft"};
    const bool is_known = std::ranges::find(units, unit) != units.end();
    return is_known ? std::string() : fmt::format("needs m, cm, mm, um, in or ft (found {})", quotable(unit));
  });
  add_value(run, "--ghz F", mesh.ghz, "For a mesh: frequencies, one, a list, or START:STOP:COUNT");
  add_value(run, "--azimuth DEG", mesh.azimuth, "For a mesh: azimuths in degrees, one, a list, or START:STOP:STEP; default 0");
  add_value(run, "--elevation DEG", mesh.elevation, "For a mesh: elevations in degrees, likewise; default 0");
}

void make_case_of_mesh(const MeshOptions& asked, RunOptions& run) {
  const fs::path mesh = run.input.file;
  constexpr std::array<std::string_view, 8> mesh_endings = {".stl", ".obj", ".ply", ".off", ".msh", ".gltf", ".glb", ".3mf"};
  const bool is_packed = lower_case(mesh.extension().string()) == ".gz";
  const std::string ending = lower_case((is_packed ? mesh.stem() : mesh).extension().string());
  if (std::ranges::find(mesh_endings, ending) == mesh_endings.end()) {
    for (const auto& [option, value, key] :
         {std::tuple{"--unit", &asked.unit, "target.unit"}, std::tuple{"--ghz", &asked.ghz, "frequency.ghz"},
          std::tuple{"--azimuth", &asked.azimuth, "look.azimuth_deg"},
          std::tuple{"--elevation", &asked.elevation, "look.elevation_deg"}})
      if (!value->empty())
        throw InputError(
            fmt::format("{}: goes with a mesh; a case has the key {}, and --set {}=VALUE changes it", option, key, key));
    return;
  }
  if (run.work.ranks)
    throw InputError(fmt::format(
        "{}: several processes share a case, not a mesh; run it once without mpirun, which writes the case", mesh.string()));
  if (!fs::exists(mesh)) throw InputError(fmt::format("{}: there is no such file", mesh.string()));
  if (asked.unit.empty())
    throw InputError(fmt::format("{}: a mesh has no unit of length; give --unit m, cm, mm, um, in or ft", mesh.string()));
  if (asked.ghz.empty())
    throw InputError(fmt::format("{}: a mesh has no frequency; give one with --ghz, for example --ghz 10", mesh.string()));
  const bool one_file = is_netcdf_name(run.output);
  if (run.output.empty()) run.output = fs::absolute(mesh).parent_path() / "out";
  const fs::path file = one_file ? fs::path(run.output).replace_extension(".toml") : run.output / "case.toml";
  require_free(file);
  write_case(file, case_text(asked, mesh, fs::absolute(file).parent_path()));
  run.input.file = file;
}

}  // namespace raytube
