// raytube trace: one tube, bounce by bounce; all tubes; the rays of waves over curved surfaces.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "case/read_case.h"
#include "case/target.h"
#include "core/decimal.h"
#include "core/error.h"
#include "core/threads.h"
#include "jobs/solvable.h"
#include "output/vtk/facet_hits_vtu.h"
#include "output/vtk/surface_rays_vtp.h"
#include "output/vtk/tube_paths_vtp.h"
#include "output/words/tubes_text.h"
#include "plan/admissible.h"
#include "plan/ground_paths.h"
#include "program/options.h"
#include "program/work/results.h"
#include "sbr/replay.h"
#include "sbr/tube_paths.h"
#include "solve/look_solver.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

constexpr const char* trace_examples =
    R"(Prints every bounce of the tube at (U, V), follows all tubes of a look, or writes the rays that waves over curved surfaces
follow.

Examples:
  raytube trace case.toml --look 0 --u 0.01 --v -0.02
  raytube trace case.toml --look 0 --all --paths paths.vtp --hits hits.vtu
  raytube trace case.toml --look 0 --surface-rays surface_rays.vtp)";

struct TraceRequest {
  CaseInput input;
  std::size_t look = 0;
  bool tube = false;        // the one at (u, v)
  double u = 0.0, v = 0.0;  // launch coordinates [m], origin = mesh origin
  bool all_tubes = false;
  std::uint64_t most_tubes = 10000;  // of all tubes
  fs::path paths_vtp;                // of all tubes; empty: none wanted
  fs::path hits_vtu;                 // of all tubes; empty: none wanted
  fs::path rays_vtp;                 // over curved surfaces; empty: none wanted
};

std::string vector_text(const dvec3& v) {
  return fmt::format("({: .9g}, {: .9g}, {: .9g})", v.x + 0.0, v.y + 0.0, v.z + 0.0);  // + 0.0: no "-0"
}

std::string direction_text(const Direction& d) {
  return fmt::format("theta {} deg, phi {} deg", number_text(decimal_degrees(d.theta)), number_text(decimal_degrees(d.phi)));
}

// A real field without an imaginary part, any other with both parts.
std::string field_text(const ComplexVector& e) {
  const std::string real = vector_text(e.re);
  return e.im == dvec3(0.0) ? real : fmt::format("{} + j {}", real, vector_text(e.im));
}

void print_bounce(int number, const TubeBounce& bounce, const dvec3& direction_in, const dvec3& mesh_center) {
  const double cosine = std::clamp(std::abs(glm::dot(direction_in, bounce.normal)), 0.0, 1.0);
  fmt::print("bounce {}: triangle {}, patch {}\n", number, bounce.triangle, bounce.patch);
  fmt::print("  point          {} m\n", vector_text(bounce.point + mesh_center));
  fmt::print("  normal         {}\n", vector_text(bounce.normal));
  fmt::print("  incidence      {:.6g} deg\n", std::acos(cosine) / degree);
  fmt::print("  leaves along   {}\n", vector_text(bounce.direction_out));
  fmt::print("  path           {:.12g} m\n", bounce.path);
  fmt::print("  field of V     {}\n", field_text(bounce.field[0]));
  fmt::print("  field of H     {}\n", field_text(bounce.field[1]));
}

// Prints where the tube goes on behind the `met`-th surface that it has met.
void print_parting(const std::vector<TubeTrace>& ways, std::size_t way, int met) {
  const auto parts_here = [&](const TubeTrace& t) { return t.parting.way == way && t.parting.met == met; };
  const auto behind = std::ranges::find_if(ways.begin() + 1, ways.end(), parts_here);
  fmt::print("  goes on        behind the surface, too: {}\n",
             behind == ways.end() ? fmt::format("not followed, because it lies beyond way {}", TubeReplay::most_ways)
                                  : fmt::format("way {}", behind - ways.begin() + 1));
}

void print_way(const std::vector<TubeTrace>& ways, std::size_t way, const dvec3& mesh_center) {
  const TubeTrace& trace = ways[way];
  if (way > 0) {
    fmt::print("way {}: behind bounce {} of way {}\n", way + 1, trace.parting.met, trace.parting.way + 1);
    fmt::print("  field of V     {}\n", field_text(trace.parting.field[0]));
    fmt::print("  field of H     {}\n", field_text(trace.parting.field[1]));
  }
  int met = trace.parting.met;
  dvec3 direction = trace.direction;
  for (const TubeBounce& bounce : trace.bounces) {
    print_bounce(++met, bounce, direction, mesh_center);
    if (bounce.goes_on) print_parting(ways, way, met);
    direction = bounce.direction_out;
  }
  fmt::print("end: {}\n", trace.end);
}

void print_look(std::size_t index, const Look& look) {
  fmt::print("look {}: {} to the transmitter, {} to the receiver\n", index, direction_text(look.transmit),
             direction_text(look.receive));
}

