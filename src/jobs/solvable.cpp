#include "jobs/solvable.h"

#include "jobs/over_ground.h"
#include "solve/image.h"

namespace raytube {

SolvePlan plan_of_case(const Target& target, const Case& c, int threads, bool keep_parts) {
  return naming_the_case(c, [&] {
    SolvePlan plan = planned(target, c, {c.tubes, c.edges, c.surfaces, threads, keep_parts});
    for (const std::size_t look : c.image_looks) image_cells(plan, look, c.image_per_wavelength);  // refuses what cannot be made
    return plan;
  });
}

}  // namespace raytube
