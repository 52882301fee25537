// Whether a mechanism takes part in a plan.
#pragma once

#include <string>
#include <vector>

#include "scene/results.h"

namespace raytube {

/// What a mechanism says of itself before any look is computed.
struct MechanismState {
  bool on = false;                 // it takes part
  bool forced = false;             // in every look, not only where it can change the answer
  std::string why_not{};           // in words; empty if it does
  bool missed = false;             // it does not, and what it would add is missing from S
  std::string what{};              // it works on, if it takes part
  std::string when{};              // in which looks, unless it is forced
  std::vector<Skipped> skipped{};  // what it leaves out, known beforehand
};

/// A mechanism that does not take part for this reason, without anything missing.
inline MechanismState without(std::string why_not) { return {.why_not = std::move(why_not)}; }
/// The same where something is missing.
inline MechanismState misses(std::string why_not) { return {.why_not = std::move(why_not), .missed = true}; }

}  // namespace raytube
