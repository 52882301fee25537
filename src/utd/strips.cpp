#include "utd/strips.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raytube {

namespace {

constexpr double hair =
    10 * along_edge;                   // [rad]; above the limit for "exactly", and small enough for its own square not to count
constexpr double same_length = 1e-13;  // relative; strips between parallel edges share their kernels

void add_product(FringeKernels& sum, const FringeKernels& kernels, Complex factor) {
  sum.soft += factor * kernels.soft;
  sum.hard += factor * kernels.hard;
  sum.axial += factor * kernels.axial;
}

}  // namespace

StripWalk::StripWalk(std::span<const Wedge> wedges, const Outlines& outlines, const LookVectors& look,
                     std::span<const double> frequencies, int order, TransitionTier tier)
    : wedges_(wedges),
      outlines_(outlines),
      look_(look),
      order_(order),
      tier_(tier),
      placer_(wedges, outlines, {look.incident, look.scattered, wavelength(*std::ranges::max_element(frequencies))}),
      steps_(order + 1) {
  for (const double frequency : frequencies) wavenumbers_.push_back(wavenumber(frequency));
  sums_.first.resize(frequencies.size());
  sums_.higher.resize(frequencies.size());
  sums_.windowed.resize(frequencies.size());
}

void StripWalk::add(std::uint32_t index, const WedgeIncidence& incidence, std::span<const LitInterval> lit) {
  for (int face = 0; face < 2; ++face) {
    const FaceIncidence& arriving = incidence.faces[face];
    if (arriving.sin_cone <= sin_cone_floor) continue;  // along the edge: strips of no width
    start(first_wave(wedges_, index, face, arriving, look_.incident, order_), lit);
  }
}

void StripWalk::start(const StripWave& wave, std::span<const LitInterval> lit) {
  place(wave, lit);
  bound_endless(wave, steps_[0]);
  radiate_direct(wave);
  go_beyond(wave, lit);
}

// The points of the first strips, the ends of these and their kernels.
void StripWalk::place(const StripWave& wave, std::span<const LitInterval> lit) {
  placer_.place(wave, lit, points_);
  const dvec3 difference = look_.scattered - look_.incident;
  Step& step = steps_[0];
  step.points.clear();
  step.panels.clear();
  direct_.clear();
  for (const EdgePoint& point : points_) {
    step.points.push_back(point.place);
    step.panels.push_back(point.panel);
  }
  for (const double k : wavenumbers_)
    for (const EdgePoint& point : points_) direct_.push_back(std::polar(point.weight, k * glm::dot(difference, point.place)));
  find_ends(step, wave);
  find_kernels(wave, step);
}

// A wave that runs exactly along an edge at the side of a face meets it over its whole length, and yet its strips never end
// there. Turned by a hair to either side they do; the limit of a vanishing turn is finite, and half of each counts.
void StripWalk::go_beyond(const StripWave& wave, std::span<const LitInterval> lit) {
  if (!placer_.runs_along_edge()) {
    excite_far_edges(wave, 1.0);
    pass_on(0, wave);
    return;
  }
  const dvec3 aside = glm::cross(wedges_[wave.wedge].faces[wave.face].normal, wave.direction);
  for (const double turn : {-hair, hair}) {
    StripWave turned = wave;
    turned.direction = glm::normalize(wave.direction + turn * aside);
    place(turned, lit);
    excite_far_edges(turned, 0.5);
    pass_on(0, turned);
  }
}

void StripWalk::follow(int level, const StripWave& wave) {
  find_ends(steps_[level], wave);
  find_kernels(wave, steps_[level]);
  radiate(wave, steps_[level]);
  pass_on(level, wave);
}

