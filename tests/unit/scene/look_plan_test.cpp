// Looks that follow from others.
#include "scene/look_plan.h"

#include <gmock/gmock.h>

namespace raytube {
namespace {

using ::testing::ElementsAre;

constexpr std::array<bool, 3> none{false, false, false};

Look monostatic(double theta_deg, double phi_deg) {
  const Direction d{theta_deg * degree, phi_deg * degree};
  return {d, d};
}

std::vector<std::size_t> places(const LookPlan& plan) {
  std::vector<std::size_t> found;
  for (const LookSource& source : plan.sources) found.push_back(source.index);
  return found;
}

TEST(LookPlan, RepeatedLooksAreComputedOnce) {
  const std::vector<Look> looks = {monostatic(30, 10),  monostatic(30, 20),     monostatic(30, 10),
                                   monostatic(30, 370), monostatic(30, -340.0), monostatic(30, -350.0)};
  const LookPlan plan = plan_looks(looks, none);
  EXPECT_THAT(plan.computed, ElementsAre(0, 1));
  EXPECT_THAT(places(plan), ElementsAre(0, 1, 0, 0, 1, 0));
  EXPECT_EQ(plan.repeated, 4u);
  EXPECT_EQ(plan.mirrored, 0u);
}

TEST(LookPlan, DirectionsNextToOneAnotherAreTwo) {
  const std::vector<Look> looks = {monostatic(30, 10), monostatic(30, 10 + 1e-11), monostatic(30 + 1e-11, 10)};
  EXPECT_EQ(plan_looks(looks, none).computed.size(), 3u);
}

// At a pole phi does not turn the direction, but it turns the polarisations.
TEST(LookPlan, PolarLooksDifferByTheirPolarisations) {
  const std::vector<Look> looks = {monostatic(0, 0), monostatic(0, 90), monostatic(180, 0), monostatic(0, 360),
                                   monostatic(0, 270)};
  EXPECT_THAT(places(plan_looks(looks, none)), ElementsAre(0, 1, 2, 0, 3));
  EXPECT_THAT(places(plan_looks(looks, {false, true, false})), ElementsAre(0, 1, 2, 0, 1));
  EXPECT_THAT(places(plan_looks(looks, {false, false, true})), ElementsAre(0, 1, 0, 0, 2));
}

TEST(LookPlan, BothDirectionsOfAPairAreMirrored) {
  const Look look{{0.4, 0.3}, {0.9, 1.1}}, across_y{{0.4, -0.3}, {0.9, -1.1}}, only_transmit{{0.4, -0.3}, {0.9, 1.1}};
  const LookPlan plan =
      plan_looks(std::vector{look, across_y, only_transmit, Look{look.receive, look.transmit}}, {false, true, false});
  EXPECT_THAT(places(plan), ElementsAre(0, 0, 1, 2));  // nor is the pair the other way round the same
  EXPECT_EQ(plan.mirrored, 1u);
}

TEST(LookPlan, TwoPlanesRestoreTheSignOfCrossPolarisation) {
  const LookPlan plan = plan_looks(
      std::vector{monostatic(40, 25), monostatic(40, 155), monostatic(40, -25), monostatic(40, 205), monostatic(140, 205)},
      {true, true, true});
  EXPECT_THAT(places(plan), ElementsAre(0, 0, 0, 0, 0));
  std::vector<bool> mirrored;
  for (const LookSource& source : plan.sources) mirrored.push_back(source.mirrored);
  EXPECT_THAT(mirrored, ElementsAre(false, true, true, false, true));
  const ScatteringMatrix s{{{{1.0, 2.0}, {3.0, 4.0}}}}, image = from_source(s, plan.sources[1]);
  EXPECT_EQ(image.vv(), s.vv());
  EXPECT_EQ(image.vh(), -s.vh());
  EXPECT_EQ(image.hv(), -s.hv());
  EXPECT_EQ(image.hh(), s.hh());
}

// As case files make them: every second value meets its image in spite of the rounding of both.
TEST(LookPlan, ASweepThroughThePlaneHalves) {
  std::vector<Look> looks;
  for (int i = -900; i <= 900; ++i) looks.push_back(monostatic(77.7, 0.1 * i));
  const LookPlan plan = plan_looks(looks, {false, true, false});
  EXPECT_EQ(plan.computed.size(), 901u);
  EXPECT_EQ(plan.mirrored, 900u);
  looks.clear();
  for (int i = 0; i <= 3600; ++i) looks.push_back(monostatic(77.7, 0.1 * i));
  EXPECT_EQ(plan_looks(looks, {true, true, false}).computed.size(), 901u);
}

}  // namespace
}  // namespace raytube
