#include "sbr/beams/tube_sums.h"

#include <algorithm>

namespace raytube {

namespace {

template <class Values>
void add_at(Values& sum, std::size_t index, const typename Values::value_type& value) {
  if (sum.size() <= index) sum.resize(index + 1);
  sum[index] += value;
}

}  // namespace

void ErrorSum::add(const ScatteringMatrix& error, double count) {
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) {
      coherent.at(p, q) += count * error.at(p, q);
      squares[p][q] += std::abs(count) * std::norm(error.at(p, q));
    }
}

ErrorSum& ErrorSum::operator+=(const ErrorSum& other) {
  coherent += other.coherent;
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) squares[p][q] += other.squares[p][q];
  return *this;
}

std::vector<ScatteringMatrix>& TubeSums::at(int bounce, std::size_t frequencies) {
  const auto b = static_cast<std::size_t>(bounce);
  while (bounces.size() <= b) bounces.emplace_back(frequencies);
  if (hits.size() <= b) hits.resize(b + 1);
  return bounces[b];
}

std::vector<ScatteringMatrix> TubeSums::bounces_at(std::size_t frequency) const {
  std::vector<ScatteringMatrix> result;
  for (const std::vector<ScatteringMatrix>& bounce : bounces) result.push_back(bounce[frequency]);
  return result;
}

ScatteringMatrix TubeSums::total(std::size_t frequency) const {
  ScatteringMatrix sum;
  for (const std::vector<ScatteringMatrix>& bounce : bounces) sum += bounce[frequency];
  return sum;
}

void TubeSums::meet(int bounce, double area, double amplitude) {
  add_at(met, static_cast<std::size_t>(bounce), area * amplitude * amplitude);
}

void TubeSums::lose(const Ray& ray, std::uint32_t triangle, const TriangleMesh& mesh) {
  if (lost_rays++ >= most_lost_rays_told) return;
  first_lost.push_back({ray.origin + mesh.patch_of(triangle).distance(ray.origin, ray.direction) * ray.direction, triangle});
}

void TubeSums::lose_if_stray(const Ray& ray, const TriangleMesh& mesh) {
  if (is_finite(ray) || lost_rays++ >= most_lost_rays_told) return;
  const auto of_patch = std::ranges::find(mesh.triangle_patch, ray.source_patch);
  const bool known = of_patch != mesh.triangle_patch.end();
  first_lost.push_back({ray.origin, known ? static_cast<std::uint32_t>(of_patch - mesh.triangle_patch.begin()) : 0});
}

void TubeSums::add_incoherent(const Spectrum& spectrum, double area) {
  incoherent.resize(std::max(incoherent.size(), spectrum.size()));
  for (std::size_t f = 0; f < spectrum.size(); ++f)
    for (std::size_t q = 0; q < 2; ++q) incoherent[f][q] += area * spectrum[f].incoherent[q];
}

void TubeSums::add_inside(std::size_t frequency, std::size_t frequencies, const WavesInside& waves) {
  inside.resize(frequencies);
  inside[frequency] += waves;
}

void TubeSums::compare_with(const std::array<std::vector<ScatteringMatrix>, coarse_grids>& coarse_sums) {
  coarse.assign(coarse_sums[0].size(), {});
  for (std::size_t f = 0; f < coarse.size(); ++f) {
    ScatteringMatrix fine;
    for (const std::vector<ScatteringMatrix>& bounce : bounces) fine += bounce[f];
    for (int grid = 0; grid < coarse_grids; ++grid) coarse[f][grid].add(fine - coarse_sums[grid][f]);
  }
}

