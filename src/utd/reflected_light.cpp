#include "utd/reflected_light.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace raytube {

namespace {

constexpr double aside = 1e-5;     // [wavelengths]
constexpr double shortest = 1e-3;  // [wavelengths] pieces of an edge that count, and gaps between them
constexpr std::size_t most_pairs = 20000;
constexpr double least_sine = 1e-4;  // between wave and edge: along it hardly anything is diffracted
constexpr double grazing = 1e-9;     // cosine between wave and normal of a mirror

bool reflects(const Patch& plane, bool closed, const dvec3& direction) {
  const double facing = glm::dot(plane.normal, direction);
  return std::abs(facing) > grazing && !(closed && facing > 0.0);
}

}  // namespace

PlaneWave reflected(const PlaneWave& wave, const Patch& plane) {
  const double facing = glm::dot(wave.direction, plane.normal);
  PlaneWave result{wave.direction - 2 * facing * plane.normal, {}, wave.path + 2 * facing * plane.offset};
  for (int q = 0; q < 2; ++q) result.electric[q] = 2 * glm::dot(plane.normal, wave.electric[q]) * plane.normal - wave.electric[q];
  return result;
}

void ReflectedLight::find_mirrors() {
  const TriangleMesh& mesh = tree_.mesh();
  std::vector<bool> closed(mesh.patches.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) closed[mesh.triangle_patch[t]] = mesh.closed(t);
  for (std::uint32_t patch = 0; patch < mesh.patches.size(); ++patch)
    if (large_[patch]) mirrors_.push_back({patch, closed[patch]});
}

std::deque<ReflectedWave> ReflectedLight::waves(int most) {
  find_mirrors();
  std::vector<ReflectedWave> last{{incident_, {}, {}}}, next;
  std::deque<ReflectedWave> all;
  for (int reflection = 0; reflection < most; ++reflection) {
    if (axes_.size() * last.size() * mirrors_.size() > most_pairs) break;
    next.clear();
    for (const ReflectedWave& before : last)
      for (const Mirror& mirror : mirrors_) {
        const Patch& plane = tree_.mesh().patches[mirror.patch];
        const bool again = !before.patches.empty() && before.patches.back() == mirror.patch;
        if (again || !reflects(plane, mirror.closed, before.wave.direction)) continue;
        ReflectedWave wave{reflected(before.wave, plane), before.patches, {}};
        wave.patches.push_back(mirror.patch);
        next.push_back(wave);
        all.push_back(std::move(wave));
        light(all.back());
        if (all.back().lights.empty()) all.pop_back();
      }
    std::swap(last, next);
  }
  return all;
}

void ReflectedLight::light(ReflectedWave& wave) {
  for (const EdgeAxis& axis : axes_) {
    const Wedge& wedge = *axis.wedge;
    if (wedge.faces[0].patch == wave.patches.back() || wedge.faces[1].patch == wave.patches.back()) continue;
    const WedgeIncidence incidence = incidence_on(wedge, wave.wave.direction);
    if (incidence.weight == 0.0 || incidence.faces[0].sin_cone < least_sine) continue;
    find_pieces(wave, axis, aside * wavelength_);
    std::vector<LitPiece> one_side = std::exchange(pieces_, {});
    find_pieces(wave, axis, -aside * wavelength_);
    if (alike(one_side, pieces_)) {
      for (std::size_t i = 0; i < pieces_.size(); ++i)
        one_side[i] = {(one_side[i].from + pieces_[i].from) / 2, (one_side[i].to + pieces_[i].to) / 2, incidence.weight};
    } else {
      one_side.insert(one_side.end(), pieces_.begin(), pieces_.end());
      for (LitPiece& piece : one_side) piece.weight = incidence.weight / 2;
    }
    for (const LitPiece& piece : one_side)
      wave.lights.push_back({&axis, &wave.wave, incidence.faces[0], piece.from, piece.to, piece.weight});
  }
}

bool ReflectedLight::alike(std::span<const LitPiece> a, std::span<const LitPiece> b) const {
  const double near = shortest * wavelength_;
  return std::ranges::equal(a, b, [&](const LitPiece& p, const LitPiece& q) {
    return std::abs(p.from - q.from) < near && std::abs(p.to - q.to) < near;
  });
}

// Beams end at the corners of edges more often than close to them.
void ReflectedLight::snap_to_ends(const EdgeAxis& axis) {
  for (LitPiece& piece : pieces_) {
    if (piece.from < shortest * wavelength_) piece.from = 0.0;
    if (axis.length - piece.to < shortest * wavelength_) piece.to = axis.length;
  }
}

// Sideways is along the surface, the same for both faces of the wedge.
void ReflectedLight::find_pieces(const ReflectedWave& wave, const EdgeAxis& axis, double sideways) {
  const Wedge& wedge = *axis.wedge;
  const dvec3 over = wedge.faces[0].into_face - wedge.faces[1].into_face;
  const dvec3 side = wedge.n == 2.0 ? wedge.faces[0].into_face : glm::normalize(over);
  pieces_.clear();
  const Sheet sheet{axis.origin + sideways * side, axis.tangent, -wave.wave.direction, 0.0, axis.length};
  trace_back(sheet, {wedge.faces[0].patch, wedge.faces[1].patch, wedge.rim}, wave.patches);
  snap_to_ends(axis);
}

void ReflectedLight::trace_back(const Sheet& sheet, const IgnoredPatches& ignored, std::span<const std::uint32_t> mirrors) {
  if (mirrors.empty()) return keep_clear(sheet, ignored);
  const std::uint32_t mirror = mirrors.back();
  std::vector<SheetHit> hits;
  tracer_.trace(sheet, ignored, hits);
  for (const SheetHit& hit : hits)
    if (tree_.faces()[hit.face].patch == mirror)
      trace_back(reflected(sheet, hit, tree_.mesh().patches[mirror].normal), {mirror, no_index, no_index},
                 mirrors.first(mirrors.size() - 1));
}

// The pieces between what is met; neighbours are one.
void ReflectedLight::keep_clear(const Sheet& sheet, const IgnoredPatches& ignored) {
  std::vector<SheetHit> hits;
  tracer_.trace(sheet, ignored, hits);
  double from = sheet.from;
  const auto keep = [&](double to) {
    if (to - from < shortest * wavelength_) return;
    if (!pieces_.empty() && from - pieces_.back().to < shortest * wavelength_)
      pieces_.back().to = to;
    else
      pieces_.push_back({from, to});
  };
  for (const SheetHit& hit : hits) {
    keep(hit.from);
    from = hit.to;
  }
  keep(sheet.to);
}

}  // namespace raytube
