#include <gtest/gtest.h>

#include "run.h"
#include "utd/wedge/transition.h"

namespace raytube {
namespace {

struct Reference {
  double x;
  Complex value;
};

// sqrt(pi) z e^{z^2} erfc(z), z = e^{j pi/4} sqrt(X), by mpmath with 40 digits; that form agrees with a quadrature of the
// defining integral to 1e-40.
const Reference references[] = {
    {1e-12, {1.253314137314246926e-6, 1.253312137316753553e-6}},
    {1e-11, {3.963327297566377754e-6, 3.963307297645644166e-6}},
    {1e-10, {0.00001253314137190170194, 0.00001253294137440831688}},
    {1e-9, {0.00003963327293642817171, 0.00003963127301569338432}},
    {1e-8, {0.0001253314124783692162, 0.0001253114149848641575}},
    {1e-7, {0.000396332690140659468, 0.0003961327693938720873}},
    {1e-6, {0.001253312885334069584, 0.001251315390629011414}},
    {1e-5, {0.003963287797468202743, 0.003943366930681353542}},
    {1e-4, {0.01253190132968738745, 0.01233439462515785597}},
    {1e-3, {0.03959495322623571134, 0.03767288695912908828}},
    {3e-3, {0.06845259332339671812, 0.06285248817269873397}},
    {1e-2, {0.1242051857737636759, 0.1065789737918827839}},
    {3e-2, {0.2116711396269860507, 0.1635085311748100032}},
    {1e-1, {0.3681035678004820477, 0.2344529622924730472}},
    {3e-1, {0.5717132383007475782, 0.2729915465634244644}},
    {1e0, {0.8095254817474088444, 0.2321993900552646057}},
    {3e0, {0.9472422587410705527, 0.132578261830626453}},
    {1e1, {0.9930411270116263372, 0.04835149556165434733}},
    {3e1, {0.9991745568264292346, 0.01659839231701910386}},
    {1e2, {0.9999250654633636137, 0.004998127942634219803}},
    {1e3, {0.9999992500065623376, 0.0004999981250295301943}},
    {1e4, {0.9999999925000006562, 0.00004999999812500029531}},
    {1e5, {0.9999999999250000001, 4.999999998125000003e-6}},
};

TEST(Transition, AgreesWithFortyDigitValuesToRounding) {
  // Relative, at small and large X alike: 4e-16 of the fitted function and a few roundings.
  for (const Reference& reference : references)
    EXPECT_LE(std::abs(transition(reference.x) - reference.value), 1e-15 * std::abs(reference.value)) << "X = " << reference.x;
}

TEST(Transition, LimitsAndSymmetry) {
  EXPECT_EQ(transition(0.0), Complex(0.0));
  EXPECT_EQ(transition(-0.7), std::conj(transition(0.7)));
  // F -> 1 + j/(2X), first omitted term 3/(4 X^2) = 1e-16
  EXPECT_LE(std::abs(transition(1e8) - Complex(1.0, 5e-9)), 1e-15);
}

/// Over 600 values of X from 1e-12 to 1e5 and 2001 from 0.3 to 5.5, as in the table of errors.
double largest_error(TransitionTier tier, double low, double high) {
  double worst = 0.0;
  const auto look = [&](double x) {
    if (x >= low && x <= high) worst = std::max(worst, std::abs(transition(x, tier) - transition(x)));
  };
  for (int i = 0; i < 600; ++i) look(std::pow(10.0, -12 + 17 * i / 599.0));
  for (int i = 1; i <= 2000; ++i) look(0.3 + 5.2 * i / 2000);
  return worst;
}

TEST(Transition, TiersHaveTheErrorsTheyAreKnownFor) {
  using enum TransitionTier;
  struct Row {
    TransitionTier tier;
    double low, high;
    const char* error;  // as an independent implementation prints it
  };
  const Row rows[] = {{kouyoumjian_pathak, 0, 0.01, "1.9e-7"},
                      {kouyoumjian_pathak, 0, 0.1, "1.8e-4"},
                      {kouyoumjian_pathak, 0, 0.3, "5.0e-3"},
                      {kouyoumjian_pathak, 0.3, 5.5, "7.8e-3"},
                      {kouyoumjian_pathak, 5.501, 1e5, "3.1e-3"},
                      {kouyoumjian_pathak, 10, 1e5, "1.8e-4"},
                      {kouyoumjian_pathak, 50, 1e5, "2.8e-7"},
                      {as_printed, 0, 0.001, "0.075"},
                      {as_printed, 0, 0.01, "0.21"},
                      {as_printed, 0, 0.3, "0.47"},
                      {as_printed, 0.301, 5.5, "7.8e-3"},
                      {as_printed, 50, 1e5, "2.8e-7"}};
  for (const Row& row : rows)
    testing::expect_printed(largest_error(row.tier, row.low, row.high), row.error,
                            "F of tier " + std::to_string(static_cast<int>(row.tier)) + ", X up to " + std::to_string(row.high));
}

TEST(Transition, TiersShareTheirLimits) {
  for (const TransitionTier tier : {TransitionTier::kouyoumjian_pathak, TransitionTier::as_printed}) {
    EXPECT_LE(std::abs(transition(0.0, tier)), 0.0);
    EXPECT_EQ(transition(-2.0, tier), std::conj(transition(2.0, tier)));
    EXPECT_LE(std::abs(transition(1e8, tier) - transition(1e8)), 1e-15);
  }
}

}  // namespace
}  // namespace raytube
