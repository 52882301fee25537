#include "utd/multiple/strip_kernels.h"

#include <algorithm>
#include <cmath>

#include "math/erfc_ray.h"
#include "utd/wedge/rounding_guard.h"

namespace raytube {

namespace {

void add_scaled(Complexes& sum, double factor, const Complexes& values) {
  for (std::size_t i = 0; i < lanes; ++i) {
    sum.re[i] += factor * values.re[i];
    sum.im[i] += factor * values.im[i];
  }
}

// W'(x) = 2jxW - 2 e^{j pi/4} / sqrt(pi)
Complexes slope_of_erfc(const Reals& x, const Complexes& value) {
  constexpr double side = std::numbers::sqrt2 * std::numbers::inv_sqrtpi;
  Complexes result;
  for (std::size_t i = 0; i < lanes; ++i) {
    result.re[i] = -2 * x[i] * value.im[i] - side;
    result.im[i] = 2 * x[i] * value.re[i] - side;
  }
  return result;
}

}  // namespace

void KernelBatch::make_room(std::size_t size) {
  for (ComplexColumn* column : {&soft, &hard, &axial, &end, &soft_end}) column->make_room(size);
}

void KernelBatch::set(std::size_t i, const StripKernels& kernels) {
  soft.set(i, kernels.current.soft);
  hard.set(i, kernels.current.hard);
  axial.set(i, kernels.current.axial);
  end.set(i, kernels.end);
  soft_end.set(i, kernels.soft_end);
}

void KernelBatch::set_difference(const KernelBatch& a, const KernelBatch& b, std::size_t count) {
  make_room(count);
  const auto set = [count](ComplexColumn& to, const ComplexColumn& x, const ComplexColumn& y) {
    for (std::size_t i = 0; i < count; ++i) to.re[i] = x.re[i] - y.re[i];
    for (std::size_t i = 0; i < count; ++i) to.im[i] = x.im[i] - y.im[i];
  };
  set(soft, a.soft, b.soft);
  set(hard, a.hard, b.hard);
  set(axial, a.axial, b.axial);
}

// Kouyoumjian and Pathak (1974) with the observer on the face, phi = 0: N is the nearest integer to (phi' +- pi) / (2 pi n).
Strip::Term Strip::term(double n, double source, int sign) {
  const double beta = 2 * pi * n * std::round((sign * pi + source) / (2 * pi * n)) - source;
  const double eps = pi - sign * beta;    // signed angular distance to the boundary
  const double sine = std::sin(eps / 2);  // cos(beta/2), while sin(beta/2) = +-cos(eps/2)
  return {-std::abs(sine) / (2 * n * std::tan(eps / (2 * n))), std::abs(sine),
          sign * std::cos(eps / 2) * std::copysign(0.5, sine)};
}

Strip::Strip(double n, FaceIncidence incidence, double half_cosine) : half_cosine_(std::max(half_cosine, half_cosine_floor)) {
  // The angle of a source in the plane of the face keeps to its own side of pi by the lit threshold.
  double& source = incidence.source_angle;
  source = incidence.lit ? std::min(source, pi - lit_threshold) : std::max(source, pi + lit_threshold);
  has_local_part_ = n != 2.0;
  if (source == 0.0 || source == n * pi) {
    set_grazing(n, source == 0.0);
    return;
  }
  terms_ = {term(n, source, +1), term(n, source, -1)};
  if (has_local_part_) find_local_part(n, incidence);
}

// A wave that grazes this face or the other one: both terms are the same wave, eps = pi or (1 - n) pi, and it has no soft part.
void Strip::set_grazing(double n, bool own_face) {
  const double tangent = std::tan(pi / (2 * n)), distance = own_face ? 1.0 : std::abs(std::sin((n - 1) * pi / 2));
  terms_[0] = {own_face ? -1 / (n * tangent) : distance * tangent / n, distance, 0.0};
  term_count_ = 1;
  if (!has_local_part_) return;
  const double exact = grazing_hard_kernel(n, own_face, grazing_ray_at(half_cosine_));
  local_ = {0.0, exact - untruncated().current.hard.real(), local_step(n, own_face)};
}

double Strip::total_strength() const { return terms_[0].strength + (term_count_ == 2 ? terms_[1].strength : 0.0); }

// The kernels of an untruncated strip, exact (Michaeli 1986) minus uniform; both are real.
void Strip::find_local_part(double n, const FaceIncidence& incidence) {
  const FringeKernels exact = fringe_kernels(n, incidence, grazing_ray_at(half_cosine_));
  const FringeKernels uniform = untruncated().current;
  local_ = {exact.soft.real() - uniform.soft.real(), exact.hard.real() - uniform.hard.real(), local_step(n, incidence.lit)};
}

double Strip::local_step(double n, bool lit) const { return (lit ? 1.0 : 0.0) - 1 / n + total_strength(); }

StripKernels Strip::untruncated() const {
  double soft = local_.soft, hard = local_.hard;
  for (int i = 0; i < term_count_; ++i) {
    const Term& t = terms_[i];
    const double sum = t.distance + half_cosine_;
    hard -= t.strength / (2 * half_cosine_ * sum);
    soft -= 2 * t.strength * t.slope / sum;
  }
  const double mu = 1 - 2 * half_cosine_ * half_cosine_;
  return {{soft, hard, mu * hard - total_strength() + local_.axial}, 0.0, 0.0};
}

void Strip::start_parts(std::span<const double> lengths, KernelBatch& batch) const {
  const FringeKernels whole = untruncated().current, local = local_part();
  batch.make_room(lengths.size());
  for (std::size_t first = 0; first < lengths.size(); first += lanes) {
    Complexes soft{}, hard{}, axial{};
    Reals length{}, reached{};
    const std::size_t width = std::min(lanes, lengths.size() - first);
    for (std::size_t i = 0; i < width; ++i) length[i] = std::min(lengths[first + i], whole_length);
    const bool some_left = has_local_part_ && std::ranges::min(std::span(length.value, width)) < whole_length;
    if (some_left) reached = one_minus_exp(length);
    for (std::size_t i = 0; i < lanes; ++i) {
      const double left = some_left ? 1.0 - reached[i] : 0.0;
      soft.re[i] = whole.soft.real() - left * local.soft.real();
      hard.re[i] = whole.hard.real() - left * local.hard.real();
      axial.re[i] = whole.axial.real() - left * local.axial.real();
    }
    store(soft, batch.soft, first);
    store(hard, batch.hard, first);
    store(axial, batch.axial, first);
  }
}

// The derivatives of the closed forms by X, without e^{-jX(1 - mu)}; all of a term's is B times that of W and W'.
Strip::Currents Strip::currents(const Reals& root) const {
  Currents result{};
  for (int i = 0; i < term_count_; ++i) {
    const Term& t = terms_[i];
    Reals boundary;
    for (std::size_t l = 0; l < lanes; ++l) boundary[l] = t.distance * root[l];
    const Complexes there = scaled_erfc(boundary), slope = slope_of_erfc(boundary, there);
    for (std::size_t l = 0; l < lanes; ++l) {
      result.hard.re[l] += t.strength * there.im[l];
      result.hard.im[l] -= t.strength * there.re[l];
    }
    add_scaled(result.axial, t.strength * t.distance, slope);
    add_scaled(result.soft, 2 * t.strength * t.slope, slope);
  }
  for (std::size_t l = 0; l < lanes; ++l) {
    result.axial.re[l] += root[l] * result.hard.re[l];
    result.axial.im[l] += root[l] * result.hard.im[l];
  }
  return result;
}

struct Strip::Observer {
  Reals root, x;
  Complexes value, decay, ratio;
};

Strip::Observer Strip::observer(const Reals& length) const {
  Observer result;
  Reals angle;
  for (std::size_t i = 0; i < lanes; ++i) {
    result.root[i] = std::sqrt(2 * length[i]);
    result.x[i] = half_cosine_ * result.root[i];
    angle[i] = -2 * half_cosine_ * half_cosine_ * length[i];
  }
  result.value = scaled_erfc(result.x);
  result.decay = unit_phasors(angle);
  result.ratio = erf_over(result.x, result.value, result.decay);
  return result;
}

/// G_s, G_h, G_x, and of the hard and of the soft current first T, then D T at the end.
struct Strip::Sums {
  Complexes soft, hard, axial, end, soft_end;

