// A scene of parts traced from one position of the source after the other, by every launch model of its case.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "mesh/model/join.h"
#include "mesh/trace/tracer.h"
#include "point_source/ray_hits.h"
#include "point_source/source_case.h"

namespace raytube {

/// All of a case, position after position.
class SourceTracing {
 public:
  static constexpr std::size_t most_triangles = 4000;  // for exact shares

  /// Reads the parts. Keeps a reference to the case. Throws InputError for a scene or a position that cannot be.
  SourceTracing(const SourceCase& c, int threads);

  /// Throws Interrupted once `progress`, which is told the share done, says false.
  void solve(const std::function<bool(double)>& progress);

  /// Throws InputError if memory cannot hold the hits for the pictures: those of each model's largest launch, three times over
  /// while they are collected. A sample estimates the hits of a ray, and is taken only if their largest number would not fit.
  void check_memory() const;

  const SourceStudy& result() const { return study_; }
  /// Whether the scene is small enough for exact shares: their cost grows with the square of its triangles.
  bool exact() const { return joined_.mesh.triangles.size() <= most_triangles; }

 private:
  LaunchSite site(std::size_t position) const;
  // A source on a surface would see neither that surface nor anything behind it.
  void require_free(std::size_t position) const;
  Launch launch(std::size_t position, LaunchModel model, std::uint64_t rays) const;
  std::vector<VisiblePiece> seen_from(const Eye& eye) const;
  void run_model(std::size_t position, LaunchModel model, const std::vector<VisiblePiece>& seen);
  // Keeps launch points and hits for the pictures: those of the smallest launch, and of the largest.
  void show(const Launch& rays, std::uint64_t asked, std::vector<CountedHit> hits);
  double sampled_hits_per_ray(LaunchModel model) const;
  HitOptions options(bool keep) const;
  void add_exact(const Launch& rays, const std::vector<VisiblePiece>& seen, SourceRun& run);

  const SourceCase& case_;
  JoinedMesh joined_;
  Tracer tracer_;
  Box box_;
  int threads_;
  std::vector<RaySurface> surfaces_;
  std::function<bool(double)> progress_;
  std::size_t finished_ = 0;
  std::optional<std::vector<VisiblePiece>> plane_wave_sees_;
  SourceStudy study_;
};

}  // namespace raytube