std::size_t highest_of(const Sweep& sweep) {
  return static_cast<std::size_t>(std::ranges::max_element(sweep.frequencies) - sweep.frequencies.begin());
}

// A target at the highest frequency of its case, the one that sets the launch grid of a sweep.
struct TracedScene {
  const Case& c;
  const TriangleMesh& mesh;
  Tracer tracer{mesh};
  double frequency = std::ranges::max(c.sweep.frequencies);
  std::vector<Material> materials = at_frequency(c.sweep.materials, highest_of(c.sweep));

  ReplayScene replayed() const { return {tracer, materials, c.sweep.radar}; }
};

// Over ground, tubes also arrive by way of the ground, with a launch grid of their own.
void print_lighting(const Look& look, std::size_t which, std::size_t of) {
  if (of == 1) return;
  if (which == 0) return fmt::print("lit straight:\n");
  fmt::print("lit by the ground, as from theta {:.9g} deg, phi {:.9g} deg:\n", look.transmit.theta / degree,
             look.transmit.phi / degree);
}

void trace_at(const TraceRequest& asked, const TracedScene& scene, const Look& look) {
  const std::vector<Look> lighting = lighting_looks(look, scene.c.ground);
  std::vector<std::vector<TubeTrace>> tubes;
  for (const Look& from : lighting)
    tubes.push_back(naming_the_case(scene.c, [&] {
      return TubeReplay(scene.replayed(), from, scene.frequency, scene.c.tubes).follow({asked.u, asked.v});
    }));
  print_look(asked.look, look);
  if (!scene.materials.empty())
    fmt::print("fields at {} GHz, the highest frequency of the case\n", number_text(scene.frequency / 1e9));
  for (std::size_t i = 0; i < tubes.size(); ++i) {
    print_lighting(lighting[i], i, lighting.size());
    const TubeTrace& first = tubes[i].front();
    fmt::print("tube: column {}, row {}, centre u {:.9g} m, v {:.9g} m\n", first.column, first.row, first.center.x,
               first.center.y);
    for (std::size_t way = 0; way < tubes[i].size(); ++way) print_way(tubes[i], way, scene.mesh.center);
  }
}

struct FileOption {
  const char* name;
  const char* ending;  // ParaView chooses its reader by it; empty: any
  std::string_view head;
};

constexpr FileOption paths_option{"--paths", ".vtp", tube_paths_head}, hits_option{"--hits", ".vtu", facet_hits_head},
    rays_option{"--surface-rays", "", surface_rays_head};

fs::path checked_folder(const FileOption& option, const fs::path& file) {
  if (*option.ending && file.extension() != option.ending)
    throw InputError(fmt::format("{} {}: must end in {}, by which ParaView recognises its contents; rename it", option.name,
                                 file.string(), option.ending));
  return folder_of_named_file(option.name, file, option.head);
}

void write_file(const FileOption& option, const fs::path& file, const std::function<void(const fs::path&)>& write) {
  NewResults results(checked_folder(option, file));
  write(results.folder() / file.filename());
  results.place({file.filename().string()});
}

void trace_all(const TraceRequest& asked, const TracedScene& scene, const Look& look) {
  const TriangleMesh& mesh = scene.mesh;
  const std::vector<Look> lighting = lighting_looks(look, scene.c.ground);
  TubePaths tubes;
  for (std::size_t i = 0; i < lighting.size(); ++i) {
    TubePaths here = naming_the_case(
        scene.c, [&] { return tube_paths(scene.replayed(), lighting[i], scene.frequency, scene.c.tubes, asked.most_tubes); });
    if (i == 0 && !asked.tube) print_look(asked.look, look);
    print_lighting(lighting[i], i, lighting.size());
    fmt::print("{}", tubes_text(here, facet_hits(here, mesh.triangles.size())));
    i == 0 ? void(tubes = std::move(here)) : add_lit_by_ground(tubes, std::move(here));
  }
  const FacetHits hits = facet_hits(tubes, mesh.triangles.size());
  if (!asked.paths_vtp.empty()) {
    write_file(paths_option, asked.paths_vtp, [&](const fs::path& file) { write_tube_paths_vtp(file, tubes); });
    fmt::print("paths: {}\n", asked.paths_vtp.string());
  }
  if (asked.hits_vtu.empty()) return;
  std::vector<dvec3> vertices = mesh.vertices;
  for (dvec3& vertex : vertices) vertex += mesh.center;
  write_file(hits_option, asked.hits_vtu,
             [&](const fs::path& file) { write_facet_hits_vtu(file, vertices, mesh.triangles, hits); });
  fmt::print("hits: {}\n", asked.hits_vtu.string());
}

