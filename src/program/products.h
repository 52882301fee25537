// What profile, isar and centres make: of a result that is there, of a case that is run first, or of the pieces of one look.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "case/data/case.h"
#include "imaging/direct.h"
#include "output/netcdf/stored_result.h"
#include "plan/target.h"
#include "program/commands.h"
#include "program/work/destination.h"
#include "program/work/results.h"
#include "scene/scattering_piece.h"

namespace raytube {

struct ProductSource {
  std::optional<Case> of_case{};  // it is run from, or is to be taken to pieces
  std::string name;               // for sentences: the file
  std::string title;              // for pictures
  StoredResult result;
  std::shared_ptr<const Target> target;  // of a case, and of a result beside whose run.json its meshes are as they were

  /// Points of the target as wide as all of it, in its own coordinates; none if it is not known.
  std::vector<dvec3> outermost() const;
  /// Its wedges, the longest, in its own coordinates.
  std::vector<std::array<dvec3, 2>> lines() const;
};

/// Of a case, without S.
ProductSource source_of(const Case& c, std::shared_ptr<const Target> target);

/// Of a file, an rcs.csv of raytube's or a .nc. Throws InputError.
ProductSource stored_source(const std::filesystem::path& file);

/// Of the work on one look at one frequency, shown once it has begun.
std::function<bool(double)> progress_of_pieces(const Request& request, std::size_t look, double frequency);

/// Of one look of the case, at the frequency in the middle of its list, all that scatters by the mechanisms that are asked for,
/// in pieces of `cell` [m].
void direct_pieces(const Request& request, const ProductSource& source, std::size_t look, double cell,
                   const std::function<void(const PlacedScatterer&)>& sink);

/// What a command makes: files of a folder; or one netCDF file, which also stands in the folder of a case with output.netcdf.
struct Product {
  ResultNames names;                    // of all of them
  std::string netcdf;                   // among the names
  std::function<void()> check{};        // throws InputError for a sweep that nothing can be made of; S is not there yet
  std::function<std::string()> make{};  // and what is printed of it
  std::function<void(const std::filesystem::path&)> write_files{}, write_netcdf{};  // into a folder; to a file
  std::string drawn{};                                                              // the table that pictures are drawn of
  std::filesystem::path run{};  // folder of the run, or case, whose target they outline; empty: the folder of the table
  ProductSource source{};       // there when one of these is called

  void write(const std::filesystem::path& folder, const Destination& destination, bool with_netcdf) const;
};

/// raytube run. `product`: what is made of the result, in the same folder at the same moment, or in place of it in one netCDF
/// file; null for none.
void run_case(const Request& request, Product* product);

/// The lengths of --size [m], "8 8", "8x8" or "8,8,2". The last word may be the input that follows it on the command line, if
/// there is none yet. Throws InputError.
std::vector<double> lengths_of_size(const std::vector<std::string>& words, std::filesystem::path& input);

/// Of a case: with its run, whose files are in the folder, too; or of pieces alone. Of a result: into the folder asked for, else
/// its own.
void make_product(const Request& request, Product& product);

}  // namespace raytube
