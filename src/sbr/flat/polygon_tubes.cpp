#include "sbr/flat/polygon_tubes.h"

#include <cmath>
#include <optional>

#include "sbr/beams/current_map.h"
#include "sbr/beams/truncated_tubes.h"
#include "sbr/flat/polygon_currents.h"

namespace raytube {

namespace {

// How a tube goes on. A narrow one goes as a whole wherever the ray of its middle goes. Beside it runs the ray of another of its
// points, its twin: as long as both meet the same patches, no edge that matters divides the tube.
enum class Course : std::uint8_t {
  cut,       // wide: cut at the edges of what it meets
  alone,     // narrow, without a twin
  together,  // narrow, its twin with it
  parted,    // narrow, its twin elsewhere
  twin       // where that one is, as an error: its currents are not counted
};

// A tube of polygonal cross-section and the beam it travels in, just reflected by a patch.
struct PolygonTube {
  std::uint32_t beam, patch;
  ConvexPolygon outline;
  Course course = Course::cut;
  std::uint32_t corner = 0;  // towards which the twin's point lies
  double stands_for = 1.0;   // as many narrow tubes, with its twin
};

// Share of a cell above which every narrow tube has a twin. The errors of smaller ones hardly count: they have twins in
// proportion to their area.
constexpr double always_with_twin = 0.125;

// Half of the area that is seen from the middle lies nearer to it, half beyond.
dvec2 point_of_twin(const PolygonTube& tube) {
  const dvec2 at = middle(tube.outline);
  return at + std::sqrt(0.5) * (tube.outline[tube.corner % tube.outline.size()].at - at);
}

// With more tubes than this under way, or more faces to meet, tubes smaller than a cell are no longer cut.
constexpr std::size_t many_tubes = 256, many_faces = 2048;

// The tubes of some faces, bounce by bounce: state of trace_faces() and its steps.
struct FaceTrace {
  FaceTrace(const TubeLook& look, BeamVisibility& visible)
      : look_(look),
        beams_(look.faces.mesh(), look.surfaces, look.receive, incident_beam(look.grid, look.transmit, dvec2(0.0))),
        visible_(visible),
        currents_(look, beams_, line_of_sight_) {
    if (look.sheets) line_of_sight_.emplace(*look.sheets, look.faces, look.tracer, visible_, beams_);
  }

  void count_faces_away(std::uint32_t begin, std::uint32_t end) {
    const TriangleMesh& mesh = look_.faces.mesh();
    for (const Face& face : look_.faces.faces().subspan(begin, end - begin))
      if (mesh.closed(face.triangle) && facing(beams_.beam(BeamTree::root), mesh.patches[face.patch]) >= 0.0) ++sums_.faces_away;
  }

  // The ray of each tube's middle, or of its twin's point if it is one; behind them those of the twins that run along.
  void send_rays() {
    rays_.clear();
    const auto send = [&](const PolygonTube& tube, const dvec2& at) {
      rays_.push_back(tube_ray(beams_.beam(tube.beam), at, &look_.faces.mesh().patches[tube.patch], tube.patch));
    };
    for (const PolygonTube& tube : tubes_) send(tube, tube.course == Course::twin ? point_of_twin(tube) : middle(tube.outline));
    for (const PolygonTube& tube : tubes_)
      if (tube.course == Course::together) send(tube, point_of_twin(tube));
    hits_.resize(rays_.size());
    look_.tracer.closest_hits(rays_, hits_, false);
    sums_.rays += rays_.size();
  }

  void follow_all(int bounce) {
    std::size_t next_twin = tubes_.size();
    for (std::size_t i = 0; i < tubes_.size(); ++i) {
      PolygonTube& tube = tubes_[i];
      const std::size_t twin = tube.course == Course::together ? next_twin++ : i;
      if (bounce == look_.max_bounces)
        end(tube, hits_[i]);
      else if (tube.course == Course::cut)
        follow(tube, hits_[i], bounce);
      else
        follow_narrow(tube, i, twin, bounce);
    }
  }

  // Tubes after their last bounce are truncated if their middle would meet something; where there are sheets, all that the whole
  // tube would meet counts.
  void end(const PolygonTube& tube, const Hit& in_middle) {
    if (tube.course == Course::twin) return;
    if (line_of_sight_)
      truncate(tube, in_middle);
    else if (in_middle)
      count_truncated(sums_.truncated[Truncation::bounces], area(tube.outline), beams_.amplitude(tube.beam));
  }

