// The contract of mechanisms for telling: what every piece of physics that adds to S beside the tubes is called, in which columns
// it stands, and what it says of a plan, a row and its bound. How one is computed is in solve/mechanisms/mechanism.h.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "scene/results.h"

namespace raytube {

struct BandScene;
class Mechanism;
struct RowEvidence;
struct SolvePlan;
enum class Omission;

/// What a mechanism says of itself before any look is computed.
struct MechanismState {
  bool on = false;                 // it takes part
  bool forced = false;             // in every look, not only where it can change the answer
  std::string why_not{};           // in words; empty if it takes part
  bool missed = false;             // it does not take part, and what it would add is missing from S
  std::string what{};              // it works on, if it takes part
  std::string when{};              // in which looks, unless it is forced
  std::vector<Skipped> skipped{};  // what it leaves out, known beforehand
};

/// A mechanism that does not take part for this reason, without anything missing.
inline MechanismState without(std::string why_not) { return {.why_not = std::move(why_not)}; }
/// The same where something is missing.
inline MechanismState misses(std::string why_not) { return {.why_not = std::move(why_not), .missed = true}; }
/// Why a target that cannot light itself has no reflected waves.
inline constexpr const char* nothing_in_front = "nothing stands in front of any face of the target";

/// Of |S_pq| in one row, for unit incident fields [m]: docs/theory/bounds.md.
struct AmplitudeLimits {
  double surface = 0.0;  // as much current as a plane bears on the whole surface
  double edges = 0.0;    // twice the incident field over half a wavelength on either side of every edge
  int edge_order = 1;    // edges in a row that a current passes
};

/// A column of parts.csv.
struct MechanismColumn {
  const char* name;                         // in files, behind the channel
  const char* label;                        // in sentences, with the key that switches it off
  double (*bound)(const AmplitudeLimits&);  // no row may exceed it [m]
};

/// What a solve has shown of a mechanism and of what is missing, once it is done.
struct MechanismShown {
  const std::vector<Count>& counts;  // of what it did and left out
  std::uint64_t looks_without = 0;   // computed looks that it was too weak for, or its budget too small
  double left_out = 0.0;             // share of the squares of what it is there for that it left out for its budget's sake
  double curved_edges = 0.0;         // share, by length, of the edges with currents missing or weak that are beside curved faces
};

/// How to reduce an omission (uncertainty/omissions.h) that a mechanism is meant to fill: a key of the case and about how much
/// longer the run will take, or "none ...". The key that switched off what is missing comes first; others are named only where
/// they make it less by a noticeable share, for at most ten times the time.
struct MechanismRemedy {
  Omission omission;                                           // that it makes less
  std::string (*of)(const SolvePlan&, const MechanismShown&);  // the remedy in words
};

/// A mechanism by name, and what it says.
struct MechanismEntry {
  const char* name;                                      // of its pieces: images, centres, run.json
  const char* label;                                     // in sentences
  const char* key;                                       // of the case, by which it is asked for
  const char* budget_key;                                // of the case, which limits its work; null: none does
  const char* follows = nullptr;                         // an earlier one, by name, in whose rows it runs; null: in its own
  std::vector<MechanismColumn> columns;                  // of its S
  std::vector<const char*> counts;                       // names of what it counts, in run.json
  MechanismState (*state)(const SolvePlan&);             // whether it takes part
  std::unique_ptr<Mechanism> (*make)(const BandScene&);  // at the frequencies of a band; null if it is not there
  double (*bytes)(const SolvePlan&) = nullptr;           // that it holds for all looks, if it takes part
  double (*look_bytes)(const SolvePlan&) = nullptr;      // for each look under way
  double (*budget)(const SolvePlan&) = nullptr;          // work it may take in a look, in units of all other work; null: no limit
  /// Tells the estimate of what is missing in a row what the mechanism has added there; null: nothing that it asks for.
  void (*tell)(const SolvePlan&, const Contribution&, std::size_t frequency, RowEvidence&) = nullptr;
  std::vector<MechanismRemedy> remedies{};  // of the omissions that it is there for
};

/// All mechanisms, in the order in which they run and are told of (solve/mechanisms/list.cpp). A new one is a room of its own and
/// one entry there.
const std::vector<MechanismEntry>& mechanism_list();

/// What pieces of a look may belong to, by ScatteringPiece::mechanism.
std::vector<std::string> piece_names(const std::vector<MechanismEntry>& mechanisms);

}  // namespace raytube
