#include "utd/edge_sets.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <utility>

#include "utd/wedge/near_look.h"

namespace raytube {

namespace {

// Pairs of an edge and a face, large or not, up to which a body has few parts: it is computed whole, as corner reflectors are.
constexpr std::size_t few_pairs = 64;

std::shared_ptr<const std::vector<Wedge>> all_in_the_open(std::vector<Wedge> wedges) {
  for (Wedge& wedge : wedges) wedge.enclosed = false;
  return std::make_shared<const std::vector<Wedge>>(std::move(wedges));
}

}  // namespace

// Screens count only where edges are asked for their currents.
EdgeSets::EdgeSets(const EdgeSetup& setup) : setup_(setup), reach_(setup.frequencies.size()) {
  for (const WedgesAndCorners& edges : setup_.wedges) sets_.push_back(set_of(edges));
  if (setup_.interaction) prepare_interaction();
  if (setup_.material_edges && !setup_.materials.empty()) materials_.emplace(setup_.materials, setup_.frequencies);
  const bool screened = std::ranges::any_of(setup_.materials, &Material::transmits);
  if (screened && (radiate() || !setup_.skip_enclosed)) screens_.emplace(setup_.tracer.mesh(), setup_.materials);
}

EdgeSets::Set EdgeSets::set_of(const WedgesAndCorners& edges) const {
  const WedgeSet& wedges = edges.wedges;
  Set set{};
  set.indices = wedges.indices, set.wedges = wedges.wedges, set.outlines = wedges.outlines;
  for (const std::size_t index : set.indices) set.frequencies.push_back(setup_.frequencies[index]);
  if (!setup_.skip_enclosed) set.wedges = all_in_the_open(*set.wedges);
  if (setup_.fringe.order == 1) return set;
  set.corners = edges.corners;
  if (setup_.curved != nullptr) set.curved = std::make_shared<CurvedFaces>(*setup_.curved, *set.wedges);
  return set;
}

void EdgeSets::Set::keep(const std::vector<bool>& wanted) {
  const std::vector<std::size_t> all_indices = std::exchange(indices, {});
  const std::vector<double> all_frequencies = std::exchange(frequencies, {});
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!wanted[i]) continue;
    indices.push_back(all_indices[i]);
    frequencies.push_back(all_frequencies[i]);
  }
}

// At frequencies of a set the same materials are mirrors.
void EdgeSets::divide_by_mirrors() {
  std::vector<Set> divided;
  for (const Set& set : sets_) {
    std::map<std::vector<bool>, std::vector<bool>> wanted;  // by which are mirrors
    for (std::size_t i = 0; i < set.indices.size(); ++i) {
      const FaceMaterials materials{setup_.materials, set.indices};
      const std::vector<bool> mirrors = mirrors_among(materials, i, wavenumber(set.frequencies[i]));
      wanted.try_emplace(mirrors, set.indices.size()).first->second[i] = true;
    }
    for (const auto& [mirrors, frequencies] : wanted) divided.emplace_back(set).keep(frequencies);
  }
  sets_ = std::move(divided);
}

