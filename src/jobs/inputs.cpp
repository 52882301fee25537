#include "jobs/inputs.h"

#include <fmt/format.h>

#include <algorithm>

#include "case/materials/materials.h"
#include "case/motion.h"
#include "case/resolved_case.h"
#include "output/files/sha256.h"

namespace raytube {

namespace fs = std::filesystem;

namespace {

// There and back, half such a step is a sixteenth of a radian, and the lobe of a tilted plate moves by a fiftieth of its width.
constexpr double coarse_share = 0.01;

}  // namespace

std::vector<std::pair<std::string, double>> mesh_counts(const MeshReport& r) {
  const auto count = [](std::uint64_t n) { return static_cast<double>(n); };
  return {{"facets_read", count(r.facets_read)},
          {"triangles_read", count(r.triangles_read)},
          {"vertices_read", count(r.vertices_read)},
          {"vertices_welded", count(r.vertices_welded)},
          {"facets_unusable", count(r.facets_unusable)},
          {"free_forms_read", count(r.free_forms_read)},
          {"triangles_degenerate", count(r.triangles_degenerate)},
          {"triangles_duplicate", count(r.triangles_duplicate)},
          {"duplicates_of_other_material", count(r.duplicates_of_other_material)},
          {"triangles_internal", count(r.triangles_internal)},
          {"triangles_added", count(r.triangles_added)},
          {"t_junctions_split", count(r.t_junctions_split)},
          {"triangles_flipped", count(r.triangles_flipped)},
          {"triangles_traced", count(r.triangles_traced)},
          {"open_edges", count(r.open_edges)},
          {"non_manifold_edges", count(r.non_manifold_edges)},
          {"components", count(r.components)},
          {"components_closed", count(r.components_closed)},
          {"components_penetrable", count(r.components_penetrable)},
          {"components_nearly_closed", count(r.components_nearly_closed)},
          {"patches", count(r.patches)},
          {"weld_distance_m", r.weld_distance}};
}

std::vector<std::string> sha256_of_meshes(const Case& c, const MeshReport& report) {
  std::vector<std::string> hashes;
  for (const fs::path& mesh : c.mesh_files) hashes.push_back(sha256_of_file(mesh));
  for (const fs::path& further : report.further_files) hashes.push_back(sha256_of_file(further));
  return hashes;
}

Manifest described_inputs(const Case& c, const MeshReport& report, std::vector<std::string> mesh_sha256) {
  Manifest manifest;
  manifest.case_file = fs::absolute(c.file).lexically_normal().string();
  manifest.case_json = resolved_case_json(c);
  manifest.program_version = RAYTUBE_VERSION;
  manifest.mesh_sha256 = std::move(mesh_sha256);
  if (!c.looks.looks_csv.empty()) manifest.looks_csv_sha256 = sha256_of_file(c.file.parent_path() / c.looks.looks_csv);
  if (!c.radar.pattern_csv.empty()) manifest.pattern_csv_sha256 = sha256_of_file(c.file.parent_path() / c.radar.pattern_csv);
  for (const auto& [name, table] : medium_tables(c)) manifest.table_csv_sha256.emplace_back(name, sha256_of_file(table));
  for (const std::string& table : pose_tables(c))
    manifest.table_csv_sha256.emplace_back(table, sha256_of_file(c.file.parent_path() / table));
  manifest.mesh_report = mesh_counts(report);
  for (const MeshNote& note : report.notes()) manifest.mesh_notes.emplace_back(note.what, static_cast<double>(note.count));
  return manifest;
}

std::vector<std::string> reading_sentences(const Case& c, const MeshReport& report) {
  std::vector<std::string> sentences = report.remarks;
  if (report.free_forms_read > 0)
    sentences.push_back(
        fmt::format("{} free-form curves and surfaces were ignored, only polygons are read; export the mesh as polygons",
                    report.free_forms_read));
  const double wavelength = speed_of_light / std::ranges::max(c.sweep.frequencies);
  if (report.coordinate_step > coarse_share * wavelength)
    sentences.push_back(
        fmt::format("coordinates are rounded to steps of {:.3g} mm, too coarse for a wavelength of {:.3g} mm; move the target "
                    "close to the origin before exporting it, or export it with more digits (as text, or in double precision)",
                    report.coordinate_step * 1e3, wavelength * 1e3));
  return sentences;
}

}  // namespace raytube