  void follow(const PolygonTube& tube, const Hit& in_middle, int bounce) {
    visible_.from_surface(beams_.beam(tube.beam), tube.patch, tube.outline, in_middle, parts_);
    reflect(tube, bounce);
  }

  void follow_narrow(PolygonTube& tube, std::size_t ray, std::size_t twin, int bounce) {
    if (tube.course == Course::together && patch_at(hits_[twin]) != patch_at(hits_[ray])) {
      tube.course = Course::twin;
      meet_as_a_whole(tube, twin, bounce);
      tube.course = Course::parted;
    }
    meet_as_a_whole(tube, ray, bounce);
  }

  std::uint32_t patch_at(const Hit& hit) const { return hit ? look_.faces.mesh().triangle_patch[hit.triangle] : no_index; }

  // Only a ray that slipped through an edge meets a closed body from inside: then the tube is cut after all.
  void meet_as_a_whole(const PolygonTube& tube, std::size_t ray, int bounce) {
    if (!hits_[ray]) return;
    if (hits_[ray].from_inside) {
      if (tube.course != Course::twin) follow(tube, {}, bounce);
      return;
    }
    parts_.push_back({look_.faces.face_of(hits_[ray].triangle), tube.outline});
    reflect(tube, bounce);
  }

  void truncate(const PolygonTube& tube, const Hit& in_middle) {
    TruncatedSum& sum = sums_.truncated[Truncation::bounces];
    const double before = sum.sigma;
    add_truncated(beams_.beam(tube.beam), tube.patch, tube.outline, in_middle, beams_.amplitude(tube.beam));
    if (sum.sigma > before) ++sum.tubes;
  }

  // What sheets would reflect of a truncated tube, and what it would meet behind them.
  void add_truncated(const Beam& beam, std::uint32_t source_patch, const ConvexPolygon& outline, const Hit& in_middle,
                     double amplitude) {
    std::vector<VisiblePart> parts;
    visible_.from_surface(beam, source_patch, outline, in_middle, parts);
    for (const VisiblePart& part : parts) {
      const std::uint32_t patch = look_.faces.faces()[part.face].patch;
      const dvec3 direction = tube_ray(beam, middle(part.outline), nullptr, no_index).direction;
      const auto [reflected, transmitted] = look_.surfaces.strongest(look_.faces.mesh().patches[patch], direction);
      sums_.truncated[Truncation::bounces].add(area(part.outline), amplitude * reflected);
      if (amplitude * transmitted > least_amplitude) add_truncated(beam, patch, part.outline, {}, amplitude * transmitted);
    }
  }

  // Turns the parts that a tube has met into currents and reflected tubes.
  void reflect(const PolygonTube& tube, int bounce) {
    for (VisiblePart& part : parts_) {
      if (is_left_to_curved(tube.beam, part.face)) continue;
      const std::uint32_t patch = look_.faces.faces()[part.face].patch;
      const std::uint32_t node = beams_.child(tube.beam, patch, middle(part.outline));
      if (tube.course != Course::twin) sums_.meet(bounce, area(part.outline), beams_.amplitude(tube.beam));
      integrate(node, part, bounce, tube);
      const auto send_on = [&](std::uint32_t beam, ConvexPolygon outline) {
        reflected_.push_back({beam, patch, std::move(outline), tube.course, tube.corner, tube.stands_for});
      };
      if (const std::uint32_t through = beams_.through(node); through != no_index) send_on(through, part.outline);
      if (beams_.is_lit(node)) send_on(node, std::move(part.outline));
    }
    parts_.clear();
  }

  // Curved surfaces that the incident wave itself comes to, behind sheets too, are traced as such (sbr/curved).
  bool is_left_to_curved(std::uint32_t beam, std::uint32_t face) const {
    return look_.smooth && !beams_.is_reflected(beam) && look_.smooth->region(look_.faces.faces()[face].triangle) != no_index;
  }

