// What the stress suite measures, kept for the table of docs/theory/stability.md. Every test states a change that physics says
// must not matter, measures the worst relative change of S, and judges it here.
//
//   build/stress_tests                                              the quick suite, as ctest runs it
//   build-stress/stress_tests                                       the full one (preset stress)
//   RAYTUBE_STABILITY_TABLE=docs/theory/stability.md build-stress/stress_tests     the same, and the table in that file is
//   replaced;
//                                                                         refused with --gtest_filter
#pragma once

#include <cmath>
#include <string>

namespace raytube::testing {

/// One row of the table.
struct Stability {
  std::string change;   // what was done to the description: "turned, 20 random rotations"
  std::string targets;  // what to: "plate, cube, trihedral; uniform and adaptive"
  double worst;         // largest relative change found: |S' - S| / largest |S| of the cut, unless `change` says otherwise
  double allowed;       // tolerance
  std::string reason;   // where the tolerance comes from
};

/// Fails the test if the worst is above the allowed or no number; keeps the row for the table.
void expect_stable(const Stability& measured);

/// The larger of two, and no number if one of them is none.
inline double worse(double a, double b) { return std::isnan(a) || b <= a ? a : b; }

/// `full` in the full suite (preset stress), else `quick`: numbers of cases, rays, looks.
template <typename Number>
Number size_of_run(Number quick, Number full) {
#ifdef RAYTUBE_STRESS_FULL
  return static_cast<void>(quick), full;
#else
  return static_cast<void>(full), quick;
#endif
}

}  // namespace raytube::testing
