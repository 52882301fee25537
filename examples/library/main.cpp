// Radar cross-section of a mesh from a program of one's own: broadside of the plate case.
#include <solve/solve.h>

#include <cstdio>

namespace {

void print_broadside(const char* mesh_file) {
  const raytube::Target target(raytube::load_mesh(mesh_file, 1.0).mesh);  // metres
  const raytube::Direction broadside{0.0, 0.0};
  const raytube::Sweep sweep{{3e9}, {{broadside, broadside}}};
  const raytube::SweepResult result = raytube::solve(target, sweep);
  std::printf("|S_vv| = %.6f m\n", std::abs(result.total[0].vv()));
}

}  // namespace

int main(int count, char** arguments) {
  try {
    if (count != 2) throw raytube::InputError("give one mesh file, for example plate.off");
    print_broadside(arguments[1]);
  } catch (const raytube::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
