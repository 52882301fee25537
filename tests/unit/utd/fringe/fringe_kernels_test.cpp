// The fringe kernels of one face against exact references.
#include <gtest/gtest.h>

#include <vector>

#include "unit/quadrature.h"
#include "utd/wedge/edge_currents.h"

namespace raytube {
namespace {

FaceIncidence incidence_at(double source_angle, double cone = pi / 2) {
  return {dvec3(0, 0, 1), std::cos(cone), std::sin(cone), source_angle, source_angle < pi};
}

/// The observer for any complex mu with Im mu > 0, where the half-line integrals converge.
GrazingRay grazing_ray_of(Complex mu) {
  const Complex g = pi - std::acos(mu);
  return {g, std::sin(g), -mu};
}

/// Physical-optics kernels in closed form: 2 n x H on a lit face.
FringeKernels physical_optics(const FaceIncidence& incidence, Complex mu) {
  if (!incidence.lit) return {0.0, 0.0, 0.0};
  const Complex hard = 1.0 / (std::cos(incidence.source_angle) + mu);
  return {std::sin(incidence.source_angle) * hard, hard, -1.0 + mu * hard};
}

/// Half-line integrals int H_z e^{jx mu} dx = 2j G_h and int dE_z/dy e^{jx mu} dx = -2 G_s of the total field on the face phi =
/// 0, from the exact eigenfunction series. x = X t^6 absorbs the x^{1/n - 1} edge behaviour; Im mu = 1/2 cuts the tail to 1e-15.
class ExactFace {
 public:
  explicit ExactFace(double n) : n_(n), rule_(400), terms_(static_cast<int>(n * (reach + 60)) + 1) {
    for (const double t : rule_.nodes)
      for (int m = 0; m < terms_; ++m) bessel_.push_back(std::cyl_bessel_j(m / n, reach * std::pow(t, 6)));
  }

  std::pair<Complex, Complex> soft_and_hard(double source_angle, Complex mu) const {
    Complex soft = 0.0, hard = 0.0;
    for (std::size_t i = 0; i < rule_.nodes.size(); ++i) {
      const double t = rule_.nodes[i], x = reach * std::pow(t, 6);
      const Complex weight = rule_.weights[i] * 6 * reach * std::pow(t, 5) * std::exp(Complex(0, 1) * x * mu);
      for (int m = 0; m < terms_; ++m) {
        const double order = m / n_;
        const Complex term = weight * (bessel_[i * terms_ + m] / n_) * std::polar(1.0, pi * order / 2);
        hard += (m == 0 ? 2.0 : 4.0) * std::cos(order * source_angle) * term;
        soft += 4 * order * std::sin(order * source_angle) / x * term;
      }
    }
    return {-0.5 * soft, hard / Complex(0, 2)};
  }

