// Radar cross-section of a mesh from a program of one's own: broadside of the plate case.
#include <solve/solve.h>

#include <cstdio>

int main(int, char** argv) {
  const raytube::Target target(raytube::load_mesh(argv[1], 1.0).mesh);  // metres
  const raytube::Direction broadside{0.0, 0.0};
  const raytube::Sweep sweep{{3e9}, {{broadside, broadside}}};
  const raytube::SweepResult result = raytube::solve(target, sweep);
  std::printf("|S_vv| = %.6f m\n", std::abs(result.total[0].vv()));
}
