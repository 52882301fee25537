#include "math/lanes.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "core/instruction_set.h"

namespace raytube {

namespace {

// +-1/first!, 1/(first + step)!, ...: Taylor coefficients.
template <std::size_t count>
constexpr std::array<double, count> inverse_factorials(int first, int step, int sign) {
  std::array<double, count> result{};
  double factorial = 1.0, alternating = 1.0;
  for (int m = 2; m <= first; ++m) factorial *= m;
  for (std::size_t i = 0; i < count; ++i) {
    result[i] = alternating / factorial;
    for (int m = 1; m <= step; ++m) factorial *= first + step * static_cast<int>(i) + m;
    alternating *= sign;
  }
  return result;
}

// On |r| <= pi/4 the first terms left out are r^17/17! = 5e-17 and r^18/18! = 2e-18; on |r| <= ln(2)/2, r^15/15! = 1e-19.
constexpr auto sine = inverse_factorials<8>(1, 2, -1);
constexpr auto cosine = inverse_factorials<9>(0, 2, -1);
constexpr auto exponential = inverse_factorials<14>(1, 1, +1);

// Cody and Waite (1980): multiples of pi/2 and ln 2 are taken off in two parts; with fma the first step is exact.
constexpr double half_pi_high = 0x1.921fb54442d18p+0, half_pi_low = 0x1.1a62633145c07p-54;
constexpr double ln2_high = 0x1.62e42fefa39efp-1, ln2_low = 0x1.abc9e3b39803fp-56;

[[gnu::always_inline]] inline double reduced(double x, double multiple, double high, double low) {
  return std::fma(-multiple, low, std::fma(-multiple, high, x));
}

// 2^-n for whole 0 <= n < 1023: the sum's last bits are the biased exponent.
[[gnu::always_inline]] inline double inverse_power_of_two(double n) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(0x1p52 + (1023 - n)) << 52);
}

[[gnu::always_inline]] inline Complexes phasors_of(const Reals& angle) {
  Complexes result;
  for (std::size_t i = 0; i < lanes; ++i) {
    const double turns = std::nearbyint(angle[i] * (2 / pi));  // quarter turns
    const double r = reduced(angle[i], turns, half_pi_high, half_pi_low), r2 = r * r;
    const double s = r * polynomial(sine, r2), c = polynomial(cosine, r2);
    const double quadrant = turns - 4 * std::floor(turns / 4);
    const bool odd = quadrant == 1.0 || quadrant == 3.0;
    const double re = odd ? s : c, im = odd ? c : s;
    result.re[i] = quadrant == 1.0 || quadrant == 2.0 ? -re : re;
    result.im[i] = quadrant >= 2.0 ? -im : im;
  }
  return result;
}

[[gnu::always_inline]] inline Reals sincs_of(const Reals& x) {
  const Complexes phasors = phasors_of(x);
  Reals result;
  for (std::size_t i = 0; i < lanes; ++i) result[i] = x[i] == 0.0 ? 1.0 : phasors.im[i] / x[i];
  return result;
}

[[gnu::always_inline]] inline Reals one_minus_exp_of(const Reals& x) {
  Reals result;
  for (std::size_t i = 0; i < lanes; ++i) {
    const double bounded = std::min(x[i], 40.0);  // e^-40 is lost beside 1
    const double halvings = std::nearbyint(bounded * (1 / ln2_high)), scale = inverse_power_of_two(halvings);
    const double r = -reduced(bounded, halvings, ln2_high, ln2_low);
    result[i] = (1 - scale) - scale * (r * polynomial(exponential, r));
  }
  return result;
}

// Each kernel once more for AVX-512. An attribute, not a file compiled for it: what the file shares with others stays for all
// machines.
#define RAYTUBE_AVX512 [[gnu::target("avx512f,avx512dq,avx512cd,avx512bw,avx512vl")]]
RAYTUBE_AVX512 Complexes wide_phasors_of(const Reals& angle) { return phasors_of(angle); }
RAYTUBE_AVX512 Reals wide_sincs_of(const Reals& x) { return sincs_of(x); }
RAYTUBE_AVX512 Reals wide_one_minus_exp_of(const Reals& x) { return one_minus_exp_of(x); }
#undef RAYTUBE_AVX512

bool wide() { return allowed_instruction_set() == InstructionSet::avx512; }

}  // namespace

Complexes unit_phasors(const Reals& angle) { return wide() ? wide_phasors_of(angle) : phasors_of(angle); }

Reals sincs(const Reals& x) { return wide() ? wide_sincs_of(x) : sincs_of(x); }

Reals one_minus_exp(const Reals& x) { return wide() ? wide_one_minus_exp_of(x) : one_minus_exp_of(x); }

}  // namespace raytube
