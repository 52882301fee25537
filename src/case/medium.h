// What a surface is made of: the keys of a medium, and its permittivity and permeability at each frequency.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "case/case.h"
#include "case/document.h"

namespace raytube {

/// How losses are written, for sentences about gain: those of mu_r if `key` is about it, else of eps_r.
std::string loss_convention(std::string_view key);

/// The keys of a table that make a medium; `path` is the dotted name of the table. Throws InputError.
MediumChoice read_medium(const CaseValue& table, const std::string& path);

/// The name of the library that `name` is but for capitals; empty: none.
std::string medium_meant(std::string_view name);

/// At each frequency; tables are looked for in `folder`. Throws InputError where it is not known; `asked_at` is the place of the
/// frequencies.
std::vector<Medium> media_at(const MediumChoice& choice, const std::filesystem::path& folder, std::span<const double> frequencies,
                             const std::string& asked_at);

/// A medium measured at some frequencies, ascending [Hz].
struct MediumTable {
  std::vector<double> frequencies;
  std::vector<Medium> media;

  /// Linear between the rows; the frequency lies between the first and the last.
  Medium at(double frequency) const;
};

/// From a CSV file with the header freq_ghz,eps_real,eps_loss or freq_ghz,eps_real,eps_loss,mu_real,mu_loss. Throws InputError
/// with the line; if the file cannot be read, the sentence begins with `place`.
MediumTable read_medium_csv(const std::filesystem::path& file, const std::string& place);

}  // namespace raytube