 private:
  static constexpr double reach = 70.0;
  double n_;
  GaussLegendre rule_;
  int terms_;
  std::vector<double> bessel_;
};

TEST(FringeKernels, PlusPhysicalOpticsIsTheIntegralOfTheExactCurrent) {
  // 1e-12 of the larger of the kernel and 1: cancellation among some hundred Bessel terms of up to 1e2.
  for (const double n : {2.0, 1.5, 1.25}) {
    const ExactFace exact(n);
    for (const double share : {0.2, 0.55, 0.9})
      for (const Complex mu : {Complex(0.3, 0.5), Complex(-0.8, 0.5), Complex(-1.6, 0.5), Complex(-5, 0.5), Complex(0.99, 0.5)}) {
        const FaceIncidence incidence = incidence_at(share * n * pi);
        const FringeKernels fringe = fringe_kernels(n, incidence, grazing_ray_of(mu)), po = physical_optics(incidence, mu);
        const auto [soft, hard] = exact.soft_and_hard(incidence.source_angle, mu);
        EXPECT_LE(std::abs(fringe.soft + po.soft - soft), 1e-12 * std::max(1.0, std::abs(soft)))
            << n << ' ' << share << ' ' << mu;
        EXPECT_LE(std::abs(fringe.hard + po.hard - hard), 1e-12 * std::max(1.0, std::abs(hard)))
            << n << ' ' << share << ' ' << mu;
      }
  }
}

struct Row {
  double n, source_angle, half_cosine;
  double soft, hard, axial;
};

// Exact minus physical-optics kernels, evaluated as that difference by mpmath with 80 digits (40 would leave 1e-12 at the
// smallest offset). First block: source angles 1e-2, 1e-6, 1e-10 and 1e-14 beside the removable pole; second block: lit and dark
// faces, observers on, near and far off the cone.
const Row rows[] = {
    {2.0, 0.3100000000000006, 0.9887710779360422, -0.0390483249424847915, 0.127904358099030718, 0.377808299589807745},
    {2.0, 0.3000010000000006, 0.9887710779360422, -0.0377839309421921401, 0.127855236598056318, 0.377855227152089208},
    {2.0, 0.3000000001000006, 0.9887710779360422, -0.0377838045272166071, 0.127855231767674147, 0.377855231766729552},
    {2.0, 0.3000000000000106, 0.9887710779360422, -0.0377838045145751077, 0.12785523176719111, 0.377855231767191016},
    {2.0, 2.6100000000000003, 0.26749882862458735, -0.90996446643979935, 1.76277797404260885, 2.01050462064360963},
    {2.0, 2.6000010000000002, 0.26749882862458735, -0.900526547939159266, 1.74689432883030727, 1.99689410369868588},
    {2.0, 2.6000000001, 0.26749882862458735, -0.900525612085589366, 1.74689275586442549, 1.99689275584191235},
    {2.0, 2.6000000000000103, 0.26749882862458735, -0.90052561199200428, 1.74689275570712938, 1.99689275570712709},
    {1.5, 0.3100000000000006, 0.9887710779360422, -0.028959257315503646, 0.0948609554561402647, 0.242709201192763809},
    {1.5, 0.3000010000000006, 0.9887710779360422, -0.0280209804621591455, 0.0948188558276080765, 0.242749420504079242},
    {1.5, 0.3000000001000006, 0.9887710779360422, -0.028020886655432464, 0.0948188516878121375, 0.24274942445897736},
    {1.5, 0.3000000000000106, 0.9887710779360422, -0.02802088664605179, 0.0948188516873981585, 0.242749424459372849},
    {1.5, 2.6100000000000003, 0.26749882862458735, -0.785268399577249604, 1.5215138393344208, 1.63710143035420594},
    {1.5, 2.6000010000000002, 0.26749882862458735, -0.776461369600323657, 1.50622543304626999, 1.62400096694895442},
    {1.5, 2.6000000001, 0.26749882862458735, -0.776460496726225154, 1.50622391939216971, 1.6239996699157794},
    {1.5, 2.6000000000000103, 0.26749882862458735, -0.776460496638938001, 1.50622391924080477, 1.62399966978607648},
    {1.1, 0.3100000000000006, 0.9887710779360422, -0.00906810346447642231, 0.0297064166433418377, 0.0625294671285383265},
    {1.1, 0.3000010000000006, 0.9887710779360422, -0.00877394372570081276, 0.0296897288317603879, 0.0625454096038657384},
    {1.1, 0.3000000001000006, 0.9887710779360422, -0.00877391431806268779, 0.0296897271908883178, 0.062545411171450701},
    {1.1, 0.3000000000000106, 0.9887710779360422, -0.00877391431512192358, 0.0296897271907242308, 0.0625454111716074592},
    {1.1, 2.6100000000000003, 0.26749882862458735, -0.375177107698539641, 0.727229588730382727, 0.714063946609280882},
    {1.1, 2.6000010000000002, 0.26749882862458735, -0.369760591019068507, 0.717283371694904974, 0.705541145093013363},
    {1.1, 2.6000000001, 0.26749882862458735, -0.369760055312103162, 0.717282388604915752, 0.705540302694258049},
    {1.1, 2.6000000000000103, 0.26749882862458735, -0.369760055258532635, 0.717282388506607069, 0.705540302610018445},
    {2.0, 0.2, 0.3, -0.038545596733812366, 0.643498573731941772, 1.02766883046019226},
    {2.0, 0.2, 1.0, -0.0250208541877693958, 0.125313021572142809, 0.374686978427857191},
    {2.0, 0.2, 1.5, -0.0200066633226849587, 0.0668001556815415185, 0.266199455114604685},
    {2.0, 0.2, 40.0, -0.0012176290584620202, 0.000152457601292150347, 0.0122881334664110398},
    {2.0, 1.4, 0.3, -0.302494442336354708, 0.782588578180266967, 1.14172263410781892},
    {2.0, 1.4, 1.0, -0.182514247415212267, 0.141655725254770659, 0.358344274745229341},
    {2.0, 1.4, 1.5, -0.142221319183854105, 0.0735886445432639528, 0.242439744098576165},
    {2.0, 1.4, 40.0, -0.00790163352378483688, 0.000153318390668258781, 0.00953446825224015877},
    {2.0, 3.0, 0.3, -1.34528580098919176, 2.24777370489045782, 2.34317443801017545},
    {2.0, 3.0, 1.0, -0.465798229972036231, 0.233483995522540976, 0.266516004477459024},
    {2.0, 3.0, 1.5, -0.317524467347237168, 0.106107289296841783, 0.128624487461053758},
    {2.0, 3.0, 40.0, -0.0124466762563397475, 0.000155974170590998796, 0.00103862827939485305},
    {2.0, 3.3, 0.3, -1.31470601843056872, -2.19806757669357917, -2.30241541288873495},
    {2.0, 3.3, 1.0, -0.461887559954579522, -0.231670059020397646, -0.268329940979602354},
    {2.0, 3.3, 1.5, -0.315639238110263391, -0.105543956671112556, -0.130596151651106056},
    {2.0, 3.3, 40.0, -0.0124362137485446014, -0.000155941544160602964, -0.00114300023023111861},
    {2.0, 4.2, 0.3, -0.536257404810347231, -1.03539462832790716, -1.34902359522888389},
    {2.0, 4.2, 1.0, -0.286809848532120608, -0.166129944607508983, -0.333870055392491017},
    {2.0, 4.2, 1.5, -0.215280705254221903, -0.0831319003908937294, -0.209038348631871947},
    {2.0, 4.2, 40.0, -0.0106556307413157281, -0.00015430252429203108, -0.00638622478979257349},
    {1.5, 0.2, 0.3, -0.0303948553064248299, 0.488278661626270119, 0.733721835866874837},
    {1.5, 0.2, 1.0, -0.0185363704923401609, 0.0928605656673139812, 0.240472767666019352},
    {1.5, 0.2, 1.5, -0.0142956121162977313, 0.048941640573545354, 0.162037591325924594},
    {1.5, 0.2, 40.0, -0.000455160809600293978, 0.000103092980180698014, 0.00353888973528038536},
    {1.5, 1.4, 0.3, -0.243239081199371164, 0.613988255450596737, 0.836803702802822666},
    {1.5, 1.4, 1.0, -0.13608834546983524, 0.106947982284723476, 0.226385351048609857},
    {1.5, 1.4, 1.5, -0.101636536890720688, 0.0546285871239020744, 0.142133278399676073},
    {1.5, 1.4, 40.0, -0.00281168018367564384, 0.00010349709002641575, 0.00224614233882934815},
    {1.5, 3.0, 0.3, -1.19676282694364811, 2.01483691134895423, 1.98549960063947583},
    {1.5, 3.0, 1.0, -0.35714689965356802, 0.188673807029592072, 0.144659526303741262},
    {1.5, 3.0, 1.5, -0.225558185274244531, 0.0823735464835416132, 0.0450259206409376871},
    {1.5, 3.0, 40.0, -0.00346528219456889646, 0.00010460807161828178, -0.00130788777355008226},
    {1.5, 3.3, 0.3, -1.14332887978383619, -2.45371614736782905, -2.67871390750828652},
    {1.5, 3.3, 1.0, -0.339312070159376321, -0.279788562700142982, -0.386878103966523685},
    {1.5, 3.3, 1.5, -0.212940534434357324, -0.130787728215566634, -0.208909617912183449},
    {1.5, 3.3, 40.0, -0.00311723611044669371, -0.000207685679506036014, -0.00228017792685745727},
    {1.5, 4.2, 0.3, -0.270648439056243829, -1.40186864396074708, -1.81619895471447929},
    {1.5, 4.2, 1.0, -0.114984483887866595, -0.228832937989701748, -0.437833728676964918},
    {1.5, 4.2, 1.5, -0.0774109583553900428, -0.11475186389149765, -0.265035143046424892},
    {1.5, 4.2, 40.0, -0.00128894242258744413, -0.000207261682292569856, -0.00363654501273569856},
    {1.25, 0.2, 0.3, -0.0210301791649308398, 0.324512059174131622, 0.466099888522787935},
    {1.25, 0.2, 1.0, -0.0120131356336323908, 0.0601971910173248836, 0.139802808982675116},
    {1.25, 0.2, 1.5, -0.0089403172154954156, 0.0313729108061177213, 0.0901948121785879755},
    {1.25, 0.2, 40.0, -0.000168193194746319533, 0.0000621696017150387604, 0.00111944411359100543},
    {1.25, 1.4, 0.3, -0.172598237998770191, 0.424564297951002053, 0.548142724319821689},
    {1.25, 1.4, 1.0, -0.0887779354495994979, 0.0706583603530467798, 0.12934163964695322},
    {1.25, 1.4, 1.5, -0.0634776373852820557, 0.035441330435187473, 0.0759553434768438445},
    {1.25, 1.4, 40.0, -0.000991854453358987005, 0.0000623398522591173763, 0.000574812623083513374},
    {1.25, 3.0, 0.3, -0.983420653101708991, 1.66884170133495217, 1.5684501950946608},
    {1.25, 3.0, 1.0, -0.240108811191911481, 0.134146600432634126, 0.0658533995673658743},
    {1.25, 3.0, 1.5, -0.138679416995436665, 0.055669083815554806, 0.00515820664555817897},
    {1.25, 3.0, 40.0, -0.000929338644995466957, 0.0000627554162698138575, -0.000754576647134530056},
    {1.25, 3.3, 0.3, -0.879453829476143718, -2.87055081478239676, -3.15385166812156538},
    {1.25, 3.3, 1.0, -0.204952272652361558, -0.341002717032683976, -0.458997282967316024},
    {1.25, 3.3, 1.5, -0.11599951928160268, -0.160024804488129417, -0.239913184291547041},
    {1.25, 3.3, 40.0, -0.000692759973166788635, -0.000249682850021530057, -0.00126456278112534716},
};

TEST(FringeKernels, AgreeWithEightyDigitValues) {
  // 2e-12 relative to the larger of the kernel and 1e-3; at half_cosine = 1 the limit sin g -> 0 is taken exactly.
  for (const Row& row : rows) {
    const FringeKernels kernels = fringe_kernels(row.n, incidence_at(row.source_angle), grazing_ray_at(row.half_cosine));
    const auto tolerance = [](double reference) { return 2e-12 * std::max(std::abs(reference), 1e-3); };
    EXPECT_LE(std::abs(kernels.soft - row.soft), tolerance(row.soft))
        << row.n << ' ' << row.source_angle << ' ' << row.half_cosine;
    EXPECT_LE(std::abs(kernels.hard - row.hard), tolerance(row.hard))
        << row.n << ' ' << row.source_angle << ' ' << row.half_cosine;
    EXPECT_LE(std::abs(kernels.axial - row.axial), tolerance(row.axial))
        << row.n << ' ' << row.source_angle << ' ' << row.half_cosine;
  }
}

TEST(FringeKernels, SplitFormAddsUpToTheWhole) {
  // The pole is cut out of A- or A+ and put back; 1e-12 of the pole's size, which is what the subtraction costs.
  for (const double n : {2.0, 1.5})
    for (const double source : {2.5, 3.1, 3.2, 3.9})
      for (const double half_cosine : {0.01, 0.1, 0.3}) {
        const SplitKernels split = split_kernels(n, incidence_at(source), half_cosine);
        const FringeKernels whole = fringe_kernels(n, incidence_at(source), grazing_ray_at(half_cosine));
        if (!split.active) continue;
        const double pole = 1 / std::tan(split.angle / 2);
        const double scale = std::abs(pole * split.pole.hard);
        EXPECT_LE(std::abs(split.regular.soft + pole * split.pole.soft - whole.soft), 1e-12 * scale);
        EXPECT_LE(std::abs(split.regular.hard + pole * split.pole.hard - whole.hard), 1e-12 * scale);
        EXPECT_LE(std::abs(split.regular.axial + pole * split.pole.axial - whole.axial), 1e-12 * scale);
      }
}

TEST(FringeKernels, HardKernelIsSmoothWhereTheObserverPassesTheConeBackwards) {
  // g = 0 at half_cosine = 1, where G_h is a quotient of two zeros. Values are even in g, so neighbours at +-1e-9 differ by
  // 1e-9 of the slope; 1e-9 also covers the digits lost beside the switch to the limit form.
  for (const double n : {2.0, 1.5, 1.1})
    for (const double source : {0.4, 2.9, 3.2}) {
      const Complex limit = fringe_kernels(n, incidence_at(source), grazing_ray_at(1.0)).hard;
      for (const double step : {1e-9, 1e-10, 1e-11, 1e-12, 1e-13}) {
        EXPECT_LE(std::abs(fringe_kernels(n, incidence_at(source), grazing_ray_at(1 - step)).hard - limit), 4 * step + 1e-10);
        EXPECT_LE(std::abs(fringe_kernels(n, incidence_at(source), grazing_ray_at(1 + step)).hard - limit), 4 * step + 1e-10);
      }
    }
}

TEST(WindowedPole, IsBoundedOddAndCompact) {
  const double width = 3.0, k = 2 * pi, delta = 0.5 * std::sqrt(2 / (k * width));
  EXPECT_EQ(windowed_pole(0.0, k, width).value, 0.0);
  // The maximum of 2y/(y^2 + delta^2) is 1/delta; cot(y/2) stays below 2/y.
  for (const double y : {-1e-12, -1e-6, -1e-3, -0.1, -0.5, -0.9})
    EXPECT_LE(std::abs(windowed_pole(y, k, width).value), 1 / delta);
  EXPECT_TRUE(windowed_pole(-0.5, k, width).touched);
  EXPECT_FALSE(windowed_pole(-0.9999, k, width).touched);
  EXPECT_NEAR(windowed_pole(-1 + 1e-9, k, width).value, 1 / std::tan(-0.5), 1e-8);
}

TEST(WindowedPole, KeepsLitAndDarkFacesJoinedWhereTheSourceGrazes) {
  // As phi' passes pi the fringe current jumps by the physical-optics current that is switched off, parallel to the grazing
  // diffracted ray: G_s must not jump at all, and G_x must jump by 1 + mu times the jump of G_h. Without the window being the
  // same on both sides it would. 1e-9: change over the 1e-10 rad step.
  const double n = 1.5, half_cosine = 0.2, width = 2.0, mu = 1 - 2 * half_cosine * half_cosine;
  const SplitKernels lit = split_kernels(n, incidence_at(pi - 1e-10), half_cosine);
  const SplitKernels dark = split_kernels(n, incidence_at(pi + 1e-10), half_cosine);
  const double pole = windowed_pole(lit.angle, 2 * pi, width).value;
  EXPECT_LE(std::abs(lit.regular.soft + pole * lit.pole.soft - dark.regular.soft - pole * dark.pole.soft), 1e-9);
  const Complex hard = lit.regular.hard + pole * lit.pole.hard - dark.regular.hard - pole * dark.pole.hard;
  const Complex axial = lit.regular.axial + pole * lit.pole.axial - dark.regular.axial - pole * dark.pole.axial;
  EXPECT_LE(std::abs(axial - 1.0 - mu * hard), 1e-9);
}

}  // namespace
}  // namespace raytube
