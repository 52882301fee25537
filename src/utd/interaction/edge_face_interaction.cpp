#include "utd/interaction/edge_face_interaction.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "scene/frequency_bands.h"
#include "utd/fringe/near_pieces.h"
#include "utd/fringe/reflected_edges.h"
#include "utd/interaction/illumination_rounds.h"
#include "utd/interaction/pair_reach.h"
#include "utd/interaction/penumbra_fringe.h"
#include "utd/interaction/reflected_light.h"
#include "utd/shadow/lit_edges.h"
#include "utd/wedge/work.h"

namespace raytube {

namespace {

// Fringe currents of edges lit by a reflection: the third order no longer shows.
constexpr FringeOptions reflected_fringe{.order = 2, .receiver_shadow = false, .continue_by_images = true};
constexpr double least_tolerance = 1e-4;  // [wavelengths] the rules along the rays are no better; part of the estimate

// Shares of the work: of finding direct light, reflected light, the bounds of pairs, the pairs themselves, and fringe currents
// that reflected light and waves of other edges excite.
constexpr double light_share = 0.15, reflected_share = 0.15, bound_share = 0.1, pair_share = 0.4, fringe_share = 0.1;
constexpr double work_of_fringe = 4 * work::strip_tree;  // price of the fringe currents of a lit piece
constexpr std::size_t edges_at_a_time = 8;               // whose fringe currents are found together where work is limited
// Of its bound that an unknown contribution has, root mean square, and that it has at least (measured: docs).
constexpr double typical_share = 0.1, least_share = 0.01;

LookVectors look_of(const PlaneWave& wave, const LookVectors& look) {
  LookVectors result = look;
  result.incident = wave.direction;
  result.electric = wave.electric;
  for (int q = 0; q < 2; ++q) result.magnetic[q] = glm::cross(wave.direction, wave.electric[q]);
  return result;
}

LookVectors look_from(const NearAntennas& antennas, const dvec3& point) {
  const AntennaRay in = antennas.transmit.ray_to(point), out = antennas.receive->ray_to(point);
  LookVectors look{in.direction, -out.direction, in.field, {}, out.field};
  for (int q = 0; q < 2; ++q) look.magnetic[q] = glm::cross(in.direction, in.field[q]);
  return look;
}

// All waves that light edges in one look, and what these radiate.
class InteractionLook {
 public:
  InteractionLook(const InteractionScene& scene, const Look& look, std::span<const double> frequencies,
                  const InteractionOptions& options)
      : scene_(scene),
        look_(options.antennas ? look_from(*options.antennas, dvec3(0.0)) : look_vectors(look)),
        incident_{look_.incident, look_.electric, 0.0},
        frequencies_(frequencies),
        most_work_(options.work),
        shortest_axis_(scene.shortest_axis) {
    for (const double frequency : frequencies_) wavenumbers_.push_back(wavenumber(frequency));
    if (options.antennas) incident_.antennas = *options.antennas;
  }
  InteractionLook(const InteractionLook&) = delete;

  InteractionResult solve(const InteractionOptions& options) {
    find_light();
    InteractionResult result;
    result.skipped.reflected_pairs = reflected_pairs_left_out_;
    if (!jobs_.empty()) {
      result.scattering.resize(frequencies_.size());
      result.illuminating_pieces = jobs_.size();
      add(illuminate(options, {}, result), result);
      const double fringe_squares = options.order > 1 ? add_fringe(result) + add_penumbra(result) : 0.0;
      estimate_left_out(fringe_squares, result);
    }
    result.work = work_;
    return result;
  }

  // Of the only frequency, each at the place of its path.
  std::vector<ImageEdge> pieces_by_path(const InteractionOptions& options) {
    InteractionResult result;
    find_light();
    if (jobs_.empty()) return {};
    find_places();
    IlluminationSum sum = illuminate(options, {}, result);
    work_ += sum.work;
    std::vector<ImageEdge> pieces = std::move(sum.pieces);
    if (options.order == 1) return pieces;
    take_penumbra_apart(pieces);
    for_each_fringe(1, result, [&](const EdgeLookResult&, auto&&, const auto& looks, const ReflectedWave& wave) {
      for (const ReflectedLook& look : looks)
        std::ranges::copy(reflected_fringe_pieces(scene_.edges, look, frequencies_, reflected_fringe, place_of(wave.patches)),
                          std::back_inserter(pieces));
    });
    return pieces;
  }

