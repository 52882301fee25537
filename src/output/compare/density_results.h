// Results of one case at several densities, made earlier: what a study of convergence can take.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "output/compare/convergence.h"
#include "output/netcdf/stored_result.h"

namespace raytube {

/// A result, and the file that it was read from.
struct ResultFile {
  std::filesystem::path file;
  StoredResult result;
};

/// The attribute of that name; empty if there is none.
std::string attribute_of(const StoredResult& result, const std::string& name);

/// The results from coarse to fine; times are NaN. Densities come from the resolved cases in the attributes, which differ in
/// nothing else than in it, in words and in what is written; rows and mesh are the same. Throws InputError for a file that does
/// not go with the first one, for adaptive tubes, which have no density to study, and for fewer than three densities.
std::vector<DensityResult> density_results(const std::vector<ResultFile>& files);

}  // namespace raytube
