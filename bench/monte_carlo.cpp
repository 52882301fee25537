#include "monte_carlo.h"

#include <tbb/parallel_for.h>

#include "sbr/beam_tree.h"
#include "timing.h"

namespace raytube::bench {

namespace {

constexpr std::uint64_t block_size = 2048;  // rays traced together and summed by one thread

// Number `counter` of the splitmix64 sequence that starts at `stream` (Steele, Lea & Flood 2014), in [0, 1). A counter instead of
// a state: any thread draws any ray.
double drawn(std::uint64_t stream, std::uint64_t counter) {
  std::uint64_t z = stream + (counter + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

struct Sample {
  dvec2 place;  // in the launch plane
  std::uint32_t beam;
};

struct BlockSum {
  ScatteringMatrix scattering;
  std::uint64_t rays = 0;
};

class Block {
 public:
  Block(const Tracer& tracer, const LaunchGrid& grid, const Look& look, double k, double area_of_ray)
      : tracer_(tracer),
        grid_(grid),
        receive_(spherical_basis(look.receive)),
        beams_(tracer.mesh(), receive_, incident_beam(grid, spherical_basis(look.transmit), dvec2(0.0))),
        k_(k),
        area_of_ray_(area_of_ray) {}

  void launch(double across, double along) {
    const dvec2 place{grid_.u_begin + across * grid_.columns * grid_.du, grid_.v_begin + along * grid_.rows * grid_.dv};
    samples_.push_back({place, BeamTree::root});
    rays_.push_back({grid_.plane_origin + place.x * grid_.u_hat + place.y * grid_.v_hat, grid_.direction});
  }

  BlockSum run(int max_bounces) {
    for (int bounce = 0; bounce <= max_bounces && !rays_.empty(); ++bounce) advance(bounce < max_bounces);
    return sum_;
  }

 private:
  void advance(bool counts) {
    hits_.resize(rays_.size());
    tracer_.closest_hits(rays_, hits_);
    sum_.rays += rays_.size();
    std::size_t alive = 0;
    for (std::size_t i = 0; counts && i < rays_.size(); ++i) {
      if (!hits_[i] || from_inside(rays_[i], hits_[i])) continue;
      const std::uint32_t patch = tracer_.mesh().triangle_patch[hits_[i].triangle],
                          beam = beams_.child(samples_[i].beam, patch, samples_[i].place);
      const dvec3 point = rays_[i].origin + hits_[i].distance * rays_[i].direction;
      samples_[alive] = {samples_[i].place, beam};
      rays_[alive++] = {point, beams_.beam(beam).direction, patch};
      add(beams_.footprint(beam), samples_[alive - 1].place);
    }
    samples_.resize(alive);
    rays_.resize(alive);
  }

  bool from_inside(const Ray& ray, const Hit& hit) const {
    const TriangleMesh& mesh = tracer_.mesh();
    return mesh.closed(hit.triangle) && glm::dot(mesh.patches[mesh.triangle_patch[hit.triangle]].normal, ray.direction) > 0.0;
  }

  void add(const Footprint& f, const dvec2& place) {
    const dvec2 step = place - f.outgoing.anchor;
    const Complex sample = std::polar(f.area * area_of_ray_, k_ * (f.phase + f.phase_u * step.x + f.phase_v * step.y));
    add_far_field(sum_.scattering, f, k_, sample);
  }

  const Tracer& tracer_;
  const LaunchGrid& grid_;
  SphericalBasis receive_;
  BeamTree beams_;  // refers to receive_
  double k_, area_of_ray_;
  std::vector<Sample> samples_;
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  BlockSum sum_;
};

// In block order, whoever traced them; phase reference moved from the centre of the mesh to the origin of its coordinates.
BlockSum added_up(const std::vector<BlockSum>& blocks, const Look& look, double k, const dvec3& center) {
  BlockSum sum;
  for (const BlockSum& block : blocks) sum.scattering += block.scattering, sum.rays += block.rays;
  const dvec3 change = spherical_basis(look.receive).radial + spherical_basis(look.transmit).radial;
  for (auto& row : sum.scattering.s)
    for (Complex& value : row) value *= std::polar(1.0, k * glm::dot(change, center));
  return sum;
}

BlockSum one_look(const Target& target, const Look& look, double frequency, int max_bounces, std::uint64_t launched,
                  std::uint64_t stream) {
  const LaunchGrid grid = launch_grid(target.mesh, look.transmit, wavelength(frequency), 1.0, std::nullopt);
  const double area = static_cast<double>(grid.cells()) * grid.du * grid.dv, k = wavenumber(frequency);
  std::vector<BlockSum> blocks((launched + block_size - 1) / block_size);
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
    Block block(target.tracer, grid, look, k, area / static_cast<double>(launched));
    for (std::uint64_t i = b * block_size; i < std::min((b + 1) * block_size, launched); ++i)
      block.launch(drawn(stream, 2 * i), drawn(stream, 2 * i + 1));
    blocks[b] = block.run(max_bounces);
  });
  return added_up(blocks, look, k, target.mesh.center);
}

}  // namespace

MonteCarlo monte_carlo(const Target& target, const Sweep& sweep, int max_bounces, std::uint64_t launched, std::uint64_t seed,
                       int threads) {
  std::vector<BlockSum> looks(sweep.looks.size());
  const auto start = Clock::now();
  on_threads(threads, [&] {
    tbb::parallel_for(std::size_t{0}, looks.size(), [&](std::size_t i) {
      // The step of the sequence is odd, so streams that start a multiple of 2^32 apart share none of their first 2^32 numbers.
      const std::uint64_t stream = (seed * sweep.looks.size() + i) << 32;
      looks[i] = one_look(target, sweep.looks[i], sweep.frequencies.front(), max_bounces, launched, stream);
    });
  });
  MonteCarlo result;
  result.seconds = seconds_since(start);
  for (const BlockSum& look : looks) {
    result.scattering.push_back(look.scattering);
    result.rays += look.rays;
  }
  return result;
}

}  // namespace raytube::bench