  Sums() {
    for (Complexes* each : {&soft, &hard, &axial, &end, &soft_end}) *each = {};
  }
};

// 2j D / r, for the end of the soft current. That is singular at its edge, as 1/r, where a strip without length starts and ends.
Complexes Strip::soft_phase(const Observer& at) {
  Complexes result;
  for (std::size_t i = 0; i < lanes; ++i) {
    const double scale = 2 / (at.root[i] > rounding_guard ? at.root[i] : rounding_guard);
    result.re[i] = -scale * at.decay.im[i];
    result.im[i] = scale * at.decay.re[i];
  }
  return result;
}

// One diffracted wave's share of G_h and G_s, and of T in sum.end, sum.soft_end.
void Strip::add(const Term& t, const Observer& at, Sums& sum) const {
  Reals boundary;
  for (std::size_t i = 0; i < lanes; ++i) boundary[i] = t.distance * at.root[i];
  const Complexes there = scaled_erfc(boundary), quotient = divided_difference(boundary, at.x, there, at.value);
  Complexes hard, difference{};
  add_products(difference, at.decay, quotient);
  for (std::size_t i = 0; i < lanes; ++i) {
    hard.re[i] = at.root[i] * (at.ratio.re[i] + difference.re[i]);
    hard.im[i] = at.root[i] * (at.ratio.im[i] + difference.im[i]);
  }
  const double share = t.strength / (t.distance + half_cosine_);
  add_scaled(sum.hard, -0.5 * share, hard);
  add_scaled(sum.end, t.strength, there);
  if (t.slope == 0.0) return;
  Complexes soft;
  for (std::size_t i = 0; i < lanes; ++i) {
    soft.re[i] = boundary[i] * difference.re[i] - at.x[i] * at.ratio.re[i];
    soft.im[i] = boundary[i] * difference.im[i] - at.x[i] * at.ratio.im[i];
  }
  add_scaled(sum.soft, 2 * share * t.slope, soft);
  add_scaled(sum.soft_end, t.strength * t.slope, slope_of_erfc(boundary, there));
}

// Adds what a strip of this length has of the local part, which lives within xi < 1 of the edge.
void Strip::add_local(const Reals& length, Sums& sum) const {
  const Reals reached = one_minus_exp(length);
  for (std::size_t i = 0; i < lanes; ++i) {
    sum.soft.re[i] += local_.soft * reached[i];
    sum.hard.re[i] += local_.hard * reached[i];
    sum.axial.re[i] += local_.axial * reached[i];
  }
}

Strip::Sums Strip::sums(const Reals& length) const {
  const Observer at = observer(length);
  Sums sum;
  for (int i = 0; i < term_count_; ++i) add(terms_[i], at, sum);
  Complexes end{}, soft_end{};
  add_products(end, at.decay, sum.end);
  if (term_count_ == 2) add_products(soft_end, soft_phase(at), sum.soft_end);
  sum.soft_end = soft_end;
  sum.end = sum.axial = end;
  for (std::size_t i = 0; i < lanes; ++i) sum.axial.re[i] -= total_strength();
  if (has_local_part_) add_local(length, sum);
  add_scaled(sum.axial, 1 - 2 * half_cosine_ * half_cosine_, sum.hard);
  return sum;
}

// Lengths past the end of the list and infinite ones are 1 here, so that every lane stays finite.
void Strip::finite_at(std::span<const double> lengths, KernelBatch& batch) const {
  for (std::size_t first = 0; first < lengths.size(); first += lanes) {
    Reals block;
    for (std::size_t i = 0; i < lanes; ++i) {
      const double length = first + i < lengths.size() ? lengths[first + i] : 1.0;
      block[i] = std::isinf(length) ? 1.0 : length;
    }
    const Sums found = sums(block);
    store(found.soft, batch.soft, first);
    store(found.hard, batch.hard, first);
    store(found.axial, batch.axial, first);
    store(found.end, batch.end, first);
    store(found.soft_end, batch.soft_end, first);
  }
}

void Strip::at(std::span<const double> lengths, KernelBatch& batch) const {
  const auto is_untruncated = [](double length) { return std::isinf(length); };
  std::size_t endless = 0;
  for (const double length : lengths) endless += is_untruncated(length) ? 1 : 0;
  batch.make_room(lengths.size());
  if (endless < lengths.size()) finite_at(lengths, batch);
  if (endless == 0) return;
  const StripKernels without_end = untruncated();
  for (std::size_t i = 0; i < lengths.size(); ++i)
    if (is_untruncated(lengths[i])) batch.set(i, without_end);
}

}  // namespace raytube
