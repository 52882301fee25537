#include "program/report/report_scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "core/threads.h"
#include "jobs/solvable.h"
#include "output/tables/read_image_csv.h"
#include "output/vtk/read_image_vtu.h"
#include "sbr/tube_paths.h"
#include "scene/sampling.h"
#include "solve/image.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t most_shown_tubes = 600;
constexpr double long_look = 30.0;  // [s] of a look that nobody asked for

void check_looks(const ReportSource& source, const std::vector<std::size_t>& looks) {
  const std::size_t count = source.product.result.looks.size();
  if (looks.size() > most_scene_looks)
    throw InputError(
        fmt::format("--looks: a report shows {} at most; leave out {}", most_scene_looks, looks.size() - most_scene_looks));
  for (const std::size_t look : looks)
    if (look >= count)
      throw InputError(
          fmt::format("--looks {}: {} has {} look(s), counted from 0; choose among these", look, source.file.string(), count));
}

void add_target(const Target& target, const ProductSource& product, ReportScene& scene) {
  scene.vertices = target.mesh.vertices;
  for (dvec3& vertex : scene.vertices) vertex += target.mesh.center;
  scene.triangles = target.mesh.triangles;
  scene.lines = product.lines();
}

// --- images that the run has left ---

std::vector<std::size_t> kept_looks(const JsonValue& run) {
  std::vector<std::size_t> looks;
  const JsonValue* at = &run;
  for (const char* name : {"case", "output", "image_look"})
    if (at) at = at->find(name);
  if (!at) return looks;
  for (const JsonValue& look : at->items) looks.push_back(static_cast<std::size_t>(look.whole));
  if (at->items.empty()) looks.push_back(static_cast<std::size_t>(at->whole));
  return looks;
}

std::string image_name(std::size_t look, std::size_t looks) { return looks > 1 ? fmt::format("image_{}", look) : "image"; }

// False if the files are not there, or of another mesh than the scene's.
bool add_kept(const ReportSource& source, std::size_t look, std::size_t looks, ReportScene& scene) {
  const fs::path folder = fs::absolute(source.file).parent_path();
  const fs::path mesh_file = folder / (image_name(look, looks) + "_mesh.vtu"),
                 table = folder / (image_name(look, looks) + ".csv");
  if (look >= source.product.result.looks.size() || !fs::exists(mesh_file)) return false;
  ImageMesh mesh = read_image_vtu(mesh_file);
  if (scene.triangles.empty()) scene.vertices = std::move(mesh.vertices), scene.triangles = std::move(mesh.triangles);
  if (mesh.image.triangles.size() != scene.triangles.size()) return false;
  if (fs::exists(table)) {
    LookImage cells = read_image_csv(table, most_scene_cells);
    mesh.image.lattice = cells.lattice, mesh.image.cells = std::move(cells.cells);
  }
  mesh.image.look = look;
  const std::vector<double>& frequencies = source.product.result.frequency_hz;
  mesh.image.frequency = frequencies[frequencies.size() / 2];
  scene.looks.push_back({std::move(mesh.image), {}});
  return true;
}

void add_kept_looks(ReportSource& source, ReportScene& scene) {
  const std::vector<std::size_t> kept = kept_looks(source.run);
  for (std::size_t i = 0; i < std::min(kept.size(), most_scene_looks); ++i) add_kept(source, kept[i], kept.size(), scene);
  if (kept.size() > most_scene_looks)
    source.notes.push_back(fmt::format("Looks in space: of {} images the first {}; raytube report --looks chooses others.",
                                       kept.size(), most_scene_looks));
}

// --- images that are made here ---

// That of the largest amplitude at the frequency of images.
std::size_t strongest_look(const StoredResult& result) {
  const std::size_t frequencies = result.frequency_hz.size(), middle = frequencies / 2;
  std::size_t strongest = 0;
  const auto amplitude = [&](std::size_t look) { return largest_amplitude(result.s[look * frequencies + middle]); };
  for (std::size_t look = 1; look < result.looks.size(); ++look)
    if (amplitude(look) > amplitude(strongest)) strongest = look;
  return strongest;
}

