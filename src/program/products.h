// What range profiles and images are made of: a result that is there, or a case that is solved first.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "case/data/case.h"
#include "core/json.h"
#include "imaging/direct.h"
#include "output/netcdf/stored_result.h"
#include "plan/target.h"
#include "program/commands.h"
#include "program/work/results.h"
#include "scene/scattering_piece.h"

namespace raytube {

struct ProductSource {
  std::optional<Case> of_case{};  // it was solved from, or is to be taken to pieces
  std::string name;               // for sentences: the file
  std::string title;              // for pictures
  StoredResult result;
  bool unusable_rows = false;            // of a case: said already
  std::unique_ptr<const Target> target;  // of a case, and of a result beside whose run.json its meshes are as they were

  /// Points of the target as wide as all of it, in its own coordinates; none if it is not known.
  std::vector<dvec3> outermost() const;
  /// Its wedges, the longest, in its own coordinates.
  std::vector<std::array<dvec3, 2>> lines() const;
};

/// run.json beside a result; none if there is none.
std::optional<JsonValue> run_of(const std::filesystem::path& result);

/// The case of run.json, with the settings that it was run with, also those of --set. Throws InputError if it cannot be read.
Case case_of_run(const JsonValue& run);

/// Throws InputError for a sweep that nothing can be made of; S is not there yet.
using SweepCheck = std::function<void(const ProductSource&)>;

/// Of one look of the case, at the frequency in the middle of its list, all that scatters by the mechanisms that are asked for,
/// in pieces of `cell` [m].
void direct_pieces(const Request& request, const ProductSource& source, std::size_t look, double cell,
                   const std::function<void(const PlacedScatterer&)>& sink);

/// The case, if the input is a .toml, solved unless a direct product is asked for; else the result, a .csv of raytube's or a .nc.
/// Throws InputError, as `check` does, of a case before it is solved.
ProductSource product_source(const Request& request, const SweepCheck& check);

/// What a command makes: files of a folder; or one netCDF file, which also stands in the folder of a case with output.netcdf.
struct ProductNames {
  ResultNames files;
  std::string netcdf;
};

/// Throws InputError if they cannot be placed where they are asked for, or would replace an input.
void check_products(const Request& request, const ProductSource& source, const ProductNames& names);

struct ProductWriter {
  std::function<void(const std::filesystem::path&)> files, netcdf;  // into a folder; to a file
};

/// Brings into their place what is written, of a case that was solved also the result as rcs.nc: into the folder asked for, else
/// `out` beside a case, else that of the result. Tells where they are. Throws std::runtime_error in the end for a result with
/// rows that must not be used.
void write_products(const Request& request, const ProductSource& source, const ProductNames& names, const ProductWriter& write);

}  // namespace raytube