  std::vector<ImageEdge> pieces(const InteractionOptions& options, std::size_t frequency_index) {
    std::vector<ImageEdge> images;
    InteractionResult result;
    find_light();
    if (jobs_.empty()) return images;
    const IlluminationSum sum = illuminate(options, frequency_index, result);
    work_ += sum.work;
    for (std::size_t i = 0; i < jobs_.size(); ++i) images.push_back(image_of(*jobs_[i].piece, sum.of_jobs[i]));
    if (options.order == 1) return images;
    add_penumbra(frequency_index, images);
    for_each_fringe(1, result, [&](const EdgeLookResult& part, std::span<const LitEdgePiece> pieces, auto&&...) {
      images.push_back(image_of(pieces.front(), part.scattering[frequency_index] + part.higher[frequency_index]));
    });
    return images;
  }

 private:
  void find_light() {
    find_direct_light();
    find_reflected_light();
    for (const LitEdgePiece& piece : direct_) jobs_.push_back({&piece, most_reflections});
    for (const ReflectedWave& wave : reflected_)
      for (const LitEdgePiece& piece : wave.lit)
        jobs_.push_back({&piece, most_reflections - static_cast<int>(wave.patches.size())});
  }

  static bool has_penumbra(const IlluminationJob& job) { return job.reflections > 0; }

  static ImageEdge image_of(const LitEdgePiece& piece, const ScatteringMatrix& s) {
    const EdgeAxis& axis = *piece.edge;
    return {axis.origin + piece.from * axis.tangent, axis.origin + piece.to * axis.tangent, s};
  }

  // Of the longest edges, where there are more than may be looked at.
  void find_direct_light() {
    keep_longest_axes(light_share * most_work_ / work::edge_light);
    const Viewpoint transmitter =
        incident_.antennas ? Viewpoint::at(incident_.antennas->transmit.position()) : Viewpoint(-look_.incident);
    LitEdges edges(scene_.edges.wedges, scene_.edges.tracer, transmitter, std::nullopt, shortest_wavelength());
    for (const EdgeAxis& axis : scene_.axes)
      if (axis.length >= shortest_axis_) add_direct_light(axis, edges);
  }

  void keep_longest_axes(double most) {
    std::vector<double> lengths;
    for (const EdgeAxis& axis : scene_.axes)
      if (axis.length >= shortest_axis_) lengths.push_back(axis.length);
    if (lengths.empty()) return;
    std::ranges::sort(lengths, std::ranges::greater{});
    const std::size_t count = with_equals(lengths, most);
    work_ += work::edge_light * static_cast<double>(count);
    if (count == lengths.size()) return;
    const auto squares = [](double sum, double length) { return sum + length * length; };
    const auto end = lengths.begin() + static_cast<std::ptrdiff_t>(count);
    left_out_axes_ = std::accumulate(end, lengths.end(), 0.0, squares) / std::accumulate(lengths.begin(), end, 0.0, squares);
    axes_left_out_ = lengths.size() - count;
    shortest_axis_ = lengths[count - 1];
  }

  void add_direct_light(const EdgeAxis& axis, LitEdges& edges) {
    const dvec3 middle = axis.origin + 0.5 * axis.length * axis.tangent;
    const WedgeIncidence incidence = incidence_on(*axis.wedge, incident_.about(middle).direction);
    const double weight = incidence_weight(*axis.wedge, incidence);
    if (weight == 0.0 || !edges.find(static_cast<std::uint32_t>(axis.wedge - scene_.edges.wedges.data()), incidence)) return;
    for (const LitInterval& lit : edges.lit()) {
      const double from = axis.reversed() ? 1.0 - lit.end : lit.begin, to = axis.reversed() ? 1.0 - lit.begin : lit.end;
      direct_.push_back({&axis, &incident_, incidence.faces[0], from * axis.length, to * axis.length, weight});
    }
  }

  void find_reflected_light() {
    ReflectedLight light(scene_.faces, scene_.axes, incident_, shortest_wavelength(), shortest_axis_);
    reflected_ = light.waves(most_reflections, reflected_share * most_work_);
    if (scene_.faces.materials.any())
      for (ReflectedWave& wave : reflected_) weigh_by_surfaces(wave);
    work_ += light.work();
    reflected_pairs_left_out_ = light.pairs_left_out();
  }

  // A wave from an antenna at a finite distance has the weights of the middle of each piece that it lights.
  void weigh_by_surfaces(ReflectedWave& wave) const {
    std::vector<MetFace> mirrors;
    for (const std::uint32_t patch : wave.patches) mirrors.emplace_back(scene_.faces.tree.mesh().patches[patch]);
    if (std::ranges::all_of(mirrors, [](const MetFace& face) { return face.material == no_index; })) return;
    for (LitEdgePiece& piece : wave.lit) {
      const PlaneWave here = wave.wave.about(piece.edge->origin + 0.5 * (piece.from + piece.to) * piece.edge->tangent);
      for (std::size_t f = 0; f < wavenumbers_.size(); ++f)
        piece.by_surfaces.push_back(
            weights_after(scene_.faces.materials, mirrors, here.direction, here.electric, f, wavenumbers_[f]));
    }
  }

