#include "jobs/solvable.h"

#include <fmt/format.h>

#include "solve/image.h"

namespace raytube {

void refuse_motion(const Case& c) {
  if (c.motion)
    throw InputError(
        fmt::format("{}: [motion] is for raytube run and what is made of its rows; this needs a scene that stands: "
                    "remove the section",
                    c.motion->location));
}

void require_look(const Case& c, std::size_t look, const std::string& place) {
  refuse_motion(c);
  if (const std::size_t looks = c.sweep.looks.size(); look >= looks)
    throw InputError(
        fmt::format("{} {}: there are {} direction pair(s), counted from 0; choose among these", place, look, looks));
}

SolvePlan plan_of_case(const Target& target, const Case& c, int threads, bool keep_parts) {
  refuse_motion(c);
  return naming_the_case(c, [&] {
    SolvePlan plan(target, c.sweep, {c.tubes, c.edges, c.surfaces, threads, keep_parts}, c.ground);
    for (const std::size_t look : c.image_looks) image_cells(plan, look, c.image_per_wavelength);  // refuses what cannot be made
    return plan;
  });
}

Case case_of_look(const Case& c, std::size_t look, std::size_t frequency_index) {
  Case one = c;
  one.sweep.materials = at_frequency(c.sweep.materials, frequency_index);
  if (c.ground && !c.ground->perfect()) one.ground->material = at_frequency({*c.ground->material}, frequency_index).front();
  one.sweep.frequencies = {c.sweep.frequencies[frequency_index]};
  one.sweep.looks = {c.sweep.looks.at(look)};
  one.image_looks.clear();
  return one;
}

}  // namespace raytube
