// The calibration that a table lacks: one factor for all its amplitudes.
#pragma once

#include <string>

#include "output/compare/match_rows.h"

namespace raytube {

/// The factor, and what it was fitted to.
struct FreeScale {
  Complex factor;
  bool phase;  // of a complex factor; without it, where no phases are to be had, it is positive
};

/// The factor of all of the result's amplitudes that brings it nearest to the reference: sum conj(a) b / sum |a|^2 over the
/// common rows and the channels that both tables have, by least squares; of the magnitudes alone where one of these channels has
/// no phase in one of the tables. Throws InputError where that is not a number greater than 0.
FreeScale fit_scale(const ResultTable& result, const ResultTable& reference, const RowMatch& match);

/// A line for the screen: by how much.
std::string scale_text(const FreeScale& scale);

/// Multiplies all amplitudes of a table, and shifts its levels accordingly.
void apply_scale(ResultTable& table, Complex factor);

}  // namespace raytube
