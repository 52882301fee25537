// The same bytes for any number of threads, from the library and from the program.
#include "core/threads.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstring>

#include "run.h"
#include "scratch.h"
#include "shapes.h"
#include "solve/image.h"

namespace raytube {
namespace {

using namespace raytube::testing;

const int thread_counts[] = {1, 2, 3, 7};

bool same_bytes(const std::vector<ScatteringMatrix>& a, const std::vector<ScatteringMatrix>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

void expect_same_bits_for_any_threads(TubeMode mode) {
  Sweep sweep{{9e9, 10e9}, {}, true};
  for (int i = 0; i < 9; ++i) sweep.looks.push_back({{0.3 + 0.2 * i, 0.7 * i}, {0.5 + 0.2 * i, 0.7 * i}});
  for (const PolygonSoup& soup : {shapes::icosphere(3, 0.2), shapes::trihedral(0.5), shapes::cube(0.3)}) {
    SolveOptions o = options(EdgeMethod::fringe);
    o.tubes.mode = mode;
    o.threads = 1;
    const SweepResult one = solve_soup(soup, sweep, o);
    for (const int threads : thread_counts) {
      o.threads = threads;
      const SweepResult many = solve_soup(soup, sweep, o);
      EXPECT_TRUE(same_bytes(one.total, many.total)) << threads << " threads";
      EXPECT_EQ(one.statistics.rays, many.statistics.rays);
    }
  }
}

TEST(Threads, UniformTubesGiveTheSameBits) { expect_same_bits_for_any_threads(TubeMode::uniform); }
TEST(Threads, AdaptiveTubesGiveTheSameBits) { expect_same_bits_for_any_threads(TubeMode::adaptive); }

TEST(Threads, ImagesHaveTheSameBits) {
  const Sweep sweep{{9e9}, {{{1.0, 0.6}, {1.0, 0.6}}}, false};
  for (const TubeMode mode : {TubeMode::uniform, TubeMode::adaptive})
    for (const PolygonSoup& soup : {shapes::icosphere(3, 0.2), shapes::trihedral(0.3), shapes::dihedral(0.1, 0.12)}) {
      const LoadedMesh loaded = build_mesh(soup, 1.0);
      SolveOptions o = options(EdgeMethod::fringe);
      o.tubes.mode = mode;
      o.threads = 1;
      const Target target(loaded.mesh);
      const LookImage one = image_of_look(target, sweep, o, 0, 10.0);
      for (const int threads : thread_counts) {
        o.threads = threads;
        const LookImage many = image_of_look(target, sweep, o, 0, 10.0);
        EXPECT_TRUE(same_bytes(one.cells, many.cells)) << threads << " threads";
        EXPECT_TRUE(same_bytes(one.triangles, many.triangles)) << threads << " threads";
      }
    }
}

TEST(Threads, RaysInThePlaceOfCurrentsGiveTheSameBits) {
  Sweep sweep{{9e9, 10e9}, {}, true};
  for (int i = 0; i < 9; ++i) sweep.looks.push_back({{0.3 + 0.2 * i, 0.7 * i}, {0.5 + 0.2 * i, 0.7 * i}});
  SolveOptions o = options(EdgeMethod::utd);
  o.threads = 1;
  const SweepResult one = solve_soup(shapes::trihedral(0.5), sweep, o);
  EXPECT_GT(largest_amplitude(one.total[0]), 0.0);
  for (const int threads : thread_counts) {
    o.threads = threads;
    EXPECT_TRUE(same_bytes(one.total, solve_soup(shapes::trihedral(0.5), sweep, o).total)) << threads << " threads";
  }
}

TEST(Threads, DiffractionBetweenSurfacesGivesTheSameBits) {
  Sweep sweep{{9e9, 10e9}, {}, true};
  for (int i = 0; i < 9; ++i) sweep.looks.push_back({{0.3 + 0.2 * i, 0.17 * i}, {0.5 + 0.2 * i, 0.1 + 0.15 * i}});
  SolveOptions o = options(EdgeMethod::fringe);
  o.tubes.mode = TubeMode::adaptive;
  o.threads = 1;
  const SweepResult one = solve_soup(shapes::dihedral(0.1, 0.12), sweep, o);
  EXPECT_GT(one.statistics.counted("edge_illumination_pieces"), 0u);
  for (const int threads : thread_counts) {
    o.threads = threads;
    const SweepResult many = solve_soup(shapes::dihedral(0.1, 0.12), sweep, o);
    EXPECT_TRUE(same_bytes(one.total, many.total)) << threads << " threads";
    EXPECT_TRUE(same_bytes(one.of("interaction"), many.of("interaction"))) << threads << " threads";
    EXPECT_EQ(one.error, many.error) << threads << " threads";
    EXPECT_EQ(one.model, many.model) << threads << " threads";
    ASSERT_EQ(one.model_parts.size(), many.model_parts.size());
    for (std::size_t i = 0; i < one.model_parts.size(); ++i) EXPECT_EQ(one.model_parts[i].rms, many.model_parts[i].rms);
  }
}

// rcs.csv of a case of the repository, thinned so that it runs in a second or two.
std::string program_output(const std::string& case_name, const std::string& set, int threads) {
  const Scratch scratch;
  const std::string command = std::string(RAYTUBE_PROGRAM) + " run " RAYTUBE_SOURCE_DIR "/cases/" + case_name + "/case.toml -o " +
                              scratch.folder().string() + " --quiet --set output.plots=false " + set + " --threads " +
                              std::to_string(threads);
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 0) << command;
  return text_of(scratch / "rcs.csv");
}

TEST(Threads, ProgramWritesTheSameBytes) {
  const std::pair<std::string, std::string> cases[] = {
      {"powercube", "--set look.phi_deg='{start=-10,stop=10,step=5}'"},
      {"trihedral", "--set look.phi_deg='{start=0,stop=90,step=15}'"},
      {"cylinder", "--set look.theta_deg='{start=0,stop=180,step=20}'"},
  };
  for (const auto& [name, set] : cases) {
    const std::string one = program_output(name, set, 1);
    EXPECT_GT(one.size(), 500u);
    for (const int threads : thread_counts)
      EXPECT_EQ(program_output(name, set, threads), one) << name << ", " << threads << " threads";
  }
}

}  // namespace
}  // namespace raytube
