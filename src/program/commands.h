// The room of the program: the command line, and nothing that another program could want.
//
//     command_line  arguments -> Request;  main: Request -> command, exceptions -> sentence and exit code
//     run/          raytube run and merge: a case into its folder, or shards of it
//     check, trace, compare, converge, convert, sources, profile, isar, centres, plot, statistics: the commands, each in a
//                   file of its name
//     report/       raytube report: a page of a result
//     products      what profile, isar and centres take (a result, or a case that is solved first), and what they leave
//     solve_warnings   what is said before and after a solve
//     result_commands  command line of plot and statistics
//     work          where files go (destination), how a command brings them into place (results), survives being stopped
//                   (interrupt, look_journal) and tells how far it is (progress_bar)
//
// This file: what the user asked for, and the commands that answer.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "imaging/window.h"
#include "program/result_commands.h"
#include "scene/random_result.h"

namespace raytube {

class Ranks;

enum class Command {
  none,
  run,
  check,
  trace,
  compare,
  converge,
  convert,
  sources,
  profile,
  isar,
  centres,
  plot,
  statistics,
  report,
  merge
};

/// What profile and isar make of a sweep.
struct ProductRequest {
  Window window;                              // over frequencies, of images over angles, too
  int padding = 4;                            // profile: ranges to a resolution cell
  double pixels = 4.0;                        // isar: cells of the image to a resolution cell
  bool direct = false;                        // from pieces of one look at one frequency, without the sweep
  std::size_t centres = 50;                   // centres: so many at most
  double resolution = 0.0;                    // centres: of the places [m]; 0: what suits the target
  std::vector<std::string> mechanisms;        // direct: these alone; empty: all
  std::vector<double> size;                   // isar: of the image along its axes [m]; empty: the target's
  std::optional<std::array<double, 2>> plan;  // isar: size and resolution of a target to be planned for [m]; nothing is computed
  double plan_ghz = 10.0;                     // isar: middle of the planned band
};

/// The page that report makes of a result.
struct ReportRequest {
  std::filesystem::path file;      // empty: report.html beside the result
  std::vector<std::size_t> looks;  // shown in space; empty: report chooses
};

struct Request {
  Command command = Command::none;  // none: help or version was printed
  std::filesystem::path case_file;
  std::vector<std::filesystem::path> studied;  // converge: netCDF files in place of a case
  std::vector<std::string> overrides;
  std::filesystem::path output_folder;  // empty: <case folder>/out; compare: no files; run: perhaps one file, *.nc
  int threads = 0;                      // 0: all cores
  std::string instruction_set;          // empty: the widest one
  int planned_ranks = 0;                // check: of a job by MPI; 0: none
  std::filesystem::path wedge_list;     // check: list of wedges; empty: none wanted
  bool parts = false;
  std::optional<RandomOptions> random;  // run: --launch random
  bool resume = false;                  // run: go on with what a stopped one has left
  std::optional<std::string> shard;     // run: this one of several parts of the looks alone
  std::filesystem::path merged_folder;  // merge: of the shards
  Ranks* ranks = nullptr;               // of the job of several processes that this is one of; null: it is alone
  bool quiet = false;
  std::size_t look = 0;
  double u = 0.0, v = 0.0;                        // launch coordinates [m], origin = mesh origin
  bool tube = true;                               // trace: the tube there
  bool all_tubes = false;                         // trace: all tubes of the look
  std::uint64_t most_tubes = 10000;               // of these, so many at most
  std::filesystem::path tube_paths_vtp;           // trace: their paths; empty: none wanted
  std::filesystem::path facet_hits_vtu;           // trace: their hits; empty: none wanted
  std::filesystem::path surface_rays_vtp;         // trace: rays over curved surfaces; empty: none wanted
  std::string densities = "2,4,8,16,32,64";       // converge: tubes per wavelength
  std::filesystem::path result, reference;        // compare; convert: from, to
  std::string result_columns, reference_columns;  // compare: OURS=THEIRS,...
  bool free_scale = false;                        // compare: fit one factor first
  bool no_register = false;                       // compare: images where they are
  std::vector<std::string> only;                  // compare: COLUMN=LOW:HIGH
  double within_db = 20.0;                        // compare: rows that count
  std::optional<double> tolerance_db;             // compare: fall short above it
  std::optional<double> tolerance_relative;       // same
  ProductRequest product;                         // profile, isar; their input is `result`
  PlotRequest plot;
  StatisticsRequest statistics;
  ReportRequest report;  // of `result`, which may be a folder
};

/// Throws InputError for a command line that cannot be understood.
Request parse_command_line(int argc, const char* const* argv);

// Each throws InputError for bad input.
void run_command(const Request& request);
void check_command(const Request& request);
void trace_command(const Request& request);
void compare_command(const Request& request);
void converge_command(const Request& request);
void converge_results(const Request& request);  // converge_command for results that are there
void convert_command(const Request& request);
void sources_command(const Request& request);
void profile_command(const Request& request);
void isar_command(const Request& request);
void centres_command(const Request& request);
void report_command(const Request& request);
void merge_command(const Request& request);

/// Of a process that does not lead its job: computes for the one that does, and does the same command.
void help_command(const Request& request);

}  // namespace raytube
