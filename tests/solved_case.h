// Cases as their files have them, solved as the program does.
#pragma once

#include "case/read_case.h"
#include "case/target.h"
#include "jobs/solve_case.h"
#include "run.h"
#include "scratch.h"

namespace raytube::testing {

struct Solved {
  Case c;
  SweepResult result;
  std::vector<std::string> warnings;
};

inline Solved solved(const std::string& mesh, const std::string& text, int threads = 0, const KeptLooks& kept = {}) {
  const Scratch scratch;
  scratch.write("m.obj", mesh);
  Solved s{read_case(scratch.write("case.toml", text), {}), {}, {}};
  const auto [moving, loaded] = load_target_of_plan(s.c);
  const Target target(loaded.mesh, s.c.wedges);
  const PlannedCase planned(s.c, target, loaded.report, target.mesh.vertices, threads, true, moving);
  Manifest manifest;
  s.result = solve_case(planned, manifest, {}, kept, nullptr);
  s.warnings = std::move(manifest.warnings);
  return s;
}

}  // namespace raytube::testing
