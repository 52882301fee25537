#include "sbr/random_tubes.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "core/random.h"
#include "sbr/beams/spherical_look.h"
#include "sbr/beams/truncated_tubes.h"
#include "sbr/visible/line_of_sight.h"

namespace raytube {

namespace {

constexpr std::uint64_t block_size = 2048;  // most rays traced together and summed by one thread

struct Sample {
  dvec2 at;  // launch coordinates
  std::uint32_t beam;
};

// What all tubes of a look have in common.
struct Scene {
  const Tracer& tracer;
  LaunchGrid rectangle;
  SphericalBasis transmit, receive;
  std::vector<double> wavenumbers;
  std::span<const Material> materials;
  std::optional<LineOfSightSheets> sheets;
  double to_mesh_origin;  // [m], moves the phase reference there from the centre of the mesh
  double area_of_tube;
  const SphericalLook* spherical = nullptr;  // antennas at a finite distance; null: plane waves
};

// What SphericalLook refers to.
struct Antennas {
  Antennas(const Scene& scene, const Look& look, const Radar& radar)
      : pair(look, radar, scene.tracer.mesh().center),
        spherical(pair, incident_beam(scene.rectangle, scene.transmit, dvec2(0.0)), {scene.materials, scene.wavenumbers},
                  no_quadrature) {}
  Antennas(const Antennas&) = delete;

  static constexpr double no_quadrature = 1.0;  // of its tolerance nothing depends
  AntennaPair pair;
  SphericalLook spherical;
};

class Block {
 public:
  explicit Block(const Scene& scene)
      : scene_(scene),
        beams_(scene.tracer.mesh(), {scene.materials, scene.wavenumbers}, scene.receive,
               incident_beam(scene.rectangle, scene.transmit, dvec2(0.0))) {
    sums_.scattering.resize(scene.wavenumbers.size());
    if (scene.sheets) line_of_sight_.emplace(*scene.sheets, scene.tracer);
  }

  void launch(const dvec2& random) {
    const LaunchGrid& r = scene_.rectangle;
    const dvec2 at{r.u_begin + random.x * r.columns * r.du, r.v_begin + random.y * r.rows * r.dv};
    samples_.push_back({at, BeamTree::root});
    if (scene_.spherical) return rays_.push_back(tube_ray(beams_.beam(BeamTree::root), at, nullptr, no_index));
    rays_.push_back({r.plane_origin + at.x * r.u_hat + at.y * r.v_hat, r.direction});
  }

  RandomSums run(int max_bounces) {
    for (int bounce = 0; bounce < max_bounces && !rays_.empty(); ++bounce) advance();
    const std::size_t alive = trace();
    for (std::size_t i = 0; i < alive; ++i) truncate(i, Truncation::bounces);
    return std::move(sums_);
  }

 private:
  // Rays that met a surface from outside come first; returns how many.
  std::size_t trace() {
    hits_.resize(rays_.size());
    scene_.tracer.closest_hits(rays_, hits_);
    sums_.rays += rays_.size();
    std::size_t alive = 0;
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      if (!hits_[i]) continue;
      if (hits_[i].from_inside) {
        ++sums_.lost_rays;
        continue;
      }
      samples_[alive] = samples_[i], rays_[alive] = rays_[i], hits_[alive] = hits_[i];
      ++alive;
    }
    return alive;
  }

  void advance() {
    beams_.next_bounce();
    const std::size_t alive = trace();
    samples_.resize(alive);
    rays_.resize(alive);
    if (alive > 0) sums_.hits.push_back(alive);
    for (std::size_t i = 0; i < alive; ++i) {
      const std::uint32_t patch = scene_.tracer.mesh().triangle_patch[hits_[i].triangle];
      const dvec3 point = rays_[i].origin + hits_[i].distance * rays_[i].direction;
      samples_[i].beam = beams_.child(samples_[i].beam, patch, samples_[i].at);
      rays_[i] = leaving_ray(samples_[i], point, patch);
      add(samples_[i]);
      if (line_of_sight_) line_of_sight_->add(static_cast<std::uint32_t>(i), samples_[i].beam, point, patch);
    }
    if (line_of_sight_)
      sums_.rays += line_of_sight_->through_sheets(beams_, [&](std::uint32_t i, std::uint32_t node) {
        add({samples_[i].at, node});
      });
    send_on(alive);
  }

  Ray leaving_ray(const Sample& sample, const dvec3& point, std::uint32_t patch) const {
    const Beam& beam = beams_.beam(sample.beam);
    if (!scene_.spherical) return {point, beam.direction, patch};
    return tube_ray(beam, sample.at, &beams_.patch(sample.beam), patch);
  }

  void add(const Sample& sample) {
    if (!scene_.spherical) return add(beams_.footprint(sample.beam), sample.at);
    add(scene_.spherical->footprint(beams_.beam(sample.beam), beams_.patch(sample.beam), sample.at, spectrum_), sample.at);
  }