  // Where tubes grow too many, those smaller than a cell are no longer cut.
  void find_narrow() {
    if (!too_many()) return;
    const double cell = look_.grid.du * look_.grid.dv;
    for (PolygonTube& tube : reflected_) {
      if (tube.course != Course::cut || area(tube.outline) >= cell) continue;
      const double probability = std::min(1.0, area(tube.outline) / (always_with_twin * cell));
      twins_due_ += probability;
      tube.course = twins_due_ >= 1.0 ? Course::together : Course::alone;
      if (tube.course == Course::alone) continue;
      twins_due_ -= 1.0;
      tube.corner = twins_++;
      tube.stands_for = 1.0 / probability;
    }
  }

  void end_weakest() {
    // Twins end first.
    const auto weight = [&](const PolygonTube& tube) {
      return tube.course == Course::twin ? 0.0 : area(tube.outline) * beams_.amplitude(tube.beam);
    };
    raytube::end_weakest(reflected_, most_tubes, weight, [&](const PolygonTube& tube) {
      if (tube.course == Course::twin) return;
      count_truncated(sums_.truncated[Truncation::number], area(tube.outline), beams_.amplitude(tube.beam));
    });
  }

  bool too_many() const {
    if (look_.faces.faces().size() > many_faces) return true;
    if (reflected_.size() <= many_tubes) return false;
    double covered = 0.0;
    for (const PolygonTube& tube : reflected_) covered += area(tube.outline);
    return static_cast<double>(reflected_.size()) * look_.grid.du * look_.grid.dv > covered;
  }

  // What a narrow tube and its twin radiate once they have parted is wrong by as much: an edge divides the tube somewhere between
  // its middle and a corner. If it takes the share 1 - x, below one half, of the tube's area, the error is the share 1 - x of
  // both currents, and twins part with the probability 1 - x. Over all x the mean square of the former is 1/12, the mean of the
  // latter 1/4: with phases that are independent, the estimate is sqrt(3) times the error. Where they are not, the sum with all
  // twins in place of their tubes differs by more.
  void integrate(std::uint32_t node, const VisiblePart& part, int bounce, const PolygonTube& tube) {
    const Course course = tube.course;
    if (course != Course::parted && course != Course::twin) return currents_.add(sums_, node, part, bounce, look_.map);
    TubeSums sums;
    currents_.add(sums, node, part, bounce, course == Course::parted ? look_.map : nullptr);
    sums_.pieces.resize(look_.wavenumbers().size());
    for (std::size_t f = 0; f < sums_.pieces.size(); ++f)
      sums_.pieces[f].add(sums.bounces.back()[f], course == Course::parted ? tube.stands_for : -tube.stands_for);
    if (course == Course::parted) sums_.add(sums);
  }

  const TubeLook& look_;
  BeamTree beams_;
  BeamVisibility& visible_;
  std::optional<PolygonLineOfSight> line_of_sight_;  // where there are sheets
  std::vector<VisiblePart> parts_;
  std::vector<PolygonTube> tubes_, reflected_;
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  PolygonCurrents currents_;
  std::uint32_t twins_ = 0;  // number of them so far
  double twins_due_ = 0.5;
  TubeSums sums_;
};

}  // namespace

TubeSums trace_faces(const TubeLook& look, BeamVisibility& visible, std::uint32_t begin, std::uint32_t end) {
  visible.restart();
  FaceTrace trace(look, visible);
  std::vector<std::uint32_t> faces;
  for (std::uint32_t face = begin; face < end; ++face)
    if (!look.smooth || look.smooth->region(look.faces.faces()[face].triangle) == no_index) faces.push_back(face);
  const Beam& incident = trace.beams_.beam(BeamTree::root);
  if (look.convexity.no_shadow)
    visible.of_whole_faces(incident, faces, trace.parts_);
  else
    visible.of_faces(incident, faces, trace.parts_);
  trace.reflect({BeamTree::root, no_index, {}}, 0);
  trace.sums_.rays = trace.sums_.tubes = trace.sums_.hits.empty() ? 0 : trace.sums_.hits[0];
  trace.count_faces_away(begin, end);
  for (int bounce = 1; !look.convexity.no_reflection && !trace.reflected_.empty(); ++bounce) {
    trace.beams_.next_bounce();
    if (bounce < look.max_bounces) trace.find_narrow();
    if (trace.beams_.spectral()) trace.end_weakest();
    std::swap(trace.tubes_, trace.reflected_);
    trace.reflected_.clear();
    trace.send_rays();
    trace.follow_all(bounce);
  }
  trace.sums_.sliver_area = visible.sliver_area();
  return std::move(trace.sums_);
}

}  // namespace raytube
