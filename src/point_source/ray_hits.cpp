#include "point_source/ray_hits.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "core/progress.h"
#include "core/threads.h"

namespace raytube {

namespace {

constexpr std::uint64_t batch_size = 2048;

std::vector<PartHits> no_hits(std::size_t parts) {
  PartHits none;
  none.estimate = none.response = 0.0;
  return std::vector<PartHits>(parts, none);
}

// Bits of the three coordinates in turn: of an octant of the sphere, of an eighth of it, and so on.
std::uint64_t interleaved(const dvec3& direction) {
  const glm::uvec3 cell(7.999 * (0.5 * direction + 0.5));
  std::uint64_t bits = 0;
  for (int level = 2; level >= 0; --level)
    for (int axis = 0; axis < 3; ++axis) bits = bits << 1 | (cell[axis] >> level & 1u);
  return bits;
}

// Random rays in an order in which neighbours have nearly one direction, which makes them faster to trace.
void sort_by_direction(std::vector<LaunchedRay>& rays) {
  std::vector<std::uint64_t> keys;
  keys.reserve(rays.size());
  for (std::uint64_t i = 0; i < rays.size(); ++i) keys.push_back(interleaved(rays[i].ray.direction) << 32 | i);
  std::ranges::sort(keys);
  std::vector<LaunchedRay> sorted;
  for (const std::uint64_t key : keys) sorted.push_back(rays[key & 0xffffffffu]);
  rays = std::move(sorted);
}

// One batch of rays from launch to end.
class Batch {
 public:
  Batch(const Tracer& tracer, std::span<const std::uint32_t> triangle_part, std::span<const RaySurface> surfaces,
        const Launch& launch, const HitOptions& options)
      : tracer_(tracer), triangle_part_(triangle_part), surfaces_(surfaces), launch_(launch), options_(options) {
    result_.parts = no_hits(surfaces.size());
    squares_.resize(surfaces.size());
  }

  void run(std::uint64_t first, std::uint64_t count) {
    std::vector<LaunchedRay> launched;
    for (std::uint64_t i = 0; i < count; ++i) launched.push_back(launch_.ray(first + i));
    if (launch_.model() == LaunchModel::random) sort_by_direction(launched);
    for (const LaunchedRay& one : launched) rays_.push_back(one.ray);
    hits_.resize(count);
    tracer_.closest_hits(rays_, hits_);
    for (std::uint64_t i = 0; i < count; ++i) count_first(launched[i], hits_[i]);
    for (int bounce = 0; !rays_.empty(); ++bounce) {
      if (bounce > 0) tracer_.closest_hits(rays_, std::span(hits_).first(rays_.size()));
      go_on(bounce);
    }
  }

  RayHits& result() { return result_; }
  const std::vector<double>& squares() const { return squares_; }

 private:
  void count_first(const LaunchedRay& launched, const Hit& hit) {
    const bool own = launched.aimed == no_index || launched.aimed == hit.triangle;
    weights_.push_back(hit && own && !launch_.eye().direction ? launch_.weight(launched) : 0.0);
    if (!hit) {
      ++result_.missed;
      return;
    }
    const std::uint32_t part = triangle_part_[hit.triangle];
    ++result_.parts[part].first_hits;
    result_.parts[part].estimate += weights_.back();
    squares_[part] += weights_.back() * weights_.back();
  }

  // Counts the hits of all rays still on their way, in their order, and keeps those that go on.
  void go_on(int bounce) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      const Hit& hit = hits_[i];
      if (!hit) {
        ++result_.escaped;
        continue;
      }
      const std::uint32_t part = triangle_part_[hit.triangle];
      const dvec3 point = rays_[i].origin + hit.distance * rays_[i].direction;
      ++result_.parts[part].all_hits;
      result_.parts[part].response += weights_[i];
      if (options_.keep_hits && part == options_.counted) result_.hits.push_back({point, static_cast<std::uint32_t>(bounce)});
      if (surfaces_[part] == RaySurface::absorber)
        ++result_.absorbed;
      else if (bounce >= options_.max_reflections)
        ++result_.cut;
      else
        keep(i, kept++, hit, point);
    }
    rays_.resize(kept);
  }

  void keep(std::size_t i, std::size_t slot, const Hit& hit, const dvec3& point) {
    const std::uint32_t patch = tracer_.mesh().triangle_patch[hit.triangle];
    const dvec3 normal = tracer_.mesh().patches[patch].normal, direction = rays_[i].direction;
    rays_[slot] = {point, glm::normalize(direction - 2.0 * glm::dot(direction, normal) * normal), patch};
    weights_[slot] = weights_[i];
  }

  const Tracer& tracer_;
  std::span<const std::uint32_t> triangle_part_;
  std::span<const RaySurface> surfaces_;
  const Launch& launch_;
  const HitOptions& options_;
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  std::vector<double> weights_;  // of the rays
  RayHits result_;
  std::vector<double> squares_;  // of the weights of first hits
};

void add(const PartHits& part, PartHits& sum) {
  sum.first_hits += part.first_hits;
  sum.all_hits += part.all_hits;
  sum.estimate += part.estimate;
  sum.response += part.response;
}

void add(RayHits&& batch, RayHits& sum) {
  for (std::size_t part = 0; part < sum.parts.size(); ++part) add(batch.parts[part], sum.parts[part]);
  sum.escaped += batch.escaped;
  sum.absorbed += batch.absorbed;
  sum.cut += batch.cut;
  sum.missed += batch.missed;
  sum.hits.insert(sum.hits.end(), batch.hits.begin(), batch.hits.end());
}

// Four standard deviations of a sum of independent weights: sum w^2 - (sum w)^2 / N.
double sampled_bound(double estimate, double squares, double rays) {
  return 4.0 * std::sqrt(std::max(0.0, squares - estimate * estimate / rays));
}

}  // namespace

RayHits trace_rays(const Tracer& tracer, std::span<const std::uint32_t> triangle_part, std::span<const RaySurface> surfaces,
                   const Launch& launch, const HitOptions& options) {
  const std::uint64_t batches = (launch.rays() + batch_size - 1) / batch_size;
  std::vector<RayHits> results(batches);
  std::vector<std::vector<double>> squares(batches);
  Progress progress(options.progress);
  run_on_threads(options.threads, [&] {
    tbb::parallel_for(std::uint64_t{0}, batches, [&](std::uint64_t i) {
      Batch batch(tracer, triangle_part, surfaces, launch, options);
      const std::uint64_t first = i * batch_size;
      batch.run(first, std::min(batch_size, launch.rays() - first));
      squares[i] = batch.squares();
      results[i] = std::move(batch.result());
      progress.add(1.0 / static_cast<double>(batches));
    });
  });
  RayHits sum;
  sum.parts = no_hits(surfaces.size());
  std::vector<double> square_sum(surfaces.size(), 0.0);
  for (std::uint64_t i = 0; i < batches; ++i) {
    for (std::size_t part = 0; part < surfaces.size(); ++part) square_sum[part] += squares[i][part];
    add(std::move(results[i]), sum);
  }
  if (launch.eye().direction)
    for (PartHits& part : sum.parts) part.estimate = part.response = not_known;
  if (launch.model() == LaunchModel::random)
    for (std::size_t part = 0; part < surfaces.size(); ++part)
      sum.parts[part].estimate_bound =
          sampled_bound(sum.parts[part].estimate, square_sum[part], static_cast<double>(launch.rays()));
  return sum;
}

}  // namespace raytube
