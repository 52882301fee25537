// What profile, isar, doppler and centres have in common: the input, which is a result, a case that is run first, or a case that
// is taken to pieces, and the files that come of it.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "case/data/case.h"
#include "imaging/direct.h"
#include "imaging/window.h"
#include "output/netcdf/stored_result.h"
#include "plan/target.h"
#include "program/options.h"
#include "program/work/destination.h"
#include "program/work/results.h"
#include "scene/scattering_piece.h"

namespace raytube {

/// Options of profile, isar and doppler.
struct SweepOptions {
  RunOptions run;  // its input may be a result
  Window window;   // over frequencies, and for images also over angles
  bool direct = false;
  std::vector<std::string> mechanisms;  // with direct; empty: all
};

void add_sweep_input(CLI::App& command, SweepOptions& options, bool required);
void add_window_options(CLI::App& command, Window& window);
void add_product_options(CommandLine& line, CLI::App& command, RunOptions& run);
/// Both, and the options of --direct.
void add_sweep_options(CommandLine& line, CLI::App& command, SweepOptions& options);

/// Throws InputError if --sidelobes does not go with the window.
void check_sidelobes(const CLI::App& command, const Window& window);

struct ProductSource {
  std::optional<Case> of_case{};  // the case that is run, or taken to pieces
  std::string name;               // for sentences: the file
  std::string title;              // for pictures
  StoredResult result;
  std::shared_ptr<const Target> target;  // null for a result without run.json beside it, or whose meshes have changed since

  /// Points of the target as wide as all of it, in its own coordinates; none if it is not known.
  std::vector<dvec3> outermost() const;
  /// The longest of its wedges, in its own coordinates.
  std::vector<std::array<dvec3, 2>> lines() const;
};

/// The source for a case that is not solved yet.
ProductSource source_of(const Case& c, std::shared_ptr<const Target> target);

/// A progress bar for the work on one look at one frequency, shown once the work has begun.
std::function<bool(double)> progress_of_pieces(bool quiet, std::size_t look, double frequency);

/// Passes everything that scatters in one look of the case, by the mechanisms that are asked for, to `sink`, in pieces of `cell`
/// [m], at the frequency in the middle of the case's list.
void direct_pieces(const SweepOptions& asked, const ProductSource& source, std::size_t look, double cell,
                   const std::function<void(const PlacedScatterer&)>& sink);

/// The results of a command: the files of a folder, or one netCDF file, which also stands in the folder if the case has
/// output.netcdf.
struct Product {
  ResultNames names;                    // of all files
  std::string netcdf;                   // the one of them that is the netCDF file
  bool from_pieces = false;             // a case is taken to pieces, not run
  bool json = false;                    // the printed text is a JSON document, and nothing else is printed
  std::function<void()> check{};        // throws InputError for a sweep that nothing can be made of; S is not there yet
  std::function<std::string()> make{};  // returns the text to print
  std::function<void(const std::filesystem::path&)> write_files{}, write_netcdf{};  // into a folder; to a file
  std::string drawn{};          // the table that pictures are drawn from; empty: none
  std::filesystem::path run{};  // the run's folder, or the case, for the target in pictures; empty: the folder of the table
  ProductSource source{};       // set before any of these is called

  void write(const std::filesystem::path& folder, const Destination& destination, bool with_netcdf) const;
};

/// raytube run. `product`: what is made of the result, in the same folder at the same moment, or in place of it in one netCDF
/// file; null for none.
void run_case(const RunOptions& run, Product* product);

/// Makes the product of a case, with its run or from pieces, or of a result, whose folder then is the usual one.
void make_product(RunOptions run, Product& product);

}  // namespace raytube
