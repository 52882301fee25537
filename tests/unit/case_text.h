// Case files in one line for the tests of the reader.
#pragma once

#include <gmock/gmock.h>

#include "case/read_case.h"
#include "case/resolved_case.h"
#include "core/error.h"
#include "scratch.h"

namespace raytube::testing {

inline const std::string target = "[target]\nmesh = \"m.stl\"\nunit = \"mm\"\n";
inline const std::string frequency = "[frequency]\nghz = 10\n";
inline const std::string look = "[look]\ntheta_deg = 90\nphi_deg = 0\n";
inline const std::string smallest = target + frequency + look;

inline Case read_text(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return read_case(Scratch().write("case.toml", text), overrides);
}

/// The sentence a bad case gives; empty if it was accepted.
inline std::string complaint(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    read_text(text, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace raytube::testing