// Currents run on as images over right-angled corners where edges illuminate other faces, and only there: such frequencies are a
// set of their own.
void EdgeSets::prepare_interaction() {
  divide_by_mirrors();
  std::vector<Set> divided;
  for (const Set& set : sets_) {
    const std::size_t count = set.indices.size();
    const InteractionParts parts(setup_.tracer.mesh(), *set.wedges, {setup_.materials, set.indices},
                                 wavenumber(set.frequencies.front()));
    std::vector<bool> continuing(count);
    std::vector<PairPlan> plans;
    const std::vector<InteractionGroup> groups = interaction_groups(parts, set.frequencies, std::vector<bool>(count, true));
    for (const InteractionGroup& group : groups) {
      plans.push_back(plan_of(parts, group));
      const double reach = plans.back().reach();
      for (const std::size_t i : group.indices) {
        reach_[set.indices[i]] = reach;
        continuing[i] = reach > 0.0 && reach >= setup_.least_reach;
      }
    }
    for (const bool continues : {true, false}) {
      if (std::ranges::find(continuing, continues) == continuing.end()) continue;
      Set& part = divided.emplace_back(set);
      std::vector<bool> kept = continuing;
      if (!continues) kept.flip();
      part.keep(kept);
      part.continues = continues;
      if (!continues && setup_.least_reach > 0.0) continue;
      part.parts = parts;
      part.interaction = interaction_groups(parts, part.frequencies, std::vector<bool>(part.indices.size(), true));
      for (std::size_t g = 0; g < groups.size(); ++g)
        if (continuing[groups[g].indices.front()] == continues) part.plans.push_back(plans[g]);
      for (const InteractionGroup& group : part.interaction) {
        std::vector<std::size_t>& indices = part.group_indices.emplace_back();
        for (const std::size_t i : group.indices) indices.push_back(part.indices[i]);
      }
    }
  }
  sets_ = std::move(divided);
  std::ranges::sort(sets_, std::ranges::greater{}, [](const Set& set) { return std::ranges::max(set.frequencies); });
}

PairPlan EdgeSets::plan_of(const InteractionParts& parts, const InteractionGroup& group) const {
  if (std::isinf(setup_.interaction_work) || parts.axes.size() * parts.patches.size() <= few_pairs) return {};
  const std::span large = std::span(parts.by_area).first(group.large_faces);
  return {{parts.axes, group.shortest_axis, setup_.tracer.mesh(), parts.patches, large}, setup_.interaction_work};
}

bool EdgeSets::radiates(const Wedge& wedge, EdgeKind kind) const {
  return kind == EdgeKind::conductors ? wedge.radiates() : materials_ && materials_->radiates(wedge);
}

bool EdgeSets::radiate(EdgeKind kind) const {
  const auto one_does = [&](const Wedge& wedge) { return radiates(wedge, kind); };
  return std::ranges::any_of(sets_, [&](const Set& set) { return std::ranges::any_of(*set.wedges, one_does); });
}

std::vector<double> EdgeSets::radiating_lengths() const {
  std::vector<double> lengths(setup_.frequencies.size());
  for (const Set& set : sets_) {
    double sum = 0.0;
    for (const Wedge& wedge : *set.wedges)
      if (radiates(wedge, EdgeKind::conductors) || radiates(wedge, EdgeKind::materials))
        sum += (wedge.conducting() ? 1.0 : 2.0) * wedge.length();
    for (const std::size_t index : set.indices) lengths[index] = sum;
  }
  return lengths;
}

EdgeScene EdgeSets::scene(const Set& set, bool over_curved) const {
  return {*set.wedges,
          *set.outlines,
          screens_ ? screens_->opaque() : setup_.tracer,
          set.corners.get(),
          over_curved ? set.curved.get() : nullptr,
          screens_ ? &*screens_ : nullptr,
          materials_ ? &*materials_ : nullptr};
}

std::vector<EdgeSets::SetPart> EdgeSets::parts_of(const Set& set, const WavesAtEdges& waves) const {
  std::array<SetPart, 2> parts{{{set, false}, {set, true}}};
  for (std::size_t i = 0; i < set.indices.size(); ++i) {
    SetPart& part = parts[!waves.running.empty() && waves.running[set.indices[i]] ? 1 : 0];
    part.indices.push_back(set.indices[i]);
    part.frequencies.push_back(set.frequencies[i]);
  }
  std::vector<SetPart> result;
  for (SetPart& part : parts)
    if (!part.indices.empty()) result.push_back(std::move(part));
  return result;
}

FringeOptions EdgeSets::options(const Set& set, EdgeKind kind) const {
  FringeOptions options = setup_.fringe;
  options.of_materials = kind == EdgeKind::materials;
  options.continue_by_images = set.continues;
  return options;
}

EdgeLook EdgeSets::look_of(const Look& look, const Radar& radar, std::span<const double> frequencies) const {
  return {look, radar, setup_.tracer.mesh(), frequencies};
}

