// Whether the machine has the memory a run will take.
#pragma once

#include <string>

#include "case/data/case.h"
#include "plan/plan.h"

namespace raytube {

/// Bytes that a run of a case is going to take at most, with what the program holds now.
struct MemoryOfRun {
  double leader;  // of the process that has the rows: the only one, if there are no others
  double helper;  // of one that computes looks for it
};
MemoryOfRun memory_of_run(const SolvePlan& plan, const Case& c);

/// Bytes the program may have in all: what it holds now and what is free, for it (control group, ulimit -v) and on the machine.
double memory_to_be_had();

/// "1.5 GB"
std::string memory_text(double bytes);

/// Throws InputError with the estimate and what would fit if there is not so much memory; `kept` bytes beside what a run takes
/// grow with its rows.
void check_memory(const SolvePlan& plan, const Case& c, double kept = 0.0);

/// Throws InputError for any other work of so many bytes if they are not to be had: "PLACE: WHAT would take ...; REMEDY".
void require_memory(double bytes, const std::string& place, const std::string& what, const std::string& remedy);

}  // namespace raytube
