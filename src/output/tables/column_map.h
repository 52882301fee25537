// How the columns of another program's table are named, in this project's words.
#pragma once

#include <string>
#include <vector>

namespace raytube {

/// A column by this project's name: factor * the cell of `theirs` + offset.
struct ColumnChoice {
  std::string ours, theirs;  // in small letters
  double factor = 1.0, offset = 0.0;
  bool if_there = false;  // of a preset: it counts where the table has the column
};
using ColumnMap = std::vector<ColumnChoice>;

/// Reads "freq_hz=f*1e9,theta_deg=elevation*-1+90,...": ours=theirs, then *factor and +offset where needed. Theirs may stand in
/// double quotes: "RCS [dBsm]". The name of a preset, hfss, feko, matlab or azel, stands for the columns of those programs, and
/// may stand beside others, which go before it (docs/reference/compare.md). `option` is what messages call it. Throws InputError
/// for anything else and for names of ours that no table has.
ColumnMap parsed_column_map(const std::string& option, const std::string& text);

}  // namespace raytube