EdgeLookResult EdgeSets::scattering(const Look& look, const Radar& radar, const WavesAtEdges& waves, EdgeKind kind) const {
  EdgeLookResult all;
  all.scattering.resize(setup_.frequencies.size());
  if (setup_.fringe.order > 1) all.higher.resize(setup_.frequencies.size());
  all.windowed.resize(setup_.frequencies.size());
  for (const Set& set : sets_)
    for (const SetPart& part : parts_of(set, waves)) {
      const SurfaceLight light = part.over_curved ? SurfaceLight{waves.arrivals, part.indices} : SurfaceLight{};
      put(part.indices,
          fringe_scattering(scene(set, part.over_curved), look_of(look, radar, part.frequencies),
                            {part.frequencies, part.indices}, options(set, kind), light),
          all);
    }
  return all;
}

std::vector<ImageEdge> EdgeSets::pieces(const Look& look, const Radar& radar, const PieceRequest& request,
                                        const WavesAtEdges& waves, EdgeKind kind) const {
  for (const Set& set : sets_)
    for (const SetPart& part : parts_of(set, waves)) {
      const auto found = std::ranges::find(part.indices, request.frequency_index);
      if (found == part.indices.end()) continue;
      const PieceRequest in_part{static_cast<std::size_t>(found - part.indices.begin()), request.lattice, request.by_path};
      return fringe_pieces(scene(set, part.over_curved), look_of(look, radar, part.frequencies), {part.frequencies, part.indices},
                           in_part, options(set, kind));
    }
  return {};
}

bool EdgeSets::has_corner_waves(CornerWaveKind kind) const {
  return std::ranges::any_of(sets_, [&](const Set& set) { return set.corners != nullptr && set.corners->count(kind) > 0; });
}

std::vector<double> EdgeSets::solid_corner_amplitudes(const Look& look, const Radar& radar) const {
  std::vector<double> all(setup_.frequencies.size());
  for (const Set& set : sets_) {
    const std::vector<double> part =
        raytube::solid_corner_amplitudes(scene(set, false), look_of(look, radar, set.frequencies), set.frequencies);
    for (std::size_t i = 0; i < set.indices.size(); ++i) all[set.indices[i]] = part[i];
  }
  return all;
}

CornerWaveSum EdgeSets::corner_waves(const Look& look, const Radar& radar, CornerWaveKind kind) const {
  CornerWaveSum all{std::vector<ScatteringMatrix>(setup_.frequencies.size())};
  for (const Set& set : sets_) {
    if (set.corners->count(kind) == 0) continue;
    const CornerWaveSum part = corner_wave_scattering(scene(set, false), look_of(look, radar, set.frequencies),
                                                      {set.frequencies, set.indices}, options(set), kind);
    for (std::size_t i = 0; i < set.indices.size(); ++i) all.scattering[set.indices[i]] = part.scattering[i];
    all.edges = std::max(all.edges, part.edges);
    all.work += part.work;
  }
  return all;
}

std::vector<ImageEdge> EdgeSets::corner_wave_pieces(const Look& look, const Radar& radar, const PieceRequest& request,
                                                    CornerWaveKind kind) const {
  for (const Set& set : sets_)
    if (const auto found = std::ranges::find(set.indices, request.frequency_index); found != set.indices.end())
      return raytube::corner_wave_pieces(
          scene(set, false), look_of(look, radar, set.frequencies), {set.frequencies, set.indices},
          {static_cast<std::size_t>(found - set.indices.begin()), request.lattice, request.by_path}, options(set), kind);
  return {};
}

std::vector<ImageEdge> EdgeSets::arrival_pieces(const Look& look, const Radar& radar, const PieceRequest& request,
                                                std::span<const SurfaceArrival> arrivals) const {
  std::vector<ImageEdge> pieces;
  for (const Set& set : sets_) {
    const auto found = std::ranges::find(set.indices, request.frequency_index);
    if (found == set.indices.end()) continue;
    const EdgeLook here = look_of(look, radar, set.frequencies);
    for (const SurfaceArrival& arrival : arrivals) {
      std::vector<ScatteringMatrix> s(set.frequencies.size());
      add_arrivals(scene(set, true), here, set.frequencies, options(set), {std::span(&arrival, 1), set.indices}, s);
      const dvec3 place = request.by_path
                              ? PathPlace{here.at(arrival.position).scattered}.at(arrival.start, arrival.position, arrival.path)
                              : arrival.position;
      pieces.push_back({place, place, s[found - set.indices.begin()]});
    }
  }
  return pieces;
}

