#include "utd/multiple/multiple_diffraction.h"

#include <algorithm>

#include "scene/frequency_bands.h"
#include "utd/multiple/strip_rays.h"
#include "utd/wedge/work.h"

namespace raytube {

namespace {

std::vector<double> wavenumbers_of(std::span<const double> frequencies) {
  std::vector<double> result;
  for (const double frequency : frequencies) result.push_back(wavenumber(frequency));
  return result;
}

}  // namespace

MultipleDiffraction::MultipleDiffraction(std::span<const Wedge> wedges, const Outlines& outlines, const CurvedFaces* curved,
                                         const LookVectors& look, std::span<const double> frequencies, int order,
                                         bool continue_by_images)
    : scene_{wedges,
             outlines,
             curved,
             look,
             wavelength(sampling_frequency(frequencies)),
             wavelength(least_frequency(frequencies))},
      order_(order),
      band_(wavenumbers_of(frequencies)),
      bins_{PathBins(band_, true), PathBins(band_, true)},
      answer_(bins_.higher),
      strips_{WaveTree(wedges, outlines, curved, look.incident, look.scattered, continue_by_images),
              EdgePanels(wavelength(greatest_frequency(frequencies)))} {
  sums_.windowed.resize(frequencies.size());
}

void MultipleDiffraction::add(std::uint32_t index, const WedgeIncidence& incidence, std::span<const LitInterval> lit) {
  for (int face = 0; face < 2; ++face) {
    const FaceIncidence& arriving = incidence.faces[face];
    if (arriving.sin_cone <= sin_cone_floor) continue;  // along the edge: strips of no width
    start(first_wave(scene_.wedges, index, face, arriving, scene_.look.incident, order_), lit);
  }
}

StripSums MultipleDiffraction::take() {
  sums_.first.resize(band_.wavenumbers().size());
  sums_.higher.resize(band_.wavenumbers().size());
  bins_.first.move_to(sums_.first);
  bins_.higher.move_to(sums_.higher);
  return std::move(sums_);
}

std::vector<ImageEdge> MultipleDiffraction::take_pieces() {
  std::vector<ImageEdge> pieces = std::move(bins_.pieces->curved);
  const std::vector<dvec3>& places = bins_.pieces->places;
  for (std::size_t i = 0; i < places.size(); ++i) pieces.push_back({places[i], places[i], bins_.first.at(i, 0)});
  return pieces;
}

void MultipleDiffraction::count(const StripPath& path, int order) {
  sums_.work += work_of(path) * static_cast<double>(bins_.nodes().size());
  if (rays_ != nullptr) add_rays(path, band_.wavenumbers().front(), order, *rays_);
}

// For unit H along the edge at all wavenumbers, then for what arrives.
void MultipleDiffraction::arrive(const SurfaceArrival& arrival, std::span<const std::size_t> frequencies) {
  const WedgeSide at = scene_.curved->at(arrival.triangle, arrival.corner, arrival.back);
  if (at.wedge == no_index || !scene_.wedges[at.wedge].radiates()) return;
  for (const StripWave& wave : waves_from(scene_, at, arrival.direction, order_)) {
    const StripPath path = strip_path(scene_, wave, arrival.position);
    count(path, 2);
    for (std::size_t n = 0; n < bins_.nodes().size(); ++n) raytube::radiate(path, n, {{1.0}, {}, {}, 0.0}, answer_, answer_);
  }
  answers_.assign(band_.wavenumbers().size(), {});
  answer_.move_to(answers_);
  sums_.higher.resize(answers_.size());
  for (std::size_t f = 0; f < answers_.size(); ++f)
    for (int receive = 0; receive < 2; ++receive)
      for (int transmit = 0; transmit < 2; ++transmit)
        sums_.higher[f].at(receive, transmit) += answers_[f].at(receive, 0) * arrival.magnetic[frequencies[f]][transmit];
}

void MultipleDiffraction::start(const StripWave& wave, std::span<const LitInterval> lit) {
  lay_out_tree(wave, lit);
  const bool runs_along_edge = strips_.tree.runs_along_edge();
  add_tree({true, runs_along_edge ? 0.0 : 1.0});
  if (runs_along_edge) start_beside(wave, lit);
}

// Where neighbouring strips over a curved face end is known only once they are followed: they choose the points.
void MultipleDiffraction::lay_out_tree(const StripWave& wave, std::span<const LitInterval> lit) {
  strips_.tree.grow(wave, lit);
  sums_.work += strips_.tree.work();
  curved_.clear();
  if (strips_.tree.runs_over_curved(wave)) {
    std::vector<PanelPoint> points;
    curved_.push_back(first_curved_strips(scene_, wave, lit, points));
    strips_.panels.take(strips_.tree, std::move(points));
  } else {
    strips_.panels.lay(strips_.tree, lit, scene_.wedges[wave.wedge].length());
  }
  lay_out(scene_, wave, strips_);
  find_curved_waves(scene_, strips_, curved_);
}

// A wave that runs exactly along an edge at the side of a face meets it over its whole length, and yet its strips never end
// there. Turned a little to either side they do, above the limit for
// "exactly along an edge", by an angle [rad] that is small enough for its own square not to count; the limit of a vanishing turn
// is finite, and half of each counts.
void MultipleDiffraction::start_beside(const StripWave& wave, std::span<const LitInterval> lit) {
  const dvec3 aside = glm::cross(scene_.wedges[wave.wedge].faces[wave.face].normal, wave.direction);
  for (const double turn : {-10 * along_edge, 10 * along_edge}) {
    StripWave turned = wave;
    turned.direction = glm::normalize(wave.direction + turn * aside);
    lay_out_tree(turned, lit);
    add_tree({false, 0.5});
  }
}

void MultipleDiffraction::add_tree(const TreeShare& share) {
  if (strips_.tree.bundles().empty()) return;
  for (const std::vector<ArrivedPath>& wave : curved_)
    for (const ArrivedPath& each : wave) count(each.path, 1);
  for (std::size_t f = 0; f < sums_.windowed.size(); ++f)
    if (is_windowed(strips_, band_.wavenumbers()[f])) sums_.windowed[f] = true;
  radiation_.add(strips_, curved_, scene_.look, share, bins_);
  sums_.work += work::strip_point * static_cast<double>(strips_.arriving * bins_.nodes().size());
}

}  // namespace raytube
