// Tables of measured media: table_csv.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scene/layers.h"

namespace raytube {

/// How losses are written, for sentences about gain: those of mu_r if `key` is about it, else of eps_r.
std::string loss_convention(std::string_view key);

/// A medium measured at some frequencies, ascending [Hz].
struct MediumTable {
  std::vector<double> frequencies;
  std::vector<Medium> media;

  /// Linear between the rows; the frequency lies between the first and the last.
  Medium at(double frequency) const;
};

/// From a CSV file with the header freq_ghz,eps_real,eps_loss or freq_ghz,eps_real,eps_loss,mu_real,mu_loss. Throws InputError
/// with the line; if the file cannot be read, the sentence begins with `location`.
MediumTable read_medium_csv(const std::filesystem::path& file, const std::string& location);

}  // namespace raytube