double seconds_a_look(const ReportSource& source) {
  const JsonValue* time = source.run.find("time");
  const JsonValue* solve = time ? time->find("solve_s") : nullptr;
  return solve ? solve->number / static_cast<double>(source.product.result.looks.size()) : 0.0;
}

TubePaths shown_tubes(const Target& target, const Case& one) {
  const std::vector<Look> lighting = lighting_looks(one.sweep.looks.front(), one.ground);
  const auto of = [&](const Look& look) {
    return tube_paths({target.tracer, one.sweep.materials, one.sweep.radar}, look, one.sweep.frequencies.front(), one.tubes,
                      most_shown_tubes);
  };
  TubePaths tubes = of(lighting.front());
  if (lighting.size() > 1) add_lit_by_ground(tubes, of(lighting.back()));
  return tubes;
}

// As fine as a page shows it.
LookImage shown_image(const Target& target, const Case& one) {
  const SolvePlan plan = plan_of_case(target, one, all_threads(), false);
  const double across = 2.0 * target.mesh.radius / wavelength(one.sweep.frequencies.front());
  return image_of_look(plan, 0, std::min(static_cast<double>(most_scene_cells) / across, one.image_per_wavelength));
}

bool same_sweep(const Case& c, const StoredResult& result) {
  return c.sweep.looks.size() == result.looks.size() && c.sweep.frequencies.size() == result.frequency_hz.size();
}

Case case_of(const ReportSource& source) {
  Case c = case_of_run(source.run);
  if (!same_sweep(c, source.product.result))
    throw InputError(fmt::format("{}: asks for other looks than {} has; run it again", c.file.string(), source.file.string()));
  return c;
}

void add_made(const ReportSource& source, const Case& c, std::size_t look, ReportScene& scene) {
  const Target& target = *source.product.target;
  const Case one = case_of_look(c, look, image_frequency(c.sweep));
  naming_the_case(c, [&] {
    SceneLook made{shown_image(target, one), shown_tubes(target, one)};
    made.image.look = look;
    scene.looks.push_back(std::move(made));
  });
}

void add_strongest(ReportSource& source, ReportScene& scene) {
  if (seconds_a_look(source) > long_look) {
    source.notes.emplace_back("Colours of the target: a look takes long to solve; raytube report --looks I computes one.");
    return;
  }
  try {
    add_made(source, case_of(source), strongest_look(source.product.result), scene);
  } catch (const InputError& error) {
    source.notes.push_back(fmt::format("Colours of the target: {}.", error.what()));
  }
}

void add_tubes_of_kept(ReportSource& source, ReportScene& scene) {
  if (!source.product.target) return;
  try {
    const Case c = case_of(source);
    for (SceneLook& look : scene.looks)
      look.tubes = shown_tubes(*source.product.target, case_of_look(c, look.image.look, image_frequency(c.sweep)));
  } catch (const InputError& error) {
    source.notes.push_back(fmt::format("Tubes: {}.", error.what()));
  }
}

}  // namespace

ReportScene report_scene(ReportSource& source, const std::vector<std::size_t>& looks) {
  check_looks(source, looks);
  ReportScene scene;
  const Target* const target = source.product.target.get();
  if (target) add_target(*target, source.product, scene);
  if (!looks.empty()) {
    if (!target)
      throw InputError(fmt::format("--looks: {} has no target: its case or mesh is not where the run had it, or has changed",
                                   source.file.string()));
    const Case c = case_of(source);
    for (const std::size_t look : looks) add_made(source, c, look, scene);
    return scene;
  }
  add_kept_looks(source, scene);
  if (!scene.looks.empty()) add_tubes_of_kept(source, scene);
  if (scene.looks.empty() && target) add_strongest(source, scene);
  if (scene.triangles.empty())
    source.notes.emplace_back("The target in space: its case or mesh is not where the run had it, or has changed.");
  return scene;
}

}  // namespace raytube
