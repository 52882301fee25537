// raytube trace: one tube, bounce by bounce.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/read_case.h"
#include "case/target.h"
#include "core/decimal.h"
#include "core/error.h"
#include "program/commands.h"
#include "program/solvable.h"
#include "sbr/replay.h"
#include "solve/admissible.h"

namespace raytube {

namespace {

std::string vector_text(const dvec3& v) {
  return fmt::format("({: .9g}, {: .9g}, {: .9g})", v.x + 0.0, v.y + 0.0, v.z + 0.0);  // + 0.0: no "-0"
}

std::string direction_text(const Direction& d) {
  return fmt::format("theta {} deg, phi {} deg", number_text(decimal_degrees(d.theta)), number_text(decimal_degrees(d.phi)));
}

// Real where it is real, else with its imaginary part behind it.
std::string field_text(const ComplexVector& e) {
  const std::string real = vector_text(e.re);
  return e.im == dvec3(0.0) ? real : fmt::format("{} + j {}", real, vector_text(e.im));
}

double incidence_deg(const dvec3& direction_in, const dvec3& normal) {
  return std::acos(std::clamp(std::abs(glm::dot(direction_in, normal)), 0.0, 1.0)) / degree;
}

void print_bounce(std::size_t number, const TubeBounce& bounce, const dvec3& direction_in, const dvec3& mesh_center) {
  fmt::print("bounce {}: triangle {}, patch {}\n", number, bounce.triangle, bounce.patch);
  fmt::print("  point          {} m\n", vector_text(bounce.point + mesh_center));
  fmt::print("  normal         {}\n", vector_text(bounce.normal));
  fmt::print("  incidence      {:.6g} deg\n", incidence_deg(direction_in, bounce.normal));
  fmt::print("  leaves along   {}\n", vector_text(bounce.direction_out));
  fmt::print("  path           {:.12g} m\n", bounce.path);
  fmt::print("  field of V     {}\n", field_text(bounce.field[0]));
  fmt::print("  field of H     {}\n", field_text(bounce.field[1]));
  if (bounce.goes_on) fmt::print("  goes on        behind the surface, too; followed here is what it reflects\n");
}

const Look& chosen_look(const Case& c, std::size_t index) {
  if (index >= c.sweep.looks.size())
    throw InputError(fmt::format("--look {}: {} has {} direction pair(s), counted from 0; choose among these", index,
                                 c.file.string(), c.sweep.looks.size()));
  return c.sweep.looks[index];
}

}  // namespace

void trace_command(const Request& request) {
  const Case c = read_case(request.case_file, request.overrides);
  const Look& look = chosen_look(c, request.look);
  if (!std::isfinite(request.u) || !std::isfinite(request.v)) throw InputError("--u and --v must be finite numbers of metres");
  const LoadedMesh loaded = load_target(c);
  naming_the_case(c, [&] { check_antennas(loaded.mesh, c.sweep); });
  const Tracer tracer(loaded.mesh);
  // The grid of a sweep is laid at its highest frequency.
  const auto highest = std::ranges::max_element(c.sweep.frequencies);
  const std::vector<Material> materials =
      at_frequency(c.sweep.materials, static_cast<std::size_t>(highest - c.sweep.frequencies.begin()));
  const ReplayScene scene{tracer, materials, c.sweep.radar};
  const TubeTrace trace = naming_the_case(c, [&] { return trace_tube(scene, look, *highest, c.tubes, {request.u, request.v}); });

  fmt::print("look {}: {} to the transmitter, {} to the receiver\n", request.look, direction_text(look.transmit),
             direction_text(look.receive));
  if (!materials.empty()) fmt::print("fields at {} GHz, the highest frequency of the case\n", number_text(*highest / 1e9));
  fmt::print("tube: column {}, row {}, centre u {:.9g} m, v {:.9g} m\n", trace.column, trace.row, trace.center.x, trace.center.y);
  dvec3 direction = trace.direction;
  for (std::size_t i = 0; i < trace.bounces.size(); ++i) {
    print_bounce(i + 1, trace.bounces[i], direction, loaded.mesh.center);
    direction = trace.bounces[i].direction_out;
  }
  fmt::print("end: {}\n", trace.end);
}

}  // namespace raytube
