// What a surface is made of: the keys of a medium, and its permittivity and permeability at each frequency.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "case/data/case.h"
#include "case/text/document.h"

namespace raytube {

/// Reads the keys of a table that make a medium; `path` is the dotted name of the table. Throws InputError.
MediumChoice read_medium(const CaseValue& table, const std::string& path);

/// The name in the library that `name` is but for capitals; empty: none.
std::string medium_meant(std::string_view name);

/// The medium at each frequency [Hz]; tables are looked for in `folder`. Throws InputError where it is not known; `asked_at` is
/// the location of the frequencies.
std::vector<Medium> media_at(const MediumChoice& choice, const std::filesystem::path& folder, std::span<const double> frequencies,
                             const std::string& asked_at);

}  // namespace raytube
