#include "utd/multiple/multiple_diffraction.h"

#include <algorithm>

#include "core/work.h"
#include "utd/multiple/strip_rays.h"

namespace raytube {

namespace {

// [rad] Above the limit for "exactly along an edge", and small enough for its own square not to count.
constexpr double small_turn = 10 * along_edge;

std::vector<double> wavenumbers_of(std::span<const double> frequencies) {
  std::vector<double> result;
  for (const double frequency : frequencies) result.push_back(wavenumber(frequency));
  return result;
}

template <class Factor>
ScatteringMatrix scaled(ScatteringMatrix matrix, Factor factor) {
  for (auto& row : matrix.s)
    for (Complex& value : row) value *= factor;
  return matrix;
}

}  // namespace

MultipleDiffraction::MultipleDiffraction(std::span<const Wedge> wedges, const Outlines& outlines, const CurvedFaces* curved,
                                         const LookVectors& look, std::span<const double> frequencies, int order,
                                         TransitionTier tier, bool continue_by_images)
    : scene_{wedges, outlines, curved, look, wavelength(std::ranges::max(frequencies)), wavelength(std::ranges::min(frequencies)),
             tier},
      order_(order),
      band_(wavenumbers_of(frequencies)),
      strips_{WaveTree(wedges, outlines, curved, look.incident, look.scattered, continue_by_images),
              EdgePanels(scene_.shortest)} {
  sums_.first.resize(frequencies.size());
  sums_.higher.resize(frequencies.size());
  sums_.windowed.resize(frequencies.size());
}

void MultipleDiffraction::add(std::uint32_t index, const WedgeIncidence& incidence, std::span<const LitInterval> lit) {
  const bool curved = scene_.curved != nullptr && (scene_.curved->curved(index, 0) || scene_.curved->curved(index, 1));
  for (int face = 0; face < 2; ++face) {
    const FaceIncidence& arriving = incidence.faces[face];
    if (arriving.sin_cone <= sin_cone_floor) continue;  // along the edge: strips of no width
    const StripWave wave = first_wave(scene_.wedges, index, face, arriving, scene_.look.incident, order_);
    if (curved)
      start_curved(wave, lit);
    else
      start(wave, lit);
  }
}

void MultipleDiffraction::start_curved(const StripWave& wave, std::span<const LitInterval> lit) {
  const IncidentFields incident = incident_fields(scene_, wave);
  const dvec3 difference = scene_.look.scattered - scene_.look.incident;
  for (const WeightedPath& each : strip_paths(scene_, wave, lit)) {
    const double way = glm::dot(difference, each.path.start);
    count(each.path, 1);
    for (std::size_t f = 0; f < band_.wavenumbers().size(); ++f) {
      const double k = band_.wavenumbers()[f];
      const Complex phase = std::polar(each.weight, k * way);
      StripStart at{};
      for (int t = 0; t < 2; ++t) {
        at.magnetic[t] = incident.magnetic[t] * phase;
        at.electric[t] = incident.electric[t] * phase;
        at.lying[t] = incident.lying[t] * phase;
      }
      raytube::radiate(each.path, k, at, sums_.first[f], sums_.higher[f]);
    }
  }
}

void MultipleDiffraction::count(const StripPath& path, int order) {
  sums_.work += work_of(path) * static_cast<double>(band_.wavenumbers().size());
  if (rays_ != nullptr) add_rays(path, band_.wavenumbers().front(), order, *rays_);
}

void MultipleDiffraction::arrive(const SurfaceArrival& arrival, std::span<const std::size_t> frequencies) {
  const WedgeSide at = scene_.curved->at(arrival.triangle, arrival.corner, arrival.back);
  if (at.wedge == no_index || !scene_.wedges[at.wedge].radiates()) return;
  for (const StripWave& wave : waves_from(scene_, at, arrival.direction, order_)) {
    const StripPath path = strip_path(scene_, wave, arrival.position);
    count(path, 2);
    for (std::size_t f = 0; f < band_.wavenumbers().size(); ++f)
      raytube::radiate(path, band_.wavenumbers()[f], {arrival.magnetic[frequencies[f]], {}, {}}, sums_.higher[f],
                       sums_.higher[f]);
  }
}

void MultipleDiffraction::start(const StripWave& wave, std::span<const LitInterval> lit) {
  lay_out(scene_, wave, lit, strips_);
  sums_.work += strips_.tree.work();
  const bool runs_along_edge = strips_.tree.runs_along_edge();
  add_tree({true, runs_along_edge ? 0.0 : 1.0});
  if (runs_along_edge) start_beside(wave, lit);
}

// A wave that runs exactly along an edge at the side of a face meets it over its whole length, and yet its strips never end
// there. Turned a little to either side they do; the limit of a vanishing turn is finite, and half of each counts.
void MultipleDiffraction::start_beside(const StripWave& wave, std::span<const LitInterval> lit) {
  const dvec3 aside = glm::cross(scene_.wedges[wave.wedge].faces[wave.face].normal, wave.direction);
  for (const double turn : {-small_turn, small_turn}) {
    StripWave turned = wave;
    turned.direction = glm::normalize(wave.direction + turn * aside);
    lay_out(scene_, turned, lit, strips_);
    sums_.work += strips_.tree.work();
    add_tree({false, 0.5});
  }
}

// Of many frequencies a few are computed and the others interpolated, but not where the kernels are rough or change with k in
// ways of their own.
void MultipleDiffraction::add_tree(const TreeShare& share) {
  if (strips_.tree.bundles().empty()) return;
  find_curved_waves(scene_, strips_, curved_);
  if (rays_ != nullptr)
    for (const std::vector<StripPath>& wave : curved_)
      for (const StripPath& path : wave) add_rays(path, band_.wavenumbers().front(), 1, *rays_);
  for (std::size_t f = 0; f < sums_.windowed.size(); ++f)
    if (is_windowed(strips_, band_.wavenumbers()[f])) sums_.windowed[f] = true;
  const std::span<const PathRange> paths = paths_.find(strips_.tree, scene_.look);
  const auto is_thin = [](const WaveFace& face) { return face.thin.has_value(); };
  const bool smooth = std::ranges::all_of(curved_, [](const auto& strips) { return strips.empty(); }) &&
                      scene_.tier == TransitionTier::exact && std::ranges::none_of(strips_.faces, is_thin);
  const double half_span = std::ranges::max_element(paths, {}, &PathRange::half)->half();
  if (const ChebyshevNodes* nodes = smooth ? band_.nodes_of_fresnel(half_span) : nullptr)
    interpolate(*nodes, paths, share);
  else
    add_all(share);
}

std::size_t MultipleDiffraction::radiating_waves(const TreeShare& share) const {
  return share.higher > 0.0 ? strips_.tree.waves().size() : 1;
}

void MultipleDiffraction::add_all(const TreeShare& share) {
  sums_at_.clear();
  for (std::size_t w = 0; w < radiating_waves(share); ++w) sums_at_.push_back(sums_of(w));
  radiate(band_.wavenumbers(), share);
}

void MultipleDiffraction::radiate(std::span<const double> wavenumbers, const TreeShare& share) {
  radiation_.add(strips_, curved_, scene_.look, wavenumbers, share, sums_at_);
  sums_.work += work::strip_point * static_cast<double>(strips_.arriving * wavenumbers.size());
}

// The phase of the middle of a wave's paths is taken out at the nodes and put back.
void MultipleDiffraction::interpolate(const ChebyshevNodes& nodes, std::span<const PathRange> paths, const TreeShare& share) {
  const std::size_t waves = radiating_waves(share);
  samples_.resize(std::max(samples_.size(), waves));
  sums_at_.clear();
  for (std::size_t w = 0; w < waves; ++w) {
    samples_[w].assign(nodes.at.size(), {});
    sums_at_.push_back(samples_[w]);
  }
  radiate(nodes.at, share);
  for (std::size_t w = share.first ? 0 : 1; w < waves; ++w) {
    for (std::size_t n = 0; n < nodes.at.size(); ++n)
      samples_[w][n] = scaled(samples_[w][n], std::polar(1.0, -nodes.at[n] * paths[w].middle()));
    add_interpolated(nodes, w, paths[w].middle());
  }
}

void MultipleDiffraction::add_interpolated(const ChebyshevNodes& nodes, std::size_t wave, double path) {
  const std::span<ScatteringMatrix> sums = sums_of(wave);
  auto weight = nodes.weights.begin();
  for (std::size_t f = 0; f < sums.size(); ++f) {
    ScatteringMatrix value;
    for (const ScatteringMatrix& sample : samples_[wave]) value += scaled(sample, *weight++);
    sums[f] += scaled(value, std::polar(1.0, band_.wavenumbers()[f] * path));
  }
}

}  // namespace raytube
