#include "program/trace_all.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "case/target.h"
#include "core/error.h"
#include "output/vtk/facet_hits_vtu.h"
#include "output/vtk/tube_paths_vtp.h"
#include "program/results.h"
#include "program/solvable.h"
#include "sbr/tube_paths.h"
#include "solve/plan.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

constexpr const char *paths_option = "--paths", *hits_option = "--hits";

// ParaView chooses its reader by the ending.
fs::path folder_of_vtk_file(const char* option, const fs::path& file, const char* ending, std::string_view head) {
  if (file.extension() != ending)
    throw InputError(
        fmt::format("{} {}: must end in {}, by which ParaView knows what it holds; add that", option, file.string(), ending));
  return folder_of_named_file(option, file, head);
}

fs::path folder_of_paths(const fs::path& file) { return folder_of_vtk_file(paths_option, file, ".vtp", tube_paths_head); }
fs::path folder_of_hits(const fs::path& file) { return folder_of_vtk_file(hits_option, file, ".vtu", facet_hits_head); }

void print_ends(const TubePaths& tubes) {
  std::array<std::size_t, 5> ended{};
  for (const TubePath& path : tubes.paths) ++ended[static_cast<std::size_t>(path.end)];
  fmt::print("ended: {} left the scene, {} cut at tubes.max_bounces, {} lost, {} absorbed, {} transmitted\n", ended[0], ended[1],
             ended[2], ended[3], ended[4]);
}

void print_tubes(const TubePaths& tubes) {
  fmt::print("launch grid: {} columns, {} rows; ", tubes.columns, tubes.rows);
  const std::uint64_t all = std::uint64_t{tubes.columns} * tubes.rows;
  if (tubes.stride == 1)
    fmt::print("all {} tubes followed\n", all);
  else
    fmt::print("{} of {} tubes followed, the middle one of every {} x {} cells\n", tubes.followed, all, tubes.stride,
               tubes.stride);
  fmt::print("{} of them meet the target\n", tubes.paths.size());
}

void print_bounces(const FacetHits& hits) {
  for (std::size_t i = 0; i < hits.at_bounce.size(); ++i) {
    const std::vector<std::uint32_t>& facets = hits.at_bounce[i];
    fmt::print("bounce {}: {} hits on {} of {} facets\n", i + 1, std::accumulate(facets.begin(), facets.end(), std::uint64_t{0}),
               std::ranges::count_if(facets, [](std::uint32_t count) { return count > 0; }), facets.size());
  }
}

void write_paths(const fs::path& file, const TubePaths& tubes) {
  NewResults results(folder_of_paths(file));
  write_tube_paths_vtp(results.folder() / file.filename(), tubes);
  results.place({file.filename().string()});
  fmt::print("paths: {}\n", file.string());
}

void write_hits(const fs::path& file, const TriangleMesh& mesh, const FacetHits& hits) {
  NewResults results(folder_of_hits(file));
  std::vector<dvec3> vertices = mesh.vertices;
  for (dvec3& vertex : vertices) vertex += mesh.center;
  write_facet_hits_vtu(results.folder() / file.filename(), vertices, mesh.triangles, hits);
  results.place({file.filename().string()});
  fmt::print("hits: {}\n", file.string());
}

}  // namespace

void check_trace_files(const Request& request) {
  if (!request.tube_paths_vtp.empty()) folder_of_paths(request.tube_paths_vtp);
  if (!request.facet_hits_vtu.empty()) folder_of_hits(request.facet_hits_vtu);
}

TubePaths all_tubes(const Request& request, const Case& c, const TriangleMesh& mesh, std::size_t frequency) {
  const Tracer tracer(mesh);
  const std::vector<Material> materials = at_frequency(c.sweep.materials, frequency);
  return naming_the_case(c, [&] {
    return tube_paths({tracer, materials, c.sweep.radar}, c.sweep.looks[request.look], c.sweep.frequencies[frequency], c.tubes,
                      request.most_tubes);
  });
}

void tell_tubes(const Request& request, const TriangleMesh& mesh, const TubePaths& tubes) {
  const FacetHits hits = facet_hits(tubes, mesh.triangles.size());
  print_tubes(tubes);
  print_bounces(hits);
  print_ends(tubes);
  if (!request.tube_paths_vtp.empty()) write_paths(request.tube_paths_vtp, tubes);
  if (!request.facet_hits_vtu.empty()) write_hits(request.facet_hits_vtu, mesh, hits);
}

}  // namespace raytube
