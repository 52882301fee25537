// All mechanisms beside the tubes. A new one is a room of its own and one line here.
#pragma once

#include <memory>
#include <span>

#include "scene/mechanisms.h"
#include "solve/mechanisms/band_scene.h"
#include "solve/mechanisms/mechanism.h"
#include "solve/mechanisms/state.h"

namespace raytube {

/// A mechanism by name, and what it says of a plan.
struct MechanismEntry {
  MechanismId id;
  ScatteringMechanism scatters;                          // what its pieces are
  const char* label;                                     // in sentences
  const char* key;                                       // of the case, by which it is asked for
  MechanismState (*state)(const SolvePlan&);             // whether it takes part
  std::unique_ptr<Mechanism> (*make)(const BandScene&);  // at the frequencies of a band; null if not there
  double (*bytes)(const SolvePlan&) = nullptr;           // that it holds for all looks, if it takes part
  double (*look_bytes)(const SolvePlan&) = nullptr;      // for each look under way
};

/// In the order in which they run.
std::span<const MechanismEntry> mechanism_list();

const MechanismEntry& entry_of(MechanismId id);

}  // namespace raytube