void StripWalk::find_ends(Step& step, const StripWave& wave) const {
  step.lengths.clear();
  step.exits.clear();
  step.kernel.clear();
  step.distinct.clear();
  std::optional<FaceExit> exit;
  for (std::size_t i = 0; i < step.points.size(); ++i) {
    if (i == 0 || step.panels[i] != step.panels[i - 1]) exit = strip_end(wedges_, outlines_, wave, step.points[i]);
    const double length = exit ? exit->edge->distance(step.points[i], wave.direction) : std::numeric_limits<double>::infinity();
    step.exits.push_back(exit ? exit->edge : nullptr);
    step.lengths.push_back(length);
    const double last = step.distinct.empty() ? -1.0 : step.distinct.back();
    if (length != last && !(std::abs(length - last) < same_length * length)) step.distinct.push_back(length);
    step.kernel.push_back(step.distinct.size() - 1);
  }
}

// Frequency after frequency, distinct length after distinct length.
void StripWalk::find_kernels(const StripWave& wave, const Step& step) {
  const Wedge& wedge = wedges_[wave.wedge];
  const double half_cosine = glance_half_cosine(wedge.faces[wave.face], wave.incidence, look_.scattered);
  lengths_.clear();
  for (const double k : wavenumbers_)
    for (const double length : step.distinct) lengths_.push_back(k * wave.incidence.sin_cone * wave.incidence.sin_cone * length);
  Strip(wedge.n, wave.incidence, half_cosine, tier_).at(lengths_, kernels_);
}

void StripWalk::bound_endless(const StripWave& wave, const Step& step) {
  const Wedge& wedge = wedges_[wave.wedge];
  const WedgeFace& face = wedge.faces[wave.face];
  const SplitKernels endless = split_kernels(wedge.n, wave.incidence, glance_half_cosine(face, wave.incidence, look_.scattered));
  if (!endless.active) return;
  for (std::size_t i = 0; i < lengths_.size(); ++i) {
    if (!std::isinf(lengths_[i])) continue;
    const std::size_t frequency = i / step.distinct.size();
    const WindowedPole window = windowed_pole(endless.angle, wavenumbers_[frequency], face.width);
    FringeKernels current = endless.regular;
    add_product(current, endless.pole, window.value);
    kernels_.set(i, {current, 0.0, 0.0});
    if (window.touched) sums_.windowed[frequency] = true;
  }
}

StripWalk::Projection StripWalk::projection(const StripWave& wave) const {
  Projection result;
  for (int receive = 0; receive < 2; ++receive) {
    const double across = glm::dot(look_.receive[receive], wedges_[wave.wedge].faces[wave.face].into_face);
    const double along = glm::dot(look_.receive[receive], wave.incidence.tangent) / wave.incidence.sin_cone;
    result.across[receive] = wave.sign * across / (2 * pi * wave.incidence.sin_cone);
    result.along[receive] = wave.sign * along / (2 * pi * wave.incidence.sin_cone);
  }
  return result;
}

void StripWalk::weigh(std::span<const Complex> amplitudes, const Step& step) {
  weights_.assign(step.distinct.size(), 0.0);
  for (std::size_t i = 0; i < amplitudes.size(); ++i) weights_[step.kernel[i]] += amplitudes[i];
}

Complex StripWalk::sum(const ComplexColumn& kernels, std::size_t frequency) const {
  return weighted_sum(kernels, frequency * weights_.size(), weights_);
}

void StripWalk::radiate_direct(const StripWave& wave) {
  const std::size_t count = steps_[0].points.size();
  const Projection seen = projection(wave);
  for (std::size_t f = 0; f < wavenumbers_.size(); ++f) {
    weigh(std::span(direct_).subspan(f * count, count), steps_[0]);
    const Complex hard = sum(kernels_.hard, f), axial = wave.incidence.cos_cone * sum(kernels_.axial, f),
                  soft = sum(kernels_.soft, f);
    for (int transmit = 0; transmit < 2; ++transmit) {
      const double magnetic = glm::dot(look_.magnetic[transmit], wave.incidence.tangent);
      const double electric = glm::dot(look_.electric[transmit], wave.incidence.tangent);
      for (int receive = 0; receive < 2; ++receive)
        sums_.first[f].at(receive, transmit) +=
            (seen.across[receive] * hard + seen.along[receive] * axial) * magnetic + seen.along[receive] * soft * electric;
    }
  }
}