  double shortest_wavelength() const { return wavelength(sampling_frequency(frequencies_)); }
  double least() const { return least_tolerance * shortest_wavelength(); }

  // Of the tolerance, for each job.
  double share_of(double tolerance) const { return std::max(tolerance, least()) / std::sqrt(static_cast<double>(jobs_.size())); }

  bool is_limited() const { return most_work_ < std::numeric_limits<double>::infinity(); }

  void add(const IlluminationSum& sum, InteractionResult& result) {
    work_ += sum.work;
    for (std::size_t f = 0; f < frequencies_.size(); ++f) result.scattering[f] += sum.scattering[f];
    result.error.assign(frequencies_.size(), sum.error);
  }

  // All pairs of edge and face, or the strongest of them; what is left out is noted.
  IlluminationSum illuminate(const InteractionOptions& options, std::optional<std::size_t> jobs_at, InteractionResult& result) {
    const IlluminationLook look{scene_.faces, look_, wavenumbers_, least(), places_, jobs_at};
    if (!is_limited()) return illuminate_all(look, jobs_, share_of(options.tolerance));
    const PairLimits limits{{sampling_wavenumber(wavenumbers_), look_.scattered}, options.tolerance, bound_share * most_work_};
    const PairChoice choice = choose_pairs(jobs_, scene_.faces.tree.mesh(), scene_.extents, scene_.faces.by_area, limits);
    work_ += choice.work;
    IlluminationSum sum = illuminate_strongest(look, jobs_, choice.strongest,
                                               {share_of(options.tolerance), pair_share * most_work_ / scene_.price});
    result.pairs = sum.pairs;
    result.skipped.weak_pairs = choice.weak.count;
    result.skipped.pairs = choice.beyond.count + sum.beyond.count + axes_left_out_ * scene_.faces.by_area.size();
    known_squares_ = sum.squares;
    expected_squares_ = sum.bound_squares;
    const double left = sum.beyond.squares + choice.beyond.squares + choice.weak.squares;
    left_out_squares_ = left + left_out_axes_ * (left + sum.bound_squares);
    return sum;
  }

  // What pairs leave out is taken to be as large a share of what is expected of them, root mean square, as with those computed.
  void estimate_left_out(double fringe_squares, InteractionResult& result) const {
    if (left_out_squares_ == 0.0 && fringe_squares == 0.0) return;
    for (std::size_t f = 0; f < frequencies_.size(); ++f) {
      const double known = expected_squares_ > 0.0 ? std::sqrt(known_squares_[f] / expected_squares_) : typical_share;
      const double share = std::max(least_share, known);
      result.left_out.push_back(std::sqrt(share * share * left_out_squares_ + fringe_squares));
    }
  }

  // Of waves reflected once: all at a time, or as long as there is work for them. Returns the sum of squares of what the others
  // may add [m^2].
  double add_fringe(InteractionResult& result) {
    const auto add = [&](const EdgeLookResult& sum, auto&&...) {
      for (std::size_t f = 0; f < frequencies_.size(); ++f) {
        result.scattering[f] += sum.scattering[f];
        result.scattering[f] += sum.higher[f];
      }
    };
    if (is_limited()) return for_each_fringe(edges_at_a_time, result, add);
    std::vector<ReflectedLook> looks;
    for (const ReflectedWave& wave : reflected_)
      if (wave.patches.size() == 1) add_looks(wave, wave.lit, looks);
    const EdgeLookResult sum = fringe(looks);
    work_ += sum.work;
    add(sum);
    return 0.0;
  }

  std::uint32_t index_of(const LitEdgePiece& piece) const {
    return static_cast<std::uint32_t>(piece.edge->wedge - scene_.edges.wedges.data());
  }

  // The looks in which a wave lights its edges: one, or of antennas at a finite distance one for every piece along which their
  // waves are plane.
  void add_looks(const ReflectedWave& wave, std::span<const LitEdgePiece> pieces, std::vector<ReflectedLook>& looks) const {
    if (!wave.wave.antennas) {
      looks.push_back({look_of(wave.wave, look_), wave.wave.path, {}, pieces.front().by_surfaces});
      for (const LitEdgePiece& piece : pieces)
        looks.back().edges.push_back({index_of(piece), {along_wedge(piece)}, piece.weight});
      return;
    }
    for (const LitEdgePiece& piece : pieces)
      for (const NearPiece& part : near_parts(piece, wavenumbers_, scene_.edges.tracer.mesh().radius))
        looks.push_back({part.look, part.path, {{index_of(piece), {{part.begin, part.end}}, piece.weight}}, piece.by_surfaces});
  }