  // Ends the tubes of which nothing was reflected and adds those that go on behind a sheet.
  void send_on(std::size_t count) {
    if (!beams_.spectral()) return;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t through = beams_.through(samples_[i].beam);
      if (through == no_index) continue;
      samples_.push_back({samples_[i].at, through});
      rays_.push_back(leaving_ray(samples_.back(), rays_[i].origin, rays_[i].source_patch));
    }
    std::size_t lit = 0;
    for (std::size_t i = 0; i < samples_.size(); ++i)
      if (beams_.is_lit(samples_[i].beam)) samples_[lit] = samples_[i], rays_[lit++] = rays_[i];
    samples_.resize(lit);
    rays_.resize(lit);
    end_weakest();
  }

  void end_weakest() {
    if (samples_.size() <= most_tubes) return;
    std::vector<std::size_t> kept(samples_.size());
    std::iota(kept.begin(), kept.end(), std::size_t{0});
    raytube::end_weakest(
        kept, most_tubes, [&](std::size_t i) { return beams_.amplitude(samples_[i].beam); },
        [&](std::size_t i) { truncate(i, Truncation::number); });
    for (std::size_t i = 0; i < kept.size(); ++i) samples_[i] = samples_[kept[i]], rays_[i] = rays_[kept[i]];
    samples_.resize(kept.size());
    rays_.resize(kept.size());
  }

  void truncate(std::size_t i, Truncation reason) {
    count_truncated(sums_.truncated[reason], scene_.area_of_tube, beams_.amplitude(samples_[i].beam));
  }

  // Monte Carlo integration of the radiation integral: the value of its integrand times the area that the tube stands for.
  void add(const Footprint& f, const dvec2& at) {
    const dvec2 step = at - f.outgoing.anchor;
    const double path = f.phase + f.phase_u * step.x + f.phase_v * step.y + scene_.to_mesh_origin;
    for (std::size_t i = 0; i < scene_.wavenumbers.size(); ++i) {
      const double k = scene_.wavenumbers[i];
      add_far_field(sums_.scattering[i], f, i, k, std::polar(f.area * scene_.area_of_tube, k * path));
    }
  }

  const Scene& scene_;
  BeamTree beams_;
  std::optional<RayLineOfSight> line_of_sight_;
  std::vector<Sample> samples_;
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  Spectrum spectrum_;  // of one footprint
  RandomSums sums_;
};

Scene scene_of(const Tracer& tracer, const Look& look, std::span<const double> frequencies, const TubeOptions& tubes,
               std::uint64_t samples, std::span<const Material> materials) {
  const TriangleMesh& mesh = tracer.mesh();
  Scene scene{tracer,
              grid_of_look(mesh, look, wavelength(std::ranges::max(frequencies)), 1.0, tubes.up),
              spherical_basis(look.transmit),
              spherical_basis(look.receive),
              {},
              materials,
              {},
              0.0,
              0.0};
  for (const double frequency : frequencies) scene.wavenumbers.push_back(wavenumber(frequency));
  if (look.far()) scene.to_mesh_origin = glm::dot(scene.receive.radial + scene.transmit.radial, mesh.center);
  const LaunchGrid& r = scene.rectangle;
  scene.area_of_tube = static_cast<double>(r.cells()) * r.du * r.dv / static_cast<double>(samples);
  return scene;
}

}  // namespace

RandomSums& RandomSums::operator+=(const RandomSums& other) {
  for (std::size_t i = 0; i < scattering.size(); ++i) scattering[i] += other.scattering[i];
  if (hits.size() < other.hits.size()) hits.resize(other.hits.size());
  for (std::size_t i = 0; i < other.hits.size(); ++i) hits[i] += other.hits[i];
  rays += other.rays, lost_rays += other.lost_rays, truncated += other.truncated;
  return *this;
}

RandomSums random_tubes(const Tracer& tracer, const Look& look, std::span<const double> frequencies, const TubeOptions& tubes,
                        const RandomLaunch& launch, std::span<const Material> materials, const Radar& radar) {
  RandomSums none;
  none.scattering.resize(frequencies.size());
  Scene scene = scene_of(tracer, look, frequencies, tubes, launch.samples, materials);
  if (scene.rectangle.cells() == 0) return none;  // no projected area
  std::optional<Antennas> antennas;
  if (!look.far()) scene.spherical = &antennas.emplace(scene, look, radar).spherical;
  if (std::ranges::any_of(materials, &Material::transmits))
    scene.sheets.emplace(tracer.mesh(), materials, scene.receive, antennas ? &antennas->pair.receive : nullptr);
  using Indices = tbb::blocked_range<std::uint64_t>;
  // Divided and joined at the same indices whichever thread works: their number never shows in the sum.
  return tbb::parallel_deterministic_reduce(
      Indices(0, launch.samples, block_size), none,
      [&](const Indices& range, RandomSums sum) {
        Block block(scene);
        for (std::uint64_t i = range.begin(); i != range.end(); ++i) block.launch(random_point(launch.seed, launch.stream, i));
        return sum += block.run(tubes.max_bounces);
      },
      [](RandomSums a, const RandomSums& b) { return a += b; });
}

}  // namespace raytube
