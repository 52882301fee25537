#include "solve/look_result.h"

#include <cstring>
#include <type_traits>

namespace raytube {

namespace {

template <class Value>
concept Plain = std::is_trivially_copyable_v<Value>;

class Writer {
 public:
  explicit Writer(std::size_t expected) { bytes_.reserve(expected); }

  template <Plain Value>
  void operator()(const Value& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <Plain Value>
  void operator()(const std::vector<Value>& values) {
    (*this)(values.size());
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value));
  }
  template <class Value>
  void operator()(const std::vector<std::vector<Value>>& lists) {
    (*this)(lists.size());
    for (const std::vector<Value>& list : lists) (*this)(list);
  }
  void operator()(const std::vector<bool>& flags) { (*this)(std::vector<char>(flags.begin(), flags.end())); }

  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  template <Plain Value>
  void operator()(Value& value) {
    copy(&value, sizeof value);
  }
  template <Plain Value>
  void operator()(std::vector<Value>& values) {
    values.resize(size(sizeof(Value)));
    copy(values.data(), values.size() * sizeof(Value));
  }
  template <class Value>
  void operator()(std::vector<std::vector<Value>>& lists) {
    lists.resize(size(sizeof(std::size_t)));
    for (std::vector<Value>& list : lists) (*this)(list);
  }
  void operator()(std::vector<bool>& flags) {
    std::vector<char> bytes;
    (*this)(bytes);
    flags.assign(bytes.begin(), bytes.end());
  }

  /// Everything was there, and nothing more.
  bool fits() const { return fits_ && bytes_.empty(); }

 private:
  // The length of a list whose entries take so many bytes each, at least.
  std::size_t size(std::size_t each) {
    std::size_t count = 0;
    (*this)(count);
    if (count > bytes_.size() / each) fits_ = false;
    return fits_ ? count : 0;
  }

  void copy(void* to, std::size_t count) {
    if (count > bytes_.size()) fits_ = false;
    if (!fits_ || count == 0) return;
    std::memcpy(to, bytes_.data(), count);
    bytes_.remove_prefix(count);
  }

  std::string_view bytes_;
  bool fits_ = true;
};

// One list of members for both ways.
template <class Archive, class Look>
void visit(Archive& archive, Look& look) {
  auto& [tubes, edges, between, surface] = look;
  archive(tubes.bounces), archive(tubes.incoherent), archive(tubes.error), archive(tubes.hits);
  archive(tubes.tubes), archive(tubes.rays), archive(tubes.lost_rays), archive(tubes.truncated), archive(tubes.first_lost);
  archive(tubes.empty_cells), archive(tubes.faces_away), archive(tubes.sliver_area), archive(tubes.met);
  archive(edges.scattering), archive(edges.higher), archive(edges.windowed);
  archive(edges.wedges_lit), archive(edges.lit);
  archive(between.scattering), archive(between.error), archive(between.illuminating_pieces);
  archive(between.left_out), archive(between.skipped), archive(between.unreached), archive(between.pairs), archive(between.work),
      archive(edges.work);
  archive(surface.scattering), archive(surface.strips), archive(surface.work);
}

bool has_frequencies(const LookResult& look, std::size_t count) {
  const auto none_or_all = [count](const auto& list) { return list.empty() || list.size() == count; };
  for (const std::vector<ScatteringMatrix>& bounce : look.tubes.bounces)
    if (bounce.size() != count) return false;
  return look.tubes.error.size() == count && none_or_all(look.tubes.incoherent) && none_or_all(look.edges.scattering) &&
         none_or_all(look.edges.higher) && none_or_all(look.edges.windowed) && none_or_all(look.interaction.scattering) &&
         look.interaction.error.size() == look.interaction.scattering.size() && none_or_all(look.interaction.left_out) &&
         none_or_all(look.surface.scattering);
}

}  // namespace

void LookResult::keep_sums_only() {
  tubes.coarse = {};
  tubes.pieces = {};
  tubes.quadrature = {};
}

std::string look_bytes(const LookResult& look) {
  const std::size_t matrices = (look.tubes.bounces.size() + 5) * look.tubes.error.size();
  Writer writer(matrices * sizeof(ScatteringMatrix) + 1000);
  visit(writer, look);
  return writer.take();
}

std::optional<LookResult> look_of_bytes(std::string_view bytes, std::size_t frequencies) {
  LookResult look;
  Reader reader(bytes);
  visit(reader, look);
  if (!reader.fits() || !has_frequencies(look, frequencies)) return {};
  return look;
}

}  // namespace raytube
