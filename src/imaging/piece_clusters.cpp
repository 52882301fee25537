#include "imaging/piece_clusters.h"

#include <array>
#include <map>

namespace raytube {

void PieceCluster::add(const dvec3& place, const ScatteringPiece& piece) {
  const double size = frobenius_norm(piece.s);
  at += size * place, amplitude += size, s += piece.s;
  if (size > strongest) strongest = size, triangle = piece.triangle;
}

std::vector<PieceCluster> clusters_of(const std::vector<ScatteringPiece>& pieces, const LookAxes& axes, double side) {
  constexpr double to_a_side = 8.0;
  std::map<std::array<std::int64_t, 4>, std::size_t> known;
  std::vector<PieceCluster> clusters;
  for (const ScatteringPiece& piece : pieces) {
    const dvec3 place(glm::dot(piece.place, axes.range), glm::dot(piece.place, axes.cross_range),
                      glm::dot(piece.place, axes.height));
    const dvec3 cell = glm::floor(place * to_a_side / side);
    const std::array<std::int64_t, 4> key{static_cast<std::int64_t>(cell.x), static_cast<std::int64_t>(cell.y),
                                          static_cast<std::int64_t>(cell.z), static_cast<std::int64_t>(piece.mechanism)};
    const auto [found, is_new] = known.try_emplace(key, clusters.size());
    if (is_new) clusters.emplace_back().mechanism = piece.mechanism;
    clusters[found->second].add(place, piece);
  }
  std::erase_if(clusters, [](const PieceCluster& each) { return each.amplitude == 0.0; });
  for (PieceCluster& each : clusters) each.at /= each.amplitude;
  return clusters;
}

double hann_response(double x, double side) {
  const double t = x / side;
  if (std::abs(t) >= response_reach) return 0.0;
  if (std::abs(t) < 1e-9) return 1.0;
  if (std::abs(std::abs(t) - 1.0) < 1e-9) return 0.5;
  return std::sin(pi * t) / (pi * t * (1.0 - t * t));
}

double hann_response(const dvec3& x, double side) {
  return hann_response(x.x, side) * hann_response(x.y, side) * hann_response(x.z, side);
}

double even_response(const dvec3& x, double side) {
  return sinc(pi * x.x / side) * sinc(pi * x.y / side) * sinc(pi * x.z / side);
}

}  // namespace raytube
