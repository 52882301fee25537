// raytube trace: one tube, bounce by bounce; all tubes; the rays of waves over curved surfaces.
#include <fmt/format.h>

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
#include "program/commands.h"
#include "program/work/results.h"
#include "sbr/replay.h"
#include "sbr/tube_paths.h"
#include "solve/look_solver.h"

namespace raytube {

namespace {

std::string vector_text(const dvec3& v) {
  return fmt::format("({: .9g}, {: .9g}, {: .9g})", v.x + 0.0, v.y + 0.0, v.z + 0.0);  // + 0.0: no "-0"
}

std::string direction_text(const Direction& d) {
  return fmt::format("theta {} deg, phi {} deg", number_text(decimal_degrees(d.theta)), number_text(decimal_degrees(d.phi)));
}

// Real where it is real, else with its imaginary part behind it.
std::string field_text(const ComplexVector& e) {
  const std::string real = vector_text(e.re);
  return e.im == dvec3(0.0) ? real : fmt::format("{} + j {}", real, vector_text(e.im));
}

double incidence_deg(const dvec3& direction_in, const dvec3& normal) {
  return std::acos(std::clamp(std::abs(glm::dot(direction_in, normal)), 0.0, 1.0)) / degree;
}

void print_bounce(int number, const TubeBounce& bounce, const dvec3& direction_in, const dvec3& mesh_center) {
  fmt::print("bounce {}: triangle {}, patch {}\n", number, bounce.triangle, bounce.patch);
  fmt::print("  point          {} m\n", vector_text(bounce.point + mesh_center));
  fmt::print("  normal         {}\n", vector_text(bounce.normal));
  fmt::print("  incidence      {:.6g} deg\n", incidence_deg(direction_in, bounce.normal));
  fmt::print("  leaves along   {}\n", vector_text(bounce.direction_out));
  fmt::print("  path           {:.12g} m\n", bounce.path);
  fmt::print("  field of V     {}\n", field_text(bounce.field[0]));
  fmt::print("  field of H     {}\n", field_text(bounce.field[1]));
}

// Of the way on behind what the tube has met as the `met`-th surface.
void print_parting(const std::vector<TubeTrace>& ways, std::size_t way, int met) {
  const auto parts_here = [&](const TubeTrace& t) { return t.parting.way == way && t.parting.met == met; };
  const auto behind = std::ranges::find_if(ways.begin() + 1, ways.end(), parts_here);
  fmt::print("  goes on        behind the surface, too: {}\n",
             behind == ways.end() ? fmt::format("not followed, as a way beyond {}", TubeReplay::most_ways)
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

const Look& chosen_look(const Case& c, std::size_t index) {
  require_look(c, index, c.file.string() + ": --look");
  return c.sweep.looks[index];
}

// The grid of a sweep is laid at its highest frequency.
std::size_t highest_of(const Sweep& sweep) {
  return static_cast<std::size_t>(std::ranges::max_element(sweep.frequencies) - sweep.frequencies.begin());
}

// Over a medium tubes come straight, or by way of the ground, with a launch grid of their own.
void print_lighting(const Look& look, std::size_t which, std::size_t of) {
  if (of == 1) return;
  if (which == 0) return fmt::print("lit straight:\n");
  fmt::print("lit by the ground, as from theta {:.9g} deg, phi {:.9g} deg:\n", look.transmit.theta / degree,
             look.transmit.phi / degree);
}

void print_tube(const std::vector<TubeTrace>& ways, const dvec3& mesh_center) {
  const TubeTrace& trace = ways.front();
  fmt::print("tube: column {}, row {}, centre u {:.9g} m, v {:.9g} m\n", trace.column, trace.row, trace.center.x, trace.center.y);
  for (std::size_t way = 0; way < ways.size(); ++way) print_way(ways, way, mesh_center);
}

void trace_at(const Request& request, const Case& c, const Look& look, const TriangleMesh& mesh) {
  const Tracer tracer(mesh);
  const std::size_t highest = highest_of(c.sweep);
  const double frequency = c.sweep.frequencies[highest];
  const std::vector<Material> materials = at_frequency(c.sweep.materials, highest);
  const ReplayScene scene{tracer, materials, c.sweep.radar};
  const std::vector<Look> lighting = lighting_looks(look, c.ground);
  std::vector<std::vector<TubeTrace>> tubes;
  for (const Look& from : lighting)
    tubes.push_back(naming_the_case(c, [&] {
      return TubeReplay(scene, from, frequency, c.tubes).follow({request.u, request.v});
    }));
  print_look(request.look, look);
  if (!materials.empty()) fmt::print("fields at {} GHz, the highest frequency of the case\n", number_text(frequency / 1e9));
  for (std::size_t i = 0; i < tubes.size(); ++i) {
    print_lighting(lighting[i], i, lighting.size());
    print_tube(tubes[i], mesh.center);
  }
}

// --- all tubes of a look ---

// ParaView chooses its reader by the ending.
std::filesystem::path folder_of_vtk_file(const char* option, const std::filesystem::path& file, const char* ending,
                                         std::string_view head) {
  if (file.extension() != ending)
    throw InputError(
        fmt::format("{} {}: must end in {}, by which ParaView knows what it holds; name it so", option, file.string(), ending));
  return folder_of_named_file(option, file, head);
}

std::filesystem::path folder_of_paths(const std::filesystem::path& file) {
  return folder_of_vtk_file("--paths", file, ".vtp", tube_paths_head);
}

std::filesystem::path folder_of_hits(const std::filesystem::path& file) {
  return folder_of_vtk_file("--hits", file, ".vtu", facet_hits_head);
}

TubePaths all_tubes(const Request& request, const Case& c, const Look& look, const TriangleMesh& mesh) {
  const Tracer tracer(mesh);
  const std::size_t highest = highest_of(c.sweep);
  const std::vector<Material> materials = at_frequency(c.sweep.materials, highest);
  return naming_the_case(c, [&] {
    return tube_paths({tracer, materials, c.sweep.radar}, look, c.sweep.frequencies[highest], c.tubes, request.most_tubes);
  });
}

void write_paths(const std::filesystem::path& file, const TubePaths& tubes) {
  NewResults results(folder_of_paths(file));
  write_tube_paths_vtp(results.folder() / file.filename(), tubes);
  results.place({file.filename().string()});
  fmt::print("paths: {}\n", file.string());
}

void write_hits(const std::filesystem::path& file, const TriangleMesh& mesh, const FacetHits& hits) {
  NewResults results(folder_of_hits(file));
  std::vector<dvec3> vertices = mesh.vertices;
  for (dvec3& vertex : vertices) vertex += mesh.center;
  write_facet_hits_vtu(results.folder() / file.filename(), vertices, mesh.triangles, hits);
  results.place({file.filename().string()});
  fmt::print("hits: {}\n", file.string());
}

void trace_all(const Request& request, const Case& c, const Look& look, const TriangleMesh& mesh) {
  const std::vector<Look> lighting = lighting_looks(look, c.ground);
  TubePaths tubes;
  for (std::size_t i = 0; i < lighting.size(); ++i) {
    TubePaths here = all_tubes(request, c, lighting[i], mesh);
    if (i == 0 && !request.tube) print_look(request.look, look);
    print_lighting(lighting[i], i, lighting.size());
    fmt::print("{}", tubes_text(here, facet_hits(here, mesh.triangles.size())));
    i == 0 ? void(tubes = std::move(here)) : add_lit_by_ground(tubes, std::move(here));
  }
  const FacetHits hits = facet_hits(tubes, mesh.triangles.size());
  if (!request.tube_paths_vtp.empty()) write_paths(request.tube_paths_vtp, tubes);
  if (!request.facet_hits_vtu.empty()) write_hits(request.facet_hits_vtu, mesh, hits);
}

// --- rays over curved surfaces ---

std::filesystem::path folder_of_rays(const std::filesystem::path& file) {
  return folder_of_named_file("--surface-rays", file, surface_rays_head);
}

// The look alone, at the highest frequency: nothing is computed for others. Over ground those of all of its paths.
std::vector<SurfaceRay> surface_rays_of(const Case& c, std::size_t look, TriangleMesh mesh) {
  const Case one = case_of_look(c, look, highest_of(c.sweep));
  const Target target(std::move(mesh), c.wedges);
  const SolvePlan plan = plan_of_case(target, one, all_threads(), false);
  if (const MechanismState waves = entry_of(MechanismId::surface_waves).state(plan); !waves.on)
    throw InputError(fmt::format("--surface-rays: {} has no waves over curved surfaces: {}; leave out the option, or change that",
                                 c.file.string(), waves.why_not));
  const LookSolver solver(plan);
  std::vector<SurfaceRay> rays;
  for (const Look& path : plan.sweep.looks) std::ranges::move(solver.surface_rays(path), std::back_inserter(rays));
  return rays;
}

void write_rays(const std::filesystem::path& file, std::span<const SurfaceRay> rays, double frequency) {
  NewResults results(folder_of_rays(file));
  write_surface_rays_vtp(results.folder() / file.filename(), rays, wavelength(frequency));
  results.place({file.filename().string()});
  const auto from_edges = std::ranges::count(rays, SurfaceRayKind::from_an_edge, &SurfaceRay::kind);
  fmt::print("surface rays: {} at shadow boundaries, {} from edges, at {} GHz: {}\n", std::ssize(rays) - from_edges, from_edges,
             number_text(frequency / 1e9), file.string());
}

// Better now than after the work.
void check_files(const Request& request) {
  if (!request.tube_paths_vtp.empty()) folder_of_paths(request.tube_paths_vtp);
  if (!request.facet_hits_vtu.empty()) folder_of_hits(request.facet_hits_vtu);
  if (!request.surface_rays_vtp.empty()) folder_of_rays(request.surface_rays_vtp);
}

}  // namespace

void trace_command(const Request& request) {
  const Case c = read_case(request.case_file, request.overrides);
  const Look& look = chosen_look(c, request.look);
  if (!std::isfinite(request.u) || !std::isfinite(request.v)) throw InputError("--u and --v must be finite numbers of metres");
  check_files(request);
  LoadedMesh loaded = load_target(c);
  const Sweep along = c.ground ? sweep_of_paths(c.sweep, *c.ground, false) : c.sweep;
  naming_the_case(c, [&] { check_antennas(loaded.mesh, along); });
  if (request.tube) trace_at(request, c, look, loaded.mesh);
  if (request.all_tubes) trace_all(request, c, look, loaded.mesh);
  if (request.surface_rays_vtp.empty()) return;
  const std::vector<SurfaceRay> rays = surface_rays_of(c, request.look, std::move(loaded.mesh));
  if (!request.tube && !request.all_tubes) print_look(request.look, look);
  write_rays(request.surface_rays_vtp, rays, c.sweep.frequencies[highest_of(c.sweep)]);
}

}  // namespace raytube
