#include "utd/wedge/transition.h"

#include <gtest/gtest.h>

#include "run.h"

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

}  // namespace
}  // namespace raytube
