#include "sbr/tube_sums.h"

namespace raytube {

namespace {

template <class Values>
void add_at(Values& sum, std::size_t index, const typename Values::value_type& value) {
  if (sum.size() <= index) sum.resize(index + 1);
  sum[index] += value;
}

}  // namespace

CoarseDifference& CoarseDifference::operator+=(const CoarseDifference& other) {
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

void TubeSums::compare_with(const std::vector<ScatteringMatrix>& coarse_sums) {
  coarse.assign(coarse_sums.size(), {});
  for (std::size_t f = 0; f < coarse.size(); ++f) {
    ScatteringMatrix fine;
    for (const std::vector<ScatteringMatrix>& bounce : bounces) fine += bounce[f];
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) {
        coarse[f].coherent.at(p, q) = fine.at(p, q) - coarse_sums[f].at(p, q);
        coarse[f].squares[p][q] = std::norm(coarse[f].coherent.at(p, q));
      }
  }
}

void TubeSums::add_error(std::size_t frequency, std::size_t frequencies, int p, int q, double size) {
  squared_errors.resize(frequencies);
  squared_errors[frequency][p][q] += size * size;
}

void TubeSums::add(const TubeSums& other) {
  for (std::size_t f = 0; f < other.squared_errors.size(); ++f)
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) {
        squared_errors.resize(other.squared_errors.size());
        squared_errors[f][p][q] += other.squared_errors[f][p][q];
      }
  for (std::size_t b = 0; b < other.bounces.size(); ++b) {
    if (bounces.size() <= b) bounces.emplace_back(other.bounces[b].size());
    for (std::size_t f = 0; f < other.bounces[b].size(); ++f) bounces[b][f] += other.bounces[b][f];
    add_at(hits, b, other.hits[b]);
  }
  for (std::size_t f = 0; f < other.coarse.size(); ++f) add_at(coarse, f, other.coarse[f]);
  tubes += other.tubes;
  rays += other.rays;
  lost_rays += other.lost_rays;
  tubes_cut += other.tubes_cut;
  sliver_area += other.sliver_area;
}

}  // namespace raytube
