#include "program/solvable.h"

#include "program/images.h"

namespace raytube {

SolvePlan plan_of_case(const Target& target, const Case& c, int threads, bool keep_parts) {
  return naming_the_case(c, [&] {
    SolvePlan plan(target, c.sweep, {c.tubes, c.edges, c.surfaces, threads, keep_parts});
    check_images(plan, c);
    return plan;
  });
}

}  // namespace raytube