// The rays of this look alone, at the highest frequency; over ground those of all of its paths.
std::vector<SurfaceRay> surface_rays_of(const Case& c, std::size_t look, TriangleMesh mesh) {
  const Case one = case_of_look(c, look, highest_of(c.sweep));
  const Target target(std::move(mesh), c.wedges);
  const SolvePlan plan = plan_of_case(target, one, all_threads(), false);
  if (const MechanismState& waves = plan.state("surface_waves"); !waves.on)
    throw InputError(fmt::format("--surface-rays: {} has no waves over curved surfaces: {}; leave out the option, or change that",
                                 c.file.string(), waves.why_not));
  const LookSolver solver(plan);
  std::vector<SurfaceRay> rays;
  for (const Look& path : plan.sweep.looks) std::ranges::move(solver.surface_rays(path), std::back_inserter(rays));
  return rays;
}

// A tube needs both of its coordinates; --all and --surface-rays do without.
bool wants_tube(const CLI::App& trace) {
  const bool u = trace.count("--u") > 0, v = trace.count("--v") > 0;
  if (u != v || (!u && trace.count("--all") + trace.count("--surface-rays") == 0))
    throw InputError(
        fmt::format("{} is required, with {} and --look; see raytube trace --help", u ? "--v" : "--u", u ? "--u" : "--v"));
  return u;
}

void trace_look(const TraceRequest& asked) {
  const Case c = read_case(asked.input.file, asked.input.overrides);
  require_look(c, asked.look, c.file.string() + ": --look");
  const Look& look = c.sweep.looks[asked.look];
  if (!std::isfinite(asked.u) || !std::isfinite(asked.v)) throw InputError("--u and --v must be finite numbers of metres");
  for (const auto& [option, file] :
       {std::pair{paths_option, asked.paths_vtp}, {hits_option, asked.hits_vtu}, {rays_option, asked.rays_vtp}})
    if (!file.empty()) checked_folder(option, file);  // better refused now than after the work
  LoadedMesh loaded = load_target(c);
  const Sweep along = c.ground ? sweep_of_paths(c.sweep, *c.ground, false) : c.sweep;
  naming_the_case(c, [&] { check_antennas(loaded.mesh, along); });
  if (asked.tube || asked.all_tubes) {
    const TracedScene scene{c, loaded.mesh};
    if (asked.tube) trace_at(asked, scene, look);
    if (asked.all_tubes) trace_all(asked, scene, look);
  }
  if (asked.rays_vtp.empty()) return;
  const std::vector<SurfaceRay> rays = surface_rays_of(c, asked.look, std::move(loaded.mesh));
  if (!asked.tube && !asked.all_tubes) print_look(asked.look, look);
  const double frequency = std::ranges::max(c.sweep.frequencies);
  write_file(rays_option, asked.rays_vtp,
             [&](const fs::path& file) { write_surface_rays_vtp(file, rays, wavelength(frequency)); });
  const auto from_edges = std::ranges::count(rays, SurfaceRayKind::from_an_edge, &SurfaceRay::kind);
  fmt::print("surface rays: {} at shadow boundaries, {} from edges, at {} GHz: {}\n", std::ssize(rays) - from_edges, from_edges,
             number_text(frequency / 1e9), asked.rays_vtp.string());
}

}  // namespace

CLI::App& add_trace(CommandLine& line) {
  const auto asked = std::make_shared<TraceRequest>();
  CLI::App& trace = add_command(line, "trace", "Replay tubes, bounce by bounce; rays over curved surfaces", trace_examples);
  add_case_options(trace, asked->input);
  add_value(trace, "--look I", asked->look, "Direction pair, counted from 0", whole_number(0, 1000000000))->required();
  add_value(trace, "--u U", asked->u,
            "Launch coordinate along phi-hat, from the mesh's origin [m]; not needed with --all or --surface-rays");
  add_value(trace, "--v V", asked->v, "Launch coordinate along minus theta-hat, from the mesh's origin [m]");
  add_value(trace, "--surface-rays FILE.vtp", asked->rays_vtp, "Write the rays of waves over curved surfaces, for ParaView",
            name_of_a("file"));
  CLI::Option* all = trace.add_flag("--all", asked->all_tubes, "Follow all tubes of the look and print where they go");
  add_value(trace, "--tubes N", asked->most_tubes, "Follow at most N of them, evenly spread; default 10000",
            whole_number(1, 1000000))
      ->needs(all);
  add_value(trace, "--paths FILE.vtp", asked->paths_vtp, "Write their paths as lines, for ParaView", name_of_a("file"))
      ->needs(all);
  add_value(trace, "--hits FILE.vtu", asked->hits_vtu, "Write the number of their hits on each facet, by bounce, for ParaView",
            name_of_a("file"))
      ->needs(all);
  return set_action(line, trace, [asked, &trace] {
    asked->tube = wants_tube(trace);
    trace_look(*asked);
  });
}

}  // namespace raytube
