// What is skipped changes no answer, and is counted.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>

#include "run.h"
#include "scratch.h"
#include "shapes.h"

namespace raytube {
namespace {

using namespace raytube::testing;

constexpr double frequency = 3e9;

struct Both {
  SweepResult with, without;
};

Both solve_both(const PolygonSoup& soup, const Sweep& sweep, SolveOptions o) {
  SweepResult with = solve_soup(soup, sweep, o);
  o.tubes.skip = false;
  return {std::move(with), solve_soup(soup, sweep, o)};
}

SolveOptions tubes(TubeMode mode, EdgeMethod edges) {
  SolveOptions o = options(edges);
  o.tubes.mode = mode;
  return o;
}
SolveOptions adaptive(EdgeMethod edges = EdgeMethod::fringe) { return tubes(TubeMode::adaptive, edges); }
SolveOptions uniform(EdgeMethod edges = EdgeMethod::fringe) { return tubes(TubeMode::uniform, edges); }

std::uint64_t count(const SweepResult& result, const std::string& what, const std::string& why) {
  std::uint64_t found = 0;
  for (const Skipped& s : result.statistics.skipped)
    if (s.what == what && s.why.find(why) != std::string::npos) found += s.count;
  return found;
}

bool same_bytes(const std::vector<ScatteringMatrix>& a, const std::vector<ScatteringMatrix>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

// Largest difference of any row and channel, relative to the largest amplitude of the sweep.
double difference(const std::vector<ScatteringMatrix>& a, const std::vector<ScatteringMatrix>& b) {
  double worst = 0.0, peak = 0.0;
  for (std::size_t row = 0; row < a.size(); ++row)
    for (const int channel : {0, 1, 2, 3}) {
      const Complex x = a[row].at(channel / 2, channel % 2), y = b[row].at(channel / 2, channel % 2);
      worst = std::max(worst, std::abs(x - y));
      peak = std::max(peak, std::abs(y));
    }
  return peak > 0.0 ? worst / peak : worst;
}

std::vector<Direction> around(int count) {
  std::vector<Direction> looks;
  for (int i = 0; i < count; ++i) looks.push_back({(20.0 + 150.0 * i / count) * degree, (11.0 + 47.4 * i) * degree});
  return looks;
}

// Nothing can be in front of a face of a convex body, or of a plate: neither reflected light nor a shadow is looked for.
TEST(Skip, ReflectedTubesOfConvexTargets) {
  for (const auto& [name, soup] : {std::pair{"cube", shapes::cube(0.6)},
                                   {"cylinder", shapes::cylinder(0.2, 0.6, 40)},
                                   {"sphere", shapes::icosphere(3, 0.3)},
                                   {"plate", shapes::plate(0.7, 0.3)}})
    for (SolveOptions o : {uniform(EdgeMethod::none), adaptive(EdgeMethod::none)}) {
      o.tubes.curved = CurvedSurfaces::never;
      const auto [with, without] = solve_both(soup, monostatic(around(7), frequency), o);
      EXPECT_TRUE(same_bytes(with.total, without.total)) << name;
      EXPECT_EQ(count(with, "reflected tubes", "in front"), with.statistics.hits[0]) << name;
      EXPECT_EQ(count(without, "reflected tubes", "in front"), 0u) << name;
      EXPECT_EQ(without.statistics.hits.size(), 1u) << name;
      // Each tube was followed by one more ray, which met nothing.
      EXPECT_EQ(with.statistics.rays + count(with, "tubes", "empty") + with.statistics.hits[0], without.statistics.rays) << name;
    }
}

TEST(Skip, ReflectedTubesOfCurvedConvexTargets) {
  for (const PolygonSoup& soup : {shapes::icosphere(3, 0.3), shapes::cylinder(0.2, 0.6, 40)}) {
    const auto [with, without] = solve_both(soup, monostatic(around(7), frequency), adaptive(EdgeMethod::none));
    EXPECT_TRUE(same_bytes(with.total, without.total));
    EXPECT_EQ(count(with, "reflected tubes", "in front"), with.statistics.hits[0]);
    EXPECT_LT(with.statistics.rays, without.statistics.rays);
  }
}

TEST(Skip, EmptyCellsOfTheGrid) {
  for (const auto& [name, soup] : {std::pair{"trihedral", shapes::trihedral(0.9)},
                                   {"turned plate", shapes::plate(0.7, 0.5)},
                                   {"dihedral", shapes::dihedral(0.7, 0.5)}}) {
    const auto [with, without] = solve_both(soup, monostatic(around(9), frequency), uniform(EdgeMethod::none));
    EXPECT_TRUE(same_bytes(with.total, without.total)) << name;
    EXPECT_EQ(with.statistics.hits, without.statistics.hits) << name;
    EXPECT_EQ(with.statistics.tubes, without.statistics.tubes) << name;
    EXPECT_GT(count(with, "tubes", "empty"), with.statistics.tubes / 20) << name;
  }
}

TEST(Skip, RepeatedLooks) {
  std::vector<Direction> looks = around(5);
  for (int i = 0; i < 5; ++i) looks.push_back({looks[i].theta, looks[i].phi + (i % 2 ? 2.0 * pi : 0.0)});
  for (const SolveOptions& o : {uniform(), adaptive()}) {
    const auto [with, without] = solve_both(shapes::dihedral(0.7, 0.5), monostatic(looks, frequency), o);
    EXPECT_LE(difference(with.total, without.total), 1e-12);  // a turn more rounds phases of 50 rad
    EXPECT_EQ(count(with, "looks", "same"), 5u);
    EXPECT_EQ(2 * with.statistics.hits[0], without.statistics.hits[0]);
    EXPECT_EQ(with.statistics.counted("wedges_lit"), without.statistics.counted("wedges_lit"));
  }
}

// A corner between two sheets, open towards +y; its own image across x and z, its middle far from the origin.
PolygonSoup roof(double w, double h) {
  PolygonSoup soup = {{{0, 0, -h}, {w, w / 2, -h}, {w, w / 2, h}, {0, 0, h}, {-w, w / 2, -h}, {-w, w / 2, h}},
                      {{0, 1, 2, 3}, {0, 4, 5, 3}}};
  return shapes::transformed(soup, glm::dmat3(1.0), 1.0, {0.25, -0.5, 1.75});
}

constexpr double phases_of_some_100_rad = 1e-12;  // rounded, of the peak
// Where a closed shadow boundary is farthest from its middle is the vertex of a flat parabola, known to ten times that.
constexpr double beginning_of_strips = 1e-11;

// Gives the number of looks that followed from others.
std::uint64_t expect_same_with_mirrors(const PolygonSoup& soup, const Sweep& sweep, const char* name,
                                       double tolerance = phases_of_some_100_rad) {
  const auto [with, without] = solve_both(soup, sweep, adaptive());
  const double error = difference(with.total, without.total);
  measured(fmt::format("skip, mirrored looks, {}, largest |difference| / peak", name).c_str(), error, "");
  EXPECT_LE(error, tolerance) << name;
  EXPECT_LE(difference(with.of("edges_order_1"), without.of("edges_order_1")), 1e-12) << name;
  EXPECT_LE(difference(with.of("edges_order_2_on"), without.of("edges_order_2_on")), 1e-12) << name;
  EXPECT_EQ(with.statistics.counted("wedges_lit"), without.statistics.counted("wedges_lit")) << name;
  return count(with, "looks", "mirror");
}

TEST(Skip, MirrorImages) {
  Sweep azimuth{{frequency}, {}, false};  // crosses the mirror, passes the looks along it
  for (int i = -18; i <= 18; ++i)
    azimuth.looks.push_back({{70.0 * degree, (90.0 + 5.0 * i) * degree}, {70.0 * degree, (90.0 + 5.0 * i) * degree}});
  EXPECT_EQ(expect_same_with_mirrors(roof(0.5, 0.3), azimuth, "roof, azimuth"), 18u);

  Sweep elevation{{frequency}, {}, false};  // from pole to pole
  for (int i = 0; i <= 36; ++i) elevation.looks.push_back({{5.0 * i * degree, 0.3}, {5.0 * i * degree, 0.3}});
  EXPECT_EQ(expect_same_with_mirrors(roof(0.5, 0.3), elevation, "roof, elevation"), 18u);

  Sweep everywhere{{frequency, 1.1 * frequency}, {}, true};  // bistatic, and all eight images of each pair
  for (int i = 0; i < 5; ++i)
    for (const double theta_sign : {1.0, -1.0})
      for (const double x : {1.0, -1.0})
        for (const double y : {1.0, -1.0}) {
          const auto image = [&](double theta, double phi) {
            return Direction{pi / 2 + theta_sign * theta, x > 0.0 ? y * phi : pi - y * phi};
          };
          everywhere.looks.push_back({image(0.2 + 0.2 * i, 0.1 + 0.13 * i), image(-0.3 + 0.1 * i, 0.5 + 0.4 * i)});
        }
  EXPECT_EQ(expect_same_with_mirrors(shapes::box({0.6, 0.4, 0.3}), everywhere, "box, bistatic"), 35u);
  EXPECT_EQ(expect_same_with_mirrors(shapes::cylinder(0.2, 0.5, 20), everywhere, "cylinder, bistatic"), 35u);
  EXPECT_EQ(expect_same_with_mirrors(roof(0.5, 0.3), everywhere, "roof, bistatic"), 30u);
  // Curved surfaces follow their facets, whose diagonals are no images in a cylinder.
  EXPECT_EQ(expect_same_with_mirrors(shapes::icosphere(3, 0.3), everywhere, "sphere, bistatic", beginning_of_strips), 35u);
  EXPECT_EQ(expect_same_with_mirrors(shapes::cylinder(0.2, 0.5, 40), everywhere, "cylinder of 40 sides, bistatic"), 0u);
  // Creases of just 15 degrees: rounding decides which are edges.
  EXPECT_EQ(expect_same_with_mirrors(shapes::cylinder(0.2, 0.5, 24), everywhere, "cylinder of 24 sides, bistatic"), 0u);
}

// Cross-polarised returns are what changes sign; without them the test above would be blind to it.
TEST(Skip, MirroredCrossPolarisationChangesSign) {
  Sweep sweep = monostatic({{70.0 * degree, 65.0 * degree}, {70.0 * degree, 115.0 * degree}}, frequency);
  const SweepResult result = solve_soup(roof(0.5, 0.3), sweep, adaptive());
  EXPECT_GT(std::abs(result.total[0].vh()), 1e-3 * std::abs(result.total[0].vv()));
  EXPECT_EQ(count(result, "looks", "mirror"), 1u);
}

// The uniform grid is not its own image, so it is asked about every look.
TEST(Skip, UniformGridsAreNotMirrored) {
  const Sweep sweep = monostatic({{70.0 * degree, 65.0 * degree}, {70.0 * degree, 115.0 * degree}}, frequency);
  EXPECT_EQ(count(solve_soup(roof(0.5, 0.3), sweep, uniform(EdgeMethod::none)), "looks", "mirror"), 0u);
}

TEST(Skip, FacesTurnedAway) {
  const SweepResult result = solve_soup(shapes::cube(0.6), monostatic({{0.3, 0.2}, {0.0, 0.0}}, frequency), adaptive());
  EXPECT_EQ(count(result, "faces in a look", "away"), 3u + 5u);  // edge-on counts as away
}

TEST(Skip, EdgePassWithoutEdges) {
  const auto [with, without] = solve_both(shapes::icosphere(3, 0.3), monostatic(around(4), frequency), adaptive());
  EXPECT_TRUE(same_bytes(with.total, without.total));
  EXPECT_EQ(count(with, "looks without edge currents", "no edge of the target"), 4u);
  EXPECT_EQ(count(without, "looks without edge currents", "no edge of the target"), 4u);
}

// A small cube behind a sphere.
TEST(Skip, LooksWithoutLitEdges) {
  const PolygonSoup cube = shapes::transformed(shapes::cube(0.1), glm::dmat3(1.0), 1.0, {0.5, 0.0, 0.0});
  const Sweep sweep = monostatic({{90.0 * degree, 180.0 * degree}, {88.0 * degree, 179.0 * degree}, {0.5, 0.0}}, frequency);
  const SweepResult result = solve_soup(shapes::joined(shapes::icosphere(3, 0.3), cube), sweep, uniform());
  EXPECT_EQ(count(result, "looks without edge currents", "no edge is lit"), 2u);
}

TEST(Skip, EdgesInsideABody) {
  const Sweep sweep = monostatic(around(4), frequency);
  for (const SolveOptions& o : {uniform(), adaptive()}) {
    const auto [with, without] = solve_both(shapes::joined(shapes::cube(0.6), shapes::cube(0.2)), sweep, o);
    EXPECT_TRUE(same_bytes(with.total, without.total));
    EXPECT_EQ(count(with, "wedges", "inside"), 12u);
    EXPECT_EQ(with.statistics.counted("wedges_lit"), without.statistics.counted("wedges_lit"));
    const SweepResult nothing_left = solve_soup(shapes::joined(shapes::icosphere(3, 0.3), shapes::cube(0.1)), sweep, o);
    EXPECT_EQ(count(nothing_left, "looks without edge currents", "no edge of the target"), 4u);
  }
}

// What the program says beforehand is what it then counts.
TEST(Skip, CheckAnnouncesWhatRunCounts) {
  const Scratch scratch;
  const std::string words = " " RAYTUBE_SOURCE_DIR "/cases/powercube/case.toml --set tubes.mode=adaptive ";
  const std::string announced = (scratch / "check.txt").string(), folder = scratch.folder().string();
  const auto raytube = [&](const std::string& command) {
    return WEXITSTATUS(std::system((std::string(RAYTUBE_PROGRAM) + command + " > " + announced).c_str()));
  };
  ASSERT_EQ(raytube(" run" + words + "--set output.plots=false -o " + folder), 0);
  const nlohmann::json run = nlohmann::json::parse(text_of(scratch / "run.json"));
  EXPECT_TRUE(run["case"]["tubes"]["skip"].get<bool>());
  std::map<std::string, std::uint64_t> counted;
  for (const auto& item : run["counts"]["skipped"]) counted[item["why"].get<std::string>()] = item["count"].get<std::uint64_t>();
  ASSERT_EQ(raytube(" check" + words), 0);
  const std::string text = text_of(announced);
  for (const char* line : {"convex body", "symmetric about the plane y = 0 m", "100 looks: mirror images", "all reflected tubes",
                           "faces of closed bodies turned away"})
    EXPECT_THAT(text, ::testing::HasSubstr(line));
  EXPECT_EQ(counted["mirror images of earlier ones: the target is its own image"], 100u);
  EXPECT_EQ(counted["nothing stands in front of any face of the target"],
            run["counts"]["hits_per_bounce"][0].get<std::uint64_t>());
  EXPECT_EQ(counted["turned away from the transmitter"], 100u * 4 + 5);  // two faces of the cube in sight, one at phi = 0
  ASSERT_EQ(raytube(" check" + words + "--set tubes.skip=false"), 0);
  EXPECT_THAT(text_of(announced),
              ::testing::Not(::testing::AnyOf(::testing::HasSubstr("100 looks"), ::testing::HasSubstr("reflected"))));
}

}  // namespace
}  // namespace raytube
