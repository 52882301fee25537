// run.json: what was computed, with what, and what happened.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "scene/results.h"

namespace raytube {

struct Timing {
  double read_s = 0.0;   // case and mesh file -> welded, oriented mesh
  double build_s = 0.0;  // ray-tracing structure and wedges
  double total_s = 0.0;  // from the start of the command to the last table; no plots
};

struct Manifest {
  std::string case_file;  // absolute; file names in the resolved case are relative to its folder
  std::string case_json;  // the resolved case, valid JSON
  std::string program_version;
  std::vector<std::string> mesh_sha256;                               // of each mesh file, then of the files that these name
  std::string looks_csv_sha256;                                       // empty: no look list
  std::string pattern_csv_sha256;                                     // empty: no antenna pattern
  std::vector<std::pair<std::string, std::string>> table_csv_sha256;  // of each table of a medium or of poses: its name first
  std::string embree_instruction_set, own_instruction_set;
  int threads = 1;
  std::vector<std::pair<std::string, double>> mesh_report;  // name and count, in the order they are written
  std::vector<std::pair<std::string, double>> mesh_notes;   // sentence and count
  std::vector<std::string> warnings;                        // about features too small and steps too wide
  Statistics statistics;
  std::vector<ModelPart> model_parts;  // of the model uncertainty; their rows are not written
  Timing time;
  std::uint64_t looks_resumed = 0;  // computed by earlier runs, whose time is not in solve_s
  std::uint64_t peak_rss_bytes = 0;
  std::string rcs_csv_sha256;
};

/// What a result should carry wherever it goes, by name: title and resolved case, version, hashes, warnings, counts, parts of the
/// model uncertainty; JSON but for single words. Nothing of the machine, its folders or its time: equal runs say the same.
std::vector<std::pair<std::string, std::string>> attributes_of(const Manifest& manifest);

/// Writes run.json. Throws std::runtime_error if the disk does not take it.
void write_manifest(const std::filesystem::path& file, const Manifest& manifest);

}  // namespace raytube