void TubeSums::add(const TubeSums& other) {
  for (std::size_t b = 0; b < other.bounces.size(); ++b) {
    if (bounces.size() <= b) bounces.emplace_back(other.bounces[b].size());
    for (std::size_t f = 0; f < other.bounces[b].size(); ++f) bounces[b][f] += other.bounces[b][f];
    add_at(hits, b, other.hits[b]);
  }
  coarse.resize(std::max(coarse.size(), other.coarse.size()));
  for (std::size_t f = 0; f < other.coarse.size(); ++f)
    for (int grid = 0; grid < coarse_grids; ++grid) coarse[f][grid] += other.coarse[f][grid];
  for (std::size_t f = 0; f < other.pieces.size(); ++f) add_at(pieces, f, other.pieces[f]);
  for (std::size_t f = 0; f < other.quadrature.size(); ++f) add_at(quadrature, f, other.quadrature[f]);
  incoherent.resize(std::max(incoherent.size(), other.incoherent.size()));
  for (std::size_t f = 0; f < other.incoherent.size(); ++f)
    for (std::size_t q = 0; q < 2; ++q) incoherent[f][q] += other.incoherent[f][q];
  for (std::size_t f = 0; f < other.inside.size(); ++f) add_at(inside, f, other.inside[f]);
  for (std::size_t b = 0; b < other.met.size(); ++b) add_at(met, b, other.met[b]);
  truncated += other.truncated;
  tubes += other.tubes;
  rays += other.rays;
  lost_rays += other.lost_rays;
  const std::size_t room = most_lost_rays_told - first_lost.size(), more = std::min(room, other.first_lost.size());
  first_lost.insert(first_lost.end(), other.first_lost.begin(), other.first_lost.begin() + static_cast<std::ptrdiff_t>(more));
  empty_cells += other.empty_cells;
  faces_away += other.faces_away;
  sliver_area += other.sliver_area;
}

void TubeSums::take(TubeSums other, std::span<const std::size_t> frequencies) {
  if (error.empty()) {
    *this = std::move(other);
    return;
  }
  const auto take_rows = [&](auto& mine, auto& theirs, std::size_t all) {
    if (all == 0) return;
    mine.resize(all), theirs.resize(all);
    for (const std::size_t f : frequencies) mine[f] = theirs[f];
  };
  bounces.resize(std::max(bounces.size(), other.bounces.size())), other.bounces.resize(bounces.size());
  for (std::size_t b = 0; b < bounces.size(); ++b) take_rows(bounces[b], other.bounces[b], error.size());
  take_rows(error, other.error, error.size());
  take_rows(incoherent, other.incoherent, std::max(incoherent.size(), other.incoherent.size()));
  take_rows(inside, other.inside, std::max(inside.size(), other.inside.size()));
  if (other.tubes > tubes) {
    std::swap(bounces, other.bounces), std::swap(error, other.error), std::swap(incoherent, other.incoherent);
    std::swap(inside, other.inside);
    std::swap(*this, other);
  }
  hits.resize(bounces.size());
}

void TubeSums::append(TubeSums further) {
  const std::size_t before = bounces.empty() ? 0 : bounces[0].size(),
                    more = further.bounces.empty() ? 0 : further.bounces[0].size();
  bounces.resize(std::max(bounces.size(), further.bounces.size()), std::vector<ScatteringMatrix>(before));
  further.bounces.resize(bounces.size(), std::vector<ScatteringMatrix>(more));
  for (std::size_t b = 0; b < bounces.size(); ++b)
    bounces[b].insert(bounces[b].end(), further.bounces[b].begin(), further.bounces[b].end());
  const auto join = [&](auto& values, const auto& others) {
    if (values.empty() && others.empty()) return;
    values.resize(before);
    values.insert(values.end(), others.begin(), others.end());
    values.resize(before + more);
  };
  join(coarse, further.coarse), join(pieces, further.pieces), join(quadrature, further.quadrature);
  join(incoherent, further.incoherent), join(inside, further.inside);
  rays += further.rays;
  for (const Truncation reason : truncations) {
    TruncatedSum& sum = truncated[reason];
    sum.tubes = std::max(sum.tubes, further.truncated[reason].tubes);
    sum.sigma = std::max(sum.sigma, further.truncated[reason].sigma);
  }
}

}  // namespace raytube
