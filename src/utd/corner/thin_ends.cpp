#include "utd/corner/thin_ends.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "utd/corner/corner_angles.h"

namespace raytube {

namespace {

// Lines of edges bend by this angle at most where they go on, as edges between corners of sheets do.
constexpr double flat_bend = 15.0 * degree;

bool is_solid_edge(const Wedge& wedge) { return wedge.radiates() && wedge.n < 2.0 && wedge.share == 1.0; }

class Finder {
 public:
  explicit Finder(std::span<const Wedge> wedges) : wedges_(wedges) {
    find_borders();
    if (borders_.empty()) return;
    for (std::uint32_t w = 0; w < wedges.size(); ++w)
      for (const WedgeEnd end : {2 * w, 2 * w + 1}) ends_[key(point(end))].push_back(end);
  }

  std::vector<ThinEnd> all() const {
    std::vector<ThinEnd> result;
    for (const auto& [patch, border] : borders_)
      if (auto found = thin_end(patch, border)) result.push_back(std::move(*found));
    return result;
  }

 private:
  using Key = std::array<double, 3>;
  static Key key(const dvec3& p) { return {p.x, p.y, p.z}; }

  bool is_sharp(const Wedge& wedge) const { return is_solid_edge(wedge) && wedge.interior_angle() <= 60.0 * degree; }

  /// Finds the faces that may be ends: at some of their edges a sharp one stops, and their neighbours are upright on them. Most
  /// bodies have none.
  void find_borders() {
    std::vector<Key> tips;
    for (const Wedge& wedge : wedges_)
      if (is_sharp(wedge)) tips.insert(tips.end(), {key(wedge.start), key(wedge.end)});
    if (tips.empty()) return;
    std::ranges::sort(tips);
    for (std::uint32_t w = 0; w < wedges_.size(); ++w)
      if (!is_sharp(wedges_[w]) &&
          (std::ranges::binary_search(tips, key(wedges_[w].start)) || std::ranges::binary_search(tips, key(wedges_[w].end))))
        for (const WedgeFace& face : wedges_[w].faces)
          if (face.patch != no_index) borders_[face.patch];
    for (std::uint32_t w = 0; w < wedges_.size(); ++w)
      for (const WedgeFace& face : wedges_[w].faces)
        if (const auto border = borders_.find(face.patch); border != borders_.end()) border->second.push_back(w);
    std::erase_if(borders_, [&](const auto& border) { return !all_upright(border.first, border.second); });
  }

  bool all_upright(std::uint32_t patch, std::span<const std::uint32_t> border) const {
    const dvec3& normal = face_on(border[0], patch).normal;
    return border.size() >= 3 && std::ranges::all_of(border, [&](std::uint32_t w) { return may_bound(w, normal, patch); });
  }

  const dvec3& point(WedgeEnd end) const { return end % 2 == 0 ? wedges_[end / 2].start : wedges_[end / 2].end; }
  /// Along the wedge, away from that end.
  dvec3 direction(WedgeEnd end) const { return glm::normalize(point(end ^ 1u) - point(end)); }
  const WedgeFace& face_on(std::uint32_t wedge, std::uint32_t patch) const {
    return wedges_[wedge].faces[wedges_[wedge].faces[0].patch == patch ? 0 : 1];
  }

  bool may_bound(std::uint32_t wedge, const dvec3& normal, std::uint32_t patch) const {
    const Wedge& edge = wedges_[wedge];
    return is_solid_edge(edge) && !edge.is_border() && std::abs(edge.interior_angle() - 0.5 * pi) <= 30.0 * degree &&
           angle_between(face_on(wedge, patch).normal, normal) < off_plane;
  }

  /// The one other edge of that face which goes on there.
  std::optional<WedgeEnd> next_on(std::uint32_t patch, WedgeEnd end) const {
    std::optional<WedgeEnd> next;
    for (const WedgeEnd other : ends_.at(key(point(end)))) {
      const auto& faces = wedges_[other / 2].faces;
      if (other == end || (faces[0].patch != patch && faces[1].patch != patch)) continue;
      if (next) return std::nullopt;
      next = other;
    }
    return next;
  }