void StripWalk::radiate(const StripWave& wave, Step& step) {
  const std::size_t count = step.points.size();
  const Projection seen = projection(wave);
  for (std::size_t f = 0; f < wavenumbers_.size(); ++f)
    for (int transmit = 0; transmit < 2; ++transmit) {
      const auto amplitudes = std::span(step.amplitudes[transmit]).subspan(f * count, count);
      weigh(amplitudes, step);
      const Complex hard = sum(kernels_.hard, f), axial = wave.incidence.cos_cone * sum(kernels_.axial, f);
      for (int receive = 0; receive < 2; ++receive)
        sums_.higher[f].at(receive, transmit) += seen.across[receive] * hard + seen.along[receive] * axial;
    }
  for (int transmit = 0; transmit < 2; ++transmit) {
    step.arriving[transmit].clear();
    for (std::size_t f = 0; f < wavenumbers_.size(); ++f)
      for (std::size_t i = 0; i < count; ++i)
        step.arriving[transmit].push_back(step.amplitudes[transmit][f * count + i] *
                                          kernels_.end[f * step.distinct.size() + step.kernel[i]]);
  }
}

// The hard current arrives with the strips. The soft one flows along the edge; what arrives of it is its component along the
// strips, of the part of the wave whose E lies in the face. The rest is in the plane of incidence: where it grazes, its current
// is that which the hard waves from the other edges take away again, so that passing it on would count it twice.
void StripWalk::excite_far_edges(const StripWave& wave, double share) {
  Step& step = steps_[0];
  const std::size_t count = step.points.size();
  const dvec3 across = glm::cross(wedges_[wave.wedge].faces[wave.face].normal, look_.incident);
  const double squared = glm::dot(across, across);
  const double lying = squared > 0.0 ? glm::dot(across, wave.incidence.tangent) * wave.incidence.cos_cone / squared : 0.0;
  for (int transmit = 0; transmit < 2; ++transmit) {
    const double hard = share * glm::dot(look_.magnetic[transmit], wave.incidence.tangent);
    const double soft = share * glm::dot(look_.electric[transmit], across) * lying;
    step.arriving[transmit].clear();
    for (std::size_t f = 0; f < wavenumbers_.size(); ++f)
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t kernel = f * step.distinct.size() + step.kernel[i];
        step.arriving[transmit].push_back(direct_[f * count + i] *
                                          (hard * kernels_.end[kernel] + soft * kernels_.soft_end[kernel]));
      }
  }
}

// Moves the points from `first` on that leave at the same edge to the next step.
void StripWalk::gather(int level, std::size_t first, const dvec3& direction) {
  Step &from = steps_[level], &to = steps_[level + 1];
  const OutlineEdge* edge = from.exits[first];
  const std::size_t count = from.points.size();
  to.points.clear();
  to.panels.clear();
  for (std::size_t i = first; i < count; ++i) {
    if (from.exits[i] != edge) continue;
    to.points.push_back(from.points[i] + from.lengths[i] * direction);
    to.panels.push_back(from.panels[i]);
  }
  for (int transmit = 0; transmit < 2; ++transmit) {
    to.amplitudes[transmit].clear();
    for (std::size_t f = 0; f < wavenumbers_.size(); ++f)
      for (std::size_t i = first; i < count; ++i)
        if (from.exits[i] == edge) to.amplitudes[transmit].push_back(from.arriving[transmit][f * count + i]);
  }
  for (std::size_t i = first; i < count; ++i)
    if (from.exits[i] == edge) from.exits[i] = nullptr;
}

// In the product of field and length of edge the sine between strip and edge cancels: H dz = -(current) dz_before / 2.
void StripWalk::pass_on(int level, const StripWave& wave) {
  for (std::size_t i = 0; i < steps_[level].points.size(); ++i) {
    const OutlineEdge* edge = steps_[level].exits[i];
    if (!edge) continue;
    const auto next = waves_beyond(wedges_, wave, *edge);
    if (!next) continue;
    gather(level, i, wave.direction);
    for (const StripWave& beyond : *next) follow(level + 1, beyond);
  }
}

}  // namespace raytube
