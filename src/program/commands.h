// The room of the program: the command line, and nothing that another program could want.
//
//     command_line  arguments -> Request;  main: Request -> command, exceptions -> sentence and exit code
//     run/          raytube run and merge: a case into its folder, or shards of it
//     check, trace, compare, converge, convert, sources, profile, isar, centres: the commands, each in a file of its name
//     python        hands plot, statistics, report and the comparison of images to the Python package, and draws with it
//     products      what profile, isar and centres take (a result, a case that is run first, or the pieces
//                   of a look), and what they leave
//     solve_warnings   what is said before and after a solve
//     work          where files go (destination), how a command brings them into place (results), survives being stopped
//                   (interrupt, look_journal) and tells how far it is (progress_bar)
//
// This file: what the user asked for, and the commands that answer.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "imaging/window.h"
#include "scene/random_result.h"

namespace raytube {

class Ranks;

/// What profile and isar make of a sweep.
struct ProductRequest {
  Window window;                              // over frequencies, of images over angles, too
  int padding = 4;                            // profile: ranges to a resolution cell
  double pixels = 4.0;                        // isar: cells of the image to a resolution cell
  bool direct = false;                        // from pieces of one look at one frequency, without the sweep
  std::size_t centres = 50;                   // centres: so many at most
  double resolution = 0.0;                    // centres: of the places [m]; 0: what suits the target
  std::vector<std::string> mechanisms;        // direct: these alone; empty: all
  std::vector<std::string> size_words;        // isar: what follows --size; perhaps the input at the end
  std::vector<double> size;                   // isar: of the image along its axes [m]; empty: the target's
  std::optional<std::array<double, 2>> plan;  // isar: size and resolution of a target to be planned for [m]; nothing is computed
  double plan_ghz = 10.0;                     // isar: middle of the planned band
};

/// What run makes a case of where it is given a mesh. Numbers as "10", "9,10,11" or "0:360:1".
struct MeshRequest {
  std::string unit, ghz, azimuth = "0", elevation = "0";
};

struct Request {
  void (*action)(const Request&) = nullptr;  // the command; null: help or version was printed
  bool shared = false;                       // by the processes of a job
  bool by_python = false;                    // the words are for the Python package
  std::vector<std::string> words;            // of the command line
  std::filesystem::path case_file;
  std::vector<std::filesystem::path> studied;  // converge: netCDF files in place of a case
  std::vector<std::string> overrides;
  std::filesystem::path output_folder;  // empty: <case folder>/out; compare: no files; run: perhaps one file, *.nc
  int threads = 0;                      // 0: all cores
  std::string instruction_set;          // empty: the widest one
  int planned_ranks = 0;                // check: of a job by MPI; 0: none
  std::filesystem::path wedge_list;     // check: list of wedges; empty: none wanted
  MeshRequest mesh;                     // run, where case_file is a mesh
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
  std::optional<double> tolerance_db;             // compare: fails above it
  std::optional<std::size_t> min_matched;         // compare: fails below it; none: all rows of the smaller table
  bool json = false;                              // check, compare, centres: one JSON document instead of the text
  std::optional<double> tolerance_relative;       // same
  ProductRequest product;                         // profile, isar; their input is `result`
};

/// Throws InputError for a command line that cannot be understood.
Request parse_command_line(int argc, const char* const* argv);

/// Where run is given a mesh: writes the case that its options make as case.toml into the folder of the results (for -o FILE.nc
/// as FILE.toml beside it), over one that raytube wrote earlier, and names that case in the request. Throws InputError for
/// options that are missing, or that a case has keys for.
void make_case_of_mesh(Request& request);

// Each throws InputError for bad input.
void run_command(const Request& request);
void check_command(const Request& request);
void trace_command(const Request& request);
bool compares_images(const Request& request);  // which the Python package does
void compare_command(const Request& request);
void converge_command(const Request& request);
void converge_results(const Request& request);  // converge_command for results that are there
void convert_command(const Request& request);
void sources_command(const Request& request);
void profile_command(const Request& request);
void isar_command(const Request& request);
void centres_command(const Request& request);
void merge_command(const Request& request);

/// Of a process that does not lead its job: computes for the one that does, and does the same command.
void help_command(const Request& request);

}  // namespace raytube
