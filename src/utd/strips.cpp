#include "utd/strips.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raytube {

namespace {

constexpr double same_length = 1e-13;  // relative; strips between parallel edges share their kernels

void add_product(FringeKernels& sum, const FringeKernels& kernels, Complex factor) {
  sum.soft += factor * kernels.soft;
  sum.hard += factor * kernels.hard;
  sum.axial += factor * kernels.axial;
}

}  // namespace

StripWalk::StripWalk(std::span<const Wedge> wedges, const Outlines& outlines, const LookVectors& look,
                     std::span<const double> frequencies, int order)
    : wedges_(wedges),
      outlines_(outlines),
      look_(look),
      order_(order),
      placer_(wedges, outlines, {look.incident, look.scattered, wavelength(*std::ranges::max_element(frequencies)), order}),
      steps_(order) {
  for (const double frequency : frequencies) wavenumbers_.push_back(wavenumber(frequency));
  sums_.first.resize(frequencies.size());
  sums_.higher.resize(frequencies.size());
  sums_.windowed.resize(frequencies.size());
}

void StripWalk::add(std::uint32_t index, const WedgeIncidence& incidence, std::span<const LitInterval> lit) {
  for (int face = 0; face < 2; ++face) {
    const FaceIncidence& arriving = incidence.faces[face];
    if (arriving.sin_cone <= sin_cone_floor) continue;  // along the edge: strips of no width
    start(strip_wave(wedges_, index, face, arriving, 1.0), lit);
    collect(arriving);
  }
}

void StripWalk::start(const StripWave& wave, std::span<const LitInterval> lit) {
  placer_.place(wave, lit, points_);
  const dvec3 difference = look_.scattered - look_.incident;
  Step& step = steps_[0];
  step.points.clear();
  step.panels.clear();
  step.amplitudes.clear();
  for (const EdgePoint& point : points_) {
    step.points.push_back(point.place);
    step.panels.push_back(point.panel);
  }
  for (const double k : wavenumbers_)
    for (const EdgePoint& point : points_)
      step.amplitudes.push_back(std::polar(point.weight, k * glm::dot(difference, point.place)));
  for (auto& responses : responses_) responses.assign(wavenumbers_.size(), {});
  follow(0, wave);
}

void StripWalk::follow(int level, const StripWave& wave) {
  find_ends(steps_[level], wave);
  radiate(level, wave);
  if (level + 1 < order_) pass_on(level, wave);
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

void StripWalk::radiate(int level, const StripWave& wave) {
  const Wedge& wedge = wedges_[wave.wedge];
  const WedgeFace& face = wedge.faces[wave.face];
  const FaceIncidence& incidence = wave.incidence;
  const double half_cosine = glance_half_cosine(face, incidence, look_.scattered);
  find_kernels(Strip(wedge.n, incidence, half_cosine), incidence, steps_[level]);
  if (level == 0) bound_endless(split_kernels(wedge.n, incidence, half_cosine), face.width, steps_[level]);
  steps_[level].arriving.resize(steps_[level].amplitudes.size());
  for (std::size_t f = 0; f < wavenumbers_.size(); ++f) {
    const FringeKernels sum = integrate(f, steps_[level]);
    Response& response = responses_[level == 0 ? 0 : 1][f];
    for (int receive = 0; receive < 2; ++receive) {
      const double across = wave.sign * glm::dot(look_.receive[receive], face.into_face) / (2 * pi * incidence.sin_cone);
      const double along =
          wave.sign * glm::dot(look_.receive[receive], incidence.tangent) / (2 * pi * incidence.sin_cone * incidence.sin_cone);
      response.hard[receive] += across * sum.hard + along * incidence.cos_cone * sum.axial;
      response.soft[receive] += along * sum.soft;
    }
  }
}

// Frequency after frequency, distinct length after distinct length.
void StripWalk::find_kernels(const Strip& strip, const FaceIncidence& incidence, const Step& step) {
  lengths_.clear();
  for (const double k : wavenumbers_)
    for (const double length : step.distinct) lengths_.push_back(k * incidence.sin_cone * incidence.sin_cone * length);
  strip.at(lengths_, kernels_);
}

void StripWalk::bound_endless(const SplitKernels& endless, double face_width, const Step& step) {
  if (!endless.active) return;
  for (std::size_t i = 0; i < lengths_.size(); ++i) {
    if (!std::isinf(lengths_[i])) continue;
    const std::size_t frequency = i / step.distinct.size();
    const WindowedPole window = windowed_pole(endless.angle, wavenumbers_[frequency], face_width);
    FringeKernels current = endless.regular;
    add_product(current, endless.pole, window.value);
    kernels_.set(i, {current, 0.0});
    if (window.touched) sums_.windowed[frequency] = true;
  }
}

FringeKernels StripWalk::integrate(std::size_t frequency, Step& step) {
  const std::size_t count = step.points.size(), first = frequency * step.distinct.size();
  weights_.assign(step.distinct.size(), 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const Complex amplitude = step.amplitudes[frequency * count + i];
    weights_[step.kernel[i]] += amplitude;
    step.arriving[frequency * count + i] = amplitude * kernels_.end[first + step.kernel[i]];
  }
  return {weighted_sum(kernels_.soft, first, weights_), weighted_sum(kernels_.hard, first, weights_),
          weighted_sum(kernels_.axial, first, weights_)};
}

// Moves the points from `first` on that leave at the same edge to the next step.
void StripWalk::gather(int level, std::size_t first, const dvec3& direction) {
  Step &from = steps_[level], &to = steps_[level + 1];
  const OutlineEdge* edge = from.exits[first];
  const std::size_t count = from.points.size();
  to.points.clear();
  to.panels.clear();
  to.amplitudes.clear();
  for (std::size_t i = first; i < count; ++i) {
    if (from.exits[i] != edge) continue;
    to.points.push_back(from.points[i] + from.lengths[i] * direction);
    to.panels.push_back(from.panels[i]);
  }
  for (std::size_t f = 0; f < wavenumbers_.size(); ++f)
    for (std::size_t i = first; i < count; ++i)
      if (from.exits[i] == edge) to.amplitudes.push_back(from.arriving[f * count + i]);
  for (std::size_t i = first; i < count; ++i)
    if (from.exits[i] == edge) from.exits[i] = nullptr;
}

// In the product of field and length of edge the sine between strip and edge cancels: H dz = -(current) dz_before / 2.
void StripWalk::pass_on(int level, const StripWave& wave) {
  for (std::size_t i = 0; i < steps_[level].points.size(); ++i) {
    const OutlineEdge* edge = steps_[level].exits[i];
    if (!edge) continue;
    const auto next = waves_beyond(wedges_, wave, *edge);
    gather(level, i, wave.direction);
    if (next)
      for (const StripWave& beyond : *next) follow(level + 1, beyond);
  }
}

void StripWalk::collect(const FaceIncidence& incidence) {
  for (std::size_t f = 0; f < wavenumbers_.size(); ++f)
    for (int transmit = 0; transmit < 2; ++transmit) {
      const double electric = glm::dot(look_.electric[transmit], incidence.tangent);
      const double magnetic = glm::dot(look_.magnetic[transmit], incidence.tangent);
      for (int receive = 0; receive < 2; ++receive) {
        const Response &first = responses_[0][f], &higher = responses_[1][f];
        sums_.first[f].at(receive, transmit) += first.hard[receive] * magnetic + first.soft[receive] * electric;
        sums_.higher[f].at(receive, transmit) += higher.hard[receive] * magnetic + higher.soft[receive] * electric;
      }
    }
}

}  // namespace raytube
