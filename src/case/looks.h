// The directions a case asks for.
#pragma once

#include "case/case.h"
#include "case/document.h"

namespace raytube {

/// Fills c.looks, c.sweep.looks and c.sweep.bistatic from [look] and [receive]; frequencies must be known already.
/// Throws InputError.
void read_looks(const CaseValue& root, Case& c);

/// A table of more is refused: looks times frequencies.
inline constexpr double most_rows = 1e7;

/// Throws InputError at the place of `value`, which asks for so many looks, if they make more rows.
void check_rows(const CaseValue& value, double looks, std::size_t frequencies);

/// Looks of a CSV file with the header theta_deg,phi_deg or theta_deg,phi_deg,rx_theta_deg,rx_phi_deg; '#' starts a comment
/// line. Sets `bistatic` when receive angles are given. Throws InputError with the line.
std::vector<Look> read_looks_csv(const std::filesystem::path& file, bool& bistatic);

}  // namespace raytube