  // Calls use(sum, pieces, looks, wave) for a few lit pieces at a time. Returns what the weaker ones may add that the work does
  // not pay for, as a sum of squares [m^2].
  template <class Use>
  double for_each_fringe(std::size_t at_a_time, InteractionResult& result, Use use) {
    std::vector<double> bounds;
    for (const ReflectedWave& wave : reflected_)
      for (const LitEdgePiece& piece : wave.lit)
        if (wave.patches.size() == 1) bounds.push_back(fringe_bound(piece));
    const double least = least_afforded(std::move(bounds), fringe_share * most_work_ / work_of_fringe);
    double squares = 0.0;
    for (const ReflectedWave& wave : reflected_) {
      if (wave.patches.size() != 1) continue;
      std::vector<LitEdgePiece> strong;
      for (const LitEdgePiece& piece : wave.lit)
        if (fringe_bound(piece) >= least)
          strong.push_back(piece);
        else
          ++result.skipped.fringe_pieces, squares += std::pow(typical_share * fringe_bound(piece), 2);
      for (std::size_t first = 0; first < strong.size(); first += at_a_time) {
        const std::span<const LitEdgePiece> pieces = std::span(strong).subspan(first, std::min(at_a_time, strong.size() - first));
        std::vector<ReflectedLook> looks;
        add_looks(wave, pieces, looks);
        const EdgeLookResult sum = fringe(looks);
        work_ += sum.work;
        use(sum, pieces, looks, wave);
      }
    }
    return squares;
  }

  // The bound of the weakest among so many of the strongest candidates; infinite where not one is paid for.
  static double least_afforded(std::vector<double> bounds, double count) {
    std::ranges::sort(bounds, std::ranges::greater{});
    const std::size_t afforded = with_equals(bounds, count, false);
    return afforded > 0 ? bounds[afforded - 1] : std::numeric_limits<double>::infinity();
  }

  // The same of the fringe currents on the rims of other faces, by waves of edges that light reaches after one reflection at
  // most.
  double add_penumbra(InteractionResult& result) {
    PenumbraFringe penumbra(scene_.edges.tracer, scene_.axes, shortest_axis_, look_, wavenumbers_);
    std::vector<double> bounds;
    double price = 0.0, squares = 0.0;
    for (const IlluminationJob& job : jobs_)
      if (has_penumbra(job)) bounds.push_back(fringe_bound(*job.piece)), price += penumbra.work_of(*job.piece);
    const double count = static_cast<double>(bounds.size());
    const double least = least_afforded(std::move(bounds), price > 0.0 ? fringe_share * most_work_ / price * count : count);
    for (const IlluminationJob& job : jobs_) {
      if (!has_penumbra(job)) continue;
      if (fringe_bound(*job.piece) < least) {
        ++result.skipped.fringe_pieces;
        squares += std::pow(typical_share * fringe_bound(*job.piece), 2);
      } else {
        add_penumbra(penumbra, *job.piece, 0, result.scattering);
      }
    }
    work_ += penumbra.work();
    return squares;
  }

  // At the wavenumbers from `first` on, as many as there are sums.
  void add_penumbra(PenumbraFringe& penumbra, const LitEdgePiece& piece, std::size_t first,
                    std::vector<ScatteringMatrix>& sums) const {
    const auto add_to = [&](std::vector<ScatteringMatrix>& to) {
      penumbra.add(piece, to);
      penumbra.add_step(piece, beyond_smooth_light(piece, penumbra), to);
    };
    if (piece.by_surfaces.empty()) return add_to(sums);
    std::vector<ScatteringMatrix> of_waves(sums.size());
    add_to(of_waves);
    for (std::size_t f = 0; f < sums.size(); ++f) sums[f] += piece.of_transmitter(of_waves[f], first + f);
  }

  // Of reflected light by geometrical optics: all of it, none, and half on the border of its beam, where the wave that goes on
  // from there has no side. Less the share that counts.
  double beyond_smooth_light(const LitEdgePiece& piece, const PenumbraFringe& penumbra) const {
    constexpr double near_border = 0.1;  // saves time alone: more is within 1e-5 rad only of edges 500 of their lengths away
    if (piece.light == 1.0) return 0.0;
    const auto ends_light = [&](const IlluminationJob& job) {
      return has_penumbra(job) && penumbra.ends_along(piece, *job.piece);
    };
    const bool on_border = std::abs(piece.light - 0.5) < near_border && std::ranges::any_of(jobs_, ends_light);
    const double sharp = on_border ? 0.5 : piece.light > 0.5 ? 1.0 : 0.0;
    return piece.weight / piece.light * (sharp - piece.light);
  }