std::vector<SurfaceRay> EdgeSets::surface_rays(const Look& look, const Radar& radar,
                                               std::span<const SurfaceArrival> arrivals) const {
  std::vector<SurfaceRay> rays;
  for (const Set& set : sets_) {
    FringeOptions keeping = options(set);
    keeping.rays = &rays;
    fringe_scattering(scene(set, true), look_of(look, radar, set.frequencies), {set.frequencies, set.indices}, keeping,
                      {arrivals, set.indices});
  }
  return rays;
}

InteractionScene EdgeSets::interaction_scene(const Set& set, const InteractionGroup& group) const {
  const InteractionParts& parts = set.parts;
  const auto number = static_cast<std::size_t>(&group - set.interaction.data());
  const ReceivingFaces faces{setup_.faces, group.large, parts.corners, {}, {setup_.materials, set.group_indices[number]}};
  return {{*set.wedges, *set.outlines, setup_.tracer}, faces, parts.axes, group.shortest_axis, parts.patches, set.plans[number]};
}

InteractionResult EdgeSets::interaction(const Look& look, const InteractionLimits& limits) const {
  InteractionResult all;
  const InteractionOptions options{setup_.fringe.order, limits.tolerance, limits.antennas};
  for (const Set& set : sets_)
    for (const InteractionGroup& group : set.interaction)
      put(set, group, interaction_scattering(interaction_scene(set, group), look, group.frequencies, options), all);
  return all;
}

void EdgeSets::put(const Set& set, const InteractionGroup& group, const InteractionResult& part, InteractionResult& all) const {
  all.work += part.work;
  all.pairs += part.pairs, all.pairs_left_out += part.pairs_left_out;
  all.reflected_pairs_left_out += part.reflected_pairs_left_out;
  if (part.scattering.empty()) return;
  all.scattering.resize(setup_.frequencies.size());
  all.error.resize(setup_.frequencies.size());
  all.illuminating_pieces = std::max(all.illuminating_pieces, part.illuminating_pieces);
  if (!part.left_out.empty()) all.left_out.resize(setup_.frequencies.size());
  for (std::size_t i = 0; i < group.indices.size(); ++i) {
    const std::size_t index = set.indices[group.indices[i]];
    all.scattering[index] = part.scattering[i];
    all.error[index] = part.error[i];
    if (!part.left_out.empty()) all.left_out[index] = part.left_out[i];
  }
}

std::vector<ImageEdge> EdgeSets::interaction_pieces(const Look& look, std::size_t frequency_index,
                                                    const InteractionLimits& limits, bool by_path) const {
  for (const Set& set : sets_)
    for (const InteractionGroup& group : set.interaction)
      for (std::size_t i = 0; i < group.indices.size(); ++i) {
        if (set.indices[group.indices[i]] != frequency_index) continue;
        InteractionScene scene = interaction_scene(set, group);
        scene.faces.materials.frequencies = scene.faces.materials.frequencies.subspan(i, 1);
        return raytube::interaction_pieces(scene, look, group.frequencies[i],
                                           {setup_.fringe.order, limits.tolerance, limits.antennas},
                                           by_path ? InteractionApart::by_path : InteractionApart::by_edges);
      }
  return {};
}

void EdgeSets::put(const std::vector<std::size_t>& indices, const EdgeLookResult& part, EdgeLookResult& all) {
  all.lit = all.lit || part.lit;
  all.work += part.work;
  if (all.wedges_lit == 0) all.wedges_lit = part.wedges_lit;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    all.scattering[indices[i]] = part.scattering[i];
    all.windowed[indices[i]] = part.windowed[i];
    if (!part.higher.empty()) all.higher[indices[i]] = part.higher[i];
  }
}

}  // namespace raytube
