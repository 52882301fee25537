// Leaks of a long walk inside a closed cube and a closed sphere.
//   watertight [RAYS]      default 10^8 in all
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <cstdlib>

#include "../tests/shapes.h"
#include "../tests/walk.h"

int main(int argc, char** argv) {
  using namespace raytube;
  const std::uint64_t rays = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 100'000'000;
  constexpr std::uint64_t walks = 100;
  const LoadedMesh targets[] = {build_mesh(shapes::cube(1.0), 1.0), build_mesh(shapes::icosphere(5), 1.0)};
  for (const LoadedMesh& target : targets) {
    std::atomic<std::uint64_t> lost = 0;
    tbb::parallel_for(std::uint64_t{0}, walks,
                      [&](std::uint64_t walk) { lost += testing::lost_inside(target.mesh, rays / 2 / walks, walk); });
    fmt::print("closed mesh of {} triangles: {} rays, {} lost\n", target.mesh.triangles.size(), rays / 2, lost.load());
  }
}
