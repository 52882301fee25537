// A solve that was stopped, and goes on from the looks it has kept, gives the same bits as one that was not.
#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <map>

#include "core/error.h"
#include "core/time_left.h"
#include "run.h"
#include "shapes.h"
#include "solve/look_result.h"

namespace raytube {
namespace {

using namespace raytube::testing;

// What a program would keep on disk.
struct Store {
  std::map<std::size_t, std::string> looks;
  std::mutex mutex;
  std::size_t wanted = 0;

  KeptLooks hooks() {
    return {[this](std::size_t count) { wanted = count; },
            [this](std::size_t place) {
              const std::lock_guard lock(mutex);
              const auto found = looks.find(place);
              return found == looks.end() ? std::string() : found->second;
            },
            [this](std::size_t place, std::string bytes) {
              const std::lock_guard lock(mutex);
              EXPECT_FALSE(looks.contains(place)) << "look " << place << " was computed twice";
              looks[place] = std::move(bytes);
            }};
  }
};

template <class Values>
bool same_bytes(const std::vector<Values>& a, const std::vector<Values>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
}

void expect_same(const SweepResult& one, const SweepResult& other) {
  EXPECT_TRUE(same_bytes(one.total, other.total));
  EXPECT_TRUE(same_bytes(one.error, other.error));
  EXPECT_TRUE(same_bytes(one.model, other.model));
  ASSERT_EQ(one.model_parts.size(), other.model_parts.size());
  for (std::size_t i = 0; i < one.model_parts.size(); ++i) {
    EXPECT_EQ(one.model_parts[i].name, other.model_parts[i].name);
    EXPECT_EQ(one.model_parts[i].rms, other.model_parts[i].rms);
    EXPECT_EQ(one.model_parts[i].rows_largest, other.model_parts[i].rows_largest);
    EXPECT_TRUE(same_bytes(one.model_parts[i].rows, other.model_parts[i].rows));
  }
  ASSERT_EQ(one.bounces.size(), other.bounces.size());
  for (std::size_t b = 0; b < one.bounces.size(); ++b) EXPECT_TRUE(same_bytes(one.bounces[b], other.bounces[b]));
  for (const MechanismRows& column : one.mechanisms) EXPECT_TRUE(same_bytes(column.rows, other.of(column.name)));
  const Statistics &a = one.statistics, &b = other.statistics;
  EXPECT_EQ(a.tubes, b.tubes);
  EXPECT_EQ(a.rays, b.rays);
  EXPECT_EQ(a.hits, b.hits);
  for (const Truncation reason : truncations) {
    EXPECT_EQ(a.truncated[reason].tubes, b.truncated[reason].tubes);
    EXPECT_EQ(a.truncated[reason].sigma, b.truncated[reason].sigma);
  }
  EXPECT_EQ(a.lost_rays, b.lost_rays);
  EXPECT_EQ(a.looks_with_lost_rays, b.looks_with_lost_rays);
  ASSERT_EQ(a.first_lost_rays.size(), b.first_lost_rays.size());
  for (std::size_t i = 0; i < a.first_lost_rays.size(); ++i) {
    EXPECT_EQ(a.first_lost_rays[i].at, b.first_lost_rays[i].at);
    EXPECT_EQ(a.first_lost_rays[i].triangle, b.first_lost_rays[i].triangle);
    EXPECT_EQ(a.first_lost_rays[i].look, b.first_lost_rays[i].look);
  }
  EXPECT_EQ(a.sliver_area, b.sliver_area);
  ASSERT_EQ(a.counts.size(), b.counts.size());
  for (std::size_t i = 0; i < a.counts.size(); ++i) EXPECT_EQ(a.counts[i].count, b.counts[i].count) << a.counts[i].what;
  ASSERT_EQ(a.skipped.size(), b.skipped.size());
  for (std::size_t i = 0; i < a.skipped.size(); ++i) EXPECT_EQ(a.skipped[i].count, b.skipped[i].count) << a.skipped[i].what;
}

Sweep some_looks() {
  Sweep sweep{{9e9, 10e9}, {}, true};
  for (int i = 0; i < 9; ++i) sweep.looks.push_back({{0.3 + 0.2 * i, 0.17 * i}, {0.5 + 0.2 * i, 0.1 + 0.15 * i}});
  sweep.looks.push_back(sweep.looks[2]);  // follows from another one
  return sweep;
}

// Stopped ever later, always going on from what was kept, with another number of threads each time.
void expect_same_after_stops(const PolygonSoup& soup, SolveOptions o) {
  const Sweep sweep = some_looks();
  const SweepResult whole = solve_soup(soup, sweep, o);
  Store store;
  std::atomic<int> reports = 0;
  int stops = 0;
  for (int patience = 1;; ++patience) {
    reports = 0;
    o.progress = [&](double) { return ++reports < 3 * patience; };
    o.kept = store.hooks();
    o.threads = 1 + patience % 3;
    try {
      expect_same(whole, solve_soup(soup, sweep, o));
      break;
    } catch (const Interrupted&) {
      ++stops;
    }
  }
  EXPECT_GT(stops, 2);
  EXPECT_EQ(store.wanted, 9u);
  EXPECT_EQ(store.looks.size(), 9u);
}

TEST(KeptLooks, UniformTubes) { expect_same_after_stops(shapes::trihedral(0.5), options(EdgeMethod::fringe)); }

// A body that crosses itself, so that the smaller part of it is inside out.
PolygonSoup crossed() {
  PolygonSoup soup = shapes::cube(0.1);
  std::swap(soup.points[1], soup.points[3]);
  std::swap(soup.points[5], soup.points[7]);
  for (const std::size_t corner : {0, 2, 4, 6}) soup.points[corner].y *= 2.0;
  return soup;
}

TEST(KeptLooks, PlacesOfLostRays) {
  const SweepResult result = solve_soup(crossed(), some_looks(), options(EdgeMethod::fringe));
  ASSERT_EQ(result.statistics.first_lost_rays.size(), most_lost_rays_told);
  EXPECT_GT(result.statistics.lost_rays, result.statistics.looks_with_lost_rays);
  EXPECT_EQ(result.statistics.first_lost_rays[0].transmit,
            some_looks().looks[result.statistics.first_lost_rays[0].look].transmit);
  expect_same_after_stops(crossed(), options(EdgeMethod::fringe));
}

TEST(KeptLooks, AdaptiveTubesWithWavesBetweenSurfaces) {
  SolveOptions o = options(EdgeMethod::fringe);
  o.tubes.mode = TubeMode::adaptive;
  expect_same_after_stops(shapes::dihedral(0.1, 0.12), o);
}

TEST(KeptLooks, CurvedSurfaces) {
  SolveOptions o = options(EdgeMethod::fringe);
  o.tubes.mode = TubeMode::adaptive;
  expect_same_after_stops(shapes::icosphere(3, 0.2), o);
}

TEST(KeptLooks, RaysInThePlaceOfCurrents) { expect_same_after_stops(shapes::trihedral(0.5), options(EdgeMethod::utd)); }

// 24 of 40 looks are there, all over the sweep; each of the others takes a second, by a clock of the test's own. Looks are
// equally much work, so that only what is left of rounding, and of shares told within a look, is in the way of an exact forecast.
TEST(KeptLooks, TimeLeftIsThatOfTheOthers) {
  Sweep sweep{{9e9}, {}};
  for (int i = 0; i < 40; ++i) sweep.looks.push_back({{0.3 + 0.03 * i, 0.1}, {0.3 + 0.03 * i, 0.1}});
  SolveOptions o = options(EdgeMethod::none);
  Store store;
  o.kept = store.hooks();
  o.threads = 1;
  solve_soup(shapes::plate(0.1), sweep, o);
  ASSERT_EQ(store.looks.size(), 40u);
  std::erase_if(store.looks, [](const auto& look) { return look.first % 5 < 2; });

  TimeLeft left(24.0 / 40.0);
  double seconds = 0.0, share = 0.0;
  int computed = 0;
  o.progress = [&](double done) { return left.after(share = done, seconds), true; };
  o.kept.keep = [&](std::size_t, const std::string&) {
    seconds += 1.0;
    const double truth = 16.0 - ++computed;
    const std::optional<double> said = left.after(share, seconds);
    ASSERT_TRUE(said);
    EXPECT_NEAR(*said, truth, 1e-6) << share;
  };
  solve_soup(shapes::plate(0.1), sweep, o);
  EXPECT_EQ(computed, 16);
}

LookResult some_look() {
  LookResult look;
  look.tubes.bounces.assign(3, std::vector<ScatteringMatrix>(2));
  look.tubes.bounces[2][1].at(0, 1) = {0.1, -0.0};
  look.tubes.error.resize(2);
  look.tubes.error[1][1][0] = 5e-324;
  look.tubes.hits = {7, 5, 3};
  look.tubes.rays = 15;
  look.met = {{0.3, 0.1}};
  look.tubes.truncated[Truncation::width] = {3, 1e-300};
  look.tubes.lost_rays = 2;
  look.tubes.first_lost = {{{0.1, 1e-300, -0.0}, 7}, {{0.2, 3.0, 4.0}, 8}};
  look.tubes.sliver_area = 1e-17;
  look.mechanisms.resize(2);
  look.mechanisms[1] = {.s = {std::vector<ScatteringMatrix>(2), {}}, .ran = {false, true}, .most_db = 0.1};
  look.mechanisms[1].counts = {{"looks without edge currents", "no edge is lit", 1, Fold::least}};
  return look;
}

TEST(LookBytes, HoldEveryBit) {
  const LookResult look = some_look();
  const std::string bytes = look_bytes(look);
  const auto again = look_of_bytes(bytes, 2, look.mechanisms.size());
  ASSERT_TRUE(again);
  EXPECT_EQ(look_bytes(*again), bytes);
  EXPECT_TRUE(std::signbit(again->tubes.bounces[2][1].vh().imag()));
  EXPECT_EQ(again->tubes.error[1][1][0], 5e-324);
  EXPECT_EQ(again->tubes.hits, look.tubes.hits);
  EXPECT_EQ(again->met, look.met);
  EXPECT_EQ(again->tubes.truncated[Truncation::width].sigma, 1e-300);
  ASSERT_EQ(again->mechanisms.size(), 2u);
  EXPECT_EQ(again->mechanisms[1].ran, look.mechanisms[1].ran);
  EXPECT_EQ(count_named(again->mechanisms[1].counts, "looks without edge currents"), 1u);
  EXPECT_EQ(again->mechanisms[1].counts[0].fold, Fold::least);
  EXPECT_TRUE(again->mechanisms[0].s.empty());
}

TEST(LookBytes, OtherBytesAreNoLook) {
  const std::string bytes = look_bytes(some_look());
  EXPECT_FALSE(look_of_bytes(bytes, 3, 2));
  EXPECT_FALSE(look_of_bytes(bytes + 'x', 2, 2));
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(look_of_bytes(bytes.substr(0, size), 2, 2)) << size;
  EXPECT_FALSE(look_of_bytes(bytes, 2, 3));  // of a program with another list of mechanisms
  // Lengths of lists that no memory could hold.
  EXPECT_FALSE(look_of_bytes(std::string(bytes.size(), '\xff'), 2, 2));
}

}  // namespace
}  // namespace raytube