  void add_penumbra(std::size_t frequency_index, std::vector<ImageEdge>& images) const {
    PenumbraFringe penumbra(scene_.edges.tracer, scene_.axes, shortest_axis_, look_,
                            std::span(wavenumbers_).subspan(frequency_index, 1));
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      if (!has_penumbra(jobs_[i])) continue;
      std::vector<ScatteringMatrix> sum(1);
      add_penumbra(penumbra, *jobs_[i].piece, frequency_index, sum);
      images[i].s += sum[0];
    }
  }

  EdgeLookResult fringe(std::span<const ReflectedLook> looks) const {
    return reflected_fringe_scattering(scene_.edges, looks, frequencies_, reflected_fringe);
  }

  PathPlace place_of(std::span<const std::uint32_t> mirrors) const {
    PathPlace place{look_.scattered};
    for (const std::uint32_t patch : mirrors) {
      const Patch& plane = scene_.faces.tree.mesh().patches[patch];
      place.add_mirror(plane.normal, plane.offset);
    }
    return place;
  }

  // In the order of the jobs.
  void find_places() {
    places_.assign(direct_.size(), place_of({}));
    for (const ReflectedWave& wave : reflected_) places_.resize(places_.size() + wave.lit.size(), place_of(wave.patches));
  }

  void take_penumbra_apart(std::vector<ImageEdge>& pieces) const {
    PenumbraFringe penumbra(scene_.edges.tracer, scene_.axes, shortest_axis_, look_, wavenumbers_);
    for (std::size_t i = 0; i < jobs_.size(); ++i)
      if (has_penumbra(jobs_[i])) {
        const LitEdgePiece& piece = *jobs_[i].piece;
        const std::size_t first = pieces.size();
        penumbra.take_apart(piece, places_[i], pieces);
        std::vector<ScatteringMatrix> step(1);
        penumbra.add_step(piece, beyond_smooth_light(piece, penumbra), step);
        const dvec3 middle = piece.edge->origin + 0.5 * (piece.from + piece.to) * piece.edge->tangent,
                    at = places_[i].at(middle, middle,
                                       glm::dot(look_.scattered - piece.wave->direction, middle) - piece.wave->path);
        pieces.push_back({at, at, step[0]});
        for (ImageEdge& of_wave : std::span(pieces).subspan(first)) of_wave.s = piece.of_transmitter(of_wave.s, 0);
      }
  }

  const InteractionScene& scene_;
  LookVectors look_;
  PlaneWave incident_;
  std::span<const double> frequencies_;
  std::vector<LitEdgePiece> direct_;
  std::deque<ReflectedWave> reflected_;
  std::vector<IlluminationJob> jobs_;
  std::vector<PathPlace> places_;  // of jobs; empty unless their pieces are asked for
  double most_work_, work_ = 0.0;
  double shortest_axis_;
  std::vector<double> wavenumbers_;
  std::uint64_t axes_left_out_ = 0, reflected_pairs_left_out_ = 0;
  double left_out_axes_ = 0.0;  // sum of their squared lengths, over that of those looked at
  // Sums of squares [m^2]: of what was computed, per frequency; of what was expected of that; of what is expected of the others.
  std::vector<double> known_squares_;
  double expected_squares_ = 0.0, left_out_squares_ = 0.0;
};

}  // namespace

double reach_of(const InteractionScene& scene, const InteractionOptions& options) {
  return std::isfinite(options.work) ? scene.reach->of(pair_share * options.work / scene.price) : 1.0;
}

InteractionResult interaction_scattering(const InteractionScene& scene, const Look& look, std::span<const double> frequencies,
                                         const InteractionOptions& options) {
  if (scene.axes.empty()) return {};
  return InteractionLook(scene, look, frequencies, options).solve(options);
}

std::vector<ImageEdge> interaction_pieces(const InteractionScene& scene, const Look& look, std::span<const double> frequencies,
                                          std::size_t frequency_index, const InteractionOptions& options, bool by_path) {
  if (scene.axes.empty()) return {};
  InteractionLook of(scene, look, frequencies, options);
  return by_path ? of.pieces_by_path(options) : of.pieces(options, frequency_index);
}

}  // namespace raytube
