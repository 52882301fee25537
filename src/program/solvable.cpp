#include "program/solvable.h"

#include "program/images.h"
#include "solve/parts.h"

namespace raytube {

namespace {

void check_all(const Target& target, const Case& c) {
  check(c.sweep, {c.tubes, c.edges, 0, false, {}});
  check_antennas(target.mesh, c.sweep);
  check_density(target.mesh, c.sweep, c.tubes, c.edges.method);
  ray_range(target, c.sweep, c.edges);
  check_images(target, c);
}

}  // namespace

void check_solvable(const Target& target, const Case& c) {
  naming_the_case(c, [&] { check_all(target, c); });
}

}  // namespace raytube