  /// The edges of a face as one closed line, each by the end at which it begins.
  std::vector<WedgeEnd> outline(std::uint32_t patch, std::span<const std::uint32_t> border) const {
    std::vector<WedgeEnd> line{2 * border[0]};
    while (line.size() <= border.size()) {
      const auto next = next_on(patch, line.back() ^ 1u);
      if (!next) return {};
      if (*next == line.front()) break;
      line.push_back(*next);
    }
    return line.size() == border.size() ? line : std::vector<WedgeEnd>{};
  }

  /// Turns the line so that a tip is at its beginning, and says where the other one is, by its index. The line turns by 120
  /// degrees at least at a tip. None if there are not two, or other bends.
  std::optional<std::size_t> second_tip(std::vector<WedgeEnd>& line) const {
    std::vector<std::size_t> tips;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const WedgeEnd before = line[(i + line.size() - 1) % line.size()];
      const double turn = angle_between(direction(before), direction(line[i]));
      if (turn >= 120.0 * degree)
        tips.push_back(i);
      else if (turn > flat_bend)
        return std::nullopt;
    }
    if (tips.size() != 2) return std::nullopt;
    std::rotate(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(tips[0]), line.end());
    return tips[1] - tips[0];
  }

  std::optional<ThinEnd::Tip> tip(WedgeEnd on_line, WedgeEnd before) const {
    const std::vector<WedgeEnd>& here = ends_.at(key(point(on_line)));
    if (here.size() != 3) return std::nullopt;
    WedgeEnd end = *std::ranges::find_if(here, [&](WedgeEnd e) { return e != on_line && e != (before ^ 1u); });
    ThinEnd::Tip tip{point(end), direction(end), {}, 0.0, {}};
    while (true) {
      const Wedge& edge = wedges_[end / 2];
      if (!is_sharp(edge)) return std::nullopt;
      tip.edges.push_back(end / 2);
      tip.sharp_length += edge.length();
      tip.sharp_end = point(end ^ 1u);
      const std::vector<WedgeEnd>& there = ends_.at(key(tip.sharp_end));
      if (there.size() != 2 || tip.edges.size() == wedges_.size()) return tip;
      const WedgeEnd next = there[0] == (end ^ 1u) ? there[1] : there[0];
      if (angle_between(direction(end), direction(next)) > flat_bend) return tip;
      end = next;
    }
  }

  std::optional<ThinEnd> thin_end(std::uint32_t patch, std::span<const std::uint32_t> border) const {
    const dvec3& normal = face_on(border[0], patch).normal;
    std::vector<WedgeEnd> line = outline(patch, border);
    if (line.empty()) return std::nullopt;
    const auto second = second_tip(line);
    if (!second) return std::nullopt;
    const auto first_tip = tip(line.front(), line.back()), last_tip = tip(line[*second], line[*second - 1]);
    if (!first_tip || !last_tip) return std::nullopt;
    ThinEnd end{{*first_tip, *last_tip}, {}, {}, 0.0, normal};
    measure(line, *second, end);
    return end.thickness <= 0.25 * end.length() ? std::optional(end) : std::nullopt;
  }

  void measure(std::span<const WedgeEnd> line, std::size_t second, ThinEnd& end) const {
    const dvec3& origin = end.tips[0].position;
    dvec3 area(0.0);
    for (std::size_t i = 0; i < line.size(); ++i) {
      end.sides[i < second ? 0 : 1].push_back(line[i] / 2);
      area += 0.5 * glm::cross(point(line[i]) - origin, point(line[i] ^ 1u) - origin);
    }
    end.thickness = glm::length(area) / end.length();
    const dvec3 across = glm::normalize(glm::cross(area, end.tips[1].position - origin));
    end.towards = {-across, across};
  }

  std::span<const Wedge> wedges_;
  std::map<Key, std::vector<WedgeEnd>> ends_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> borders_;
};

}  // namespace

std::vector<ThinEnd> find_thin_ends(std::span<const Wedge> wedges) { return Finder(wedges).all(); }

}  // namespace raytube
