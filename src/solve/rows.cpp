#include "solve/rows.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "plan/phase_reference.h"
#include "solve/remedies.h"

namespace raytube {

namespace {

constexpr std::size_t first_bounce = 0, later_bounces = 1, first_column = 2;  // in the list of bounds

ScatteringMatrix scaled(ScatteringMatrix matrix, Complex factor) { return matrix *= factor; }

}  // namespace

Rows::Rows(const SolvePlan& plan, const ModelUncertainty& model, std::vector<double> edge_lengths)
    : plan_(plan),
      sweep_(plan.sweep),
      model_uncertainty_(model),
      first_(plan.looks.computed.size() + 1),
      following_(sweep_.looks.size()),
      model_squares_(plan.looks.computed.size()),
      left_out_(plan.mechanisms.size(), std::vector<double>(plan.looks.computed.size())),
      account_(plan),
      bounds_(plan, std::move(edge_lengths)),
      beyond_bound_{{"the first bounce"}, {"later bounces"}} {
  for (const LookSource& source : plan.looks.sources) ++first_[source.index + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<std::size_t> next = first_;
  for (std::size_t i = 0; i < following_.size(); ++i) following_[next[plan.looks.sources[i].index]++] = i;
  const std::size_t rows = sweep_.rows(), kept = plan.keep_parts ? rows : 0;
  result_.total.resize(rows);
  result_.error.resize(rows);
  result_.model.resize(rows);
  result_.model_parts.resize(omissions);
  if (any_rough(sweep_.materials) && !plan.rays()) result_.incoherent.resize(rows);
  for (ModelPart& part : result_.model_parts) part.rows.resize(kept);
  for (const MechanismEntry& mechanism : plan.mechanisms)
    for (const MechanismColumn& column : mechanism.columns) {
      beyond_bound_.push_back({column.label});
      if (plan.keep_parts) result_.mechanisms.push_back({column.name, std::vector<ScatteringMatrix>(rows)});
    }
}

std::span<const std::size_t> Rows::following(std::size_t index) const {
  return std::span(following_).subspan(first_[index], first_[index + 1] - first_[index]);
}

void Rows::add(std::size_t index, const LookResult& look) {
  const std::vector<OmissionErrors> errors = model_uncertainty_.of(sweep_.looks[plan_.looks.computed[index]], look);
  const std::lock_guard lock(mutex_);
  const auto looks = static_cast<double>(following(index).size());
  account_.add(index, look, following(index).size());
  for (std::size_t i = 0; i < look.mechanisms.size(); ++i)
    for (const double missing : look.mechanisms[i].missing) left_out_[i][index] += looks * missing * missing;
  for (std::size_t f = 0; f < errors.size(); ++f) add_model(index, f, errors[f]);
  for (const std::size_t each : following(index)) {
    for (std::size_t f = 0; f < sweep_.frequencies.size(); ++f) add_row(each, f, look, plan_.looks.sources[each]);
    if (!look.tubes.incoherent.empty())
      std::ranges::copy(look.tubes.incoherent, result_.incoherent.begin() + static_cast<std::ptrdiff_t>(sweep_.row(each, 0)));
  }
}

// The same for every look that follows from this one.
void Rows::add_model(std::size_t index, std::size_t frequency_index, const OmissionErrors& errors) {
  const std::span looks = following(index);
  std::array<double, omissions> squares{};
  for (std::size_t i = 0; i < omissions; ++i)
    if (const double square = co_polar_square(errors[i]); std::isfinite(square)) squares[i] = square;
  for (std::size_t i = 0; i < omissions; ++i) model_squares_[index][i] += static_cast<double>(looks.size()) * squares[i];
  const auto largest = static_cast<std::size_t>(std::ranges::max_element(squares) - squares.begin());
  if (squares[largest] > 0.0) result_.model_parts[largest].rows_largest += looks.size();
  for (const std::size_t look : looks) {
    const std::size_t row = sweep_.row(look, frequency_index);
    result_.model[row] = root_sum_square(errors);
    for (std::size_t i = 0; plan_.keep_parts && i < omissions; ++i) result_.model_parts[i].rows[row] = errors[i];
  }
}

void Rows::add_row(std::size_t look, std::size_t frequency_index, const LookResult& part, const LookSource& source) {
  const std::size_t row = sweep_.row(look, frequency_index);
  const Complex factor = to_mesh_origin(plan_.target.mesh, sweep_.looks[look], sweep_.frequencies[frequency_index]);
  const PhysicalBound bound = bounds_.of(sweep_.looks[look], frequency_index);
  const auto referred = [&](const ScatteringMatrix& s) { return scaled(from_source(s, source), factor); };
  result_.error[row] = part.tubes.error[frequency_index];
  for (std::size_t b = 0; b < part.tubes.bounces.size(); ++b) {
    if (plan_.keep_parts && result_.bounces.size() <= b) result_.bounces.emplace_back(sweep_.rows());
    add_to_row(row, referred(part.tubes.bounces[b][frequency_index]), plan_.keep_parts ? &result_.bounces[b] : nullptr,
               b == 0 ? bound.first_bounce : bound.later_bounces, beyond_bound_[b == 0 ? first_bounce : later_bounces]);
  }
  std::size_t column = 0;
  for (std::size_t i = 0; i < part.mechanisms.size(); ++i) {
    const Contribution& added = part.mechanisms[i];
    for (std::size_t c = 0; c < plan_.mechanisms[i].columns.size(); ++c, ++column)
      if (c < added.s.size() && !added.s[c].empty())
        add_to_row(row, referred(added.s[c][frequency_index]), plan_.keep_parts ? &result_.mechanisms[column].rows : nullptr,
                   plan_.mechanisms[i].columns[c].bound(bound.limits), beyond_bound_[first_column + column]);
    if (!added.error.empty()) raytube::add(added.error[frequency_index], result_.error[row]);
  }
}

// Some parts reach their bound: physical optics of a plate, broadside.
constexpr double rounding = 1e-9;

// Rays and their edges have laws of their own. What is no number is beyond any bound.
void Rows::add_to_row(std::size_t row, const ScatteringMatrix& s, std::vector<ScatteringMatrix>* rows, double bound,
                      BeyondBound& beyond) {
  result_.total[row] += s;
  if (rows) (*rows)[row] = s;
  const double largest = largest_amplitude(s);
  const bool finite = std::isfinite(frobenius_norm(s));
  const bool bounded = plan_.rays() || largest <= bound * (1.0 + rounding) || largest == 0.0;
  if (finite && bounded) return;
  const double ratio = finite ? largest / bound : std::numeric_limits<double>::infinity();
  if (beyond.rows++ > 0 && (ratio < beyond.ratio || (ratio == beyond.ratio && row > beyond.worst))) return;
  beyond.ratio = ratio;
  beyond.worst = row;
}

// In index order, so that sums do not depend on the order of the looks.
std::vector<ModelPart> Rows::model_parts() {
  std::vector<double> sums(omissions);
  for (const std::array<double, omissions>& look : model_squares_)
    for (std::size_t part = 0; part < omissions; ++part) sums[part] += look[part];
  std::vector<MechanismShown> shown;
  for (std::size_t i = 0; i < plan_.mechanisms.size(); ++i) {
    const std::vector<MechanismRemedy>& remedies = plan_.mechanisms[i].remedies;
    const double missing = remedies.empty() ? 0.0 : sums[static_cast<std::size_t>(remedies.front().omission)],
                 left_out = std::accumulate(left_out_[i].begin(), left_out_[i].end(), 0.0);
    shown.push_back({account_.counts(i), account_.use(i).looks_without, missing > 0.0 ? left_out / missing : 0.0,
                     model_uncertainty_.curved_edges()});
  }
  std::vector<ModelPart> parts = std::move(result_.model_parts);
  for (std::size_t i = 0; i < omissions; ++i) {
    const auto omission = static_cast<Omission>(i);
    parts[i].name = text_of(omission).name, parts[i].what = text_of(omission).what;
    parts[i].remedy = remedy_of(omission, plan_, account_.so_far(), shown);
  }
  tell_shares(sums, sweep_.rows(), parts);
  std::erase_if(parts, [](const ModelPart& part) { return part.rms == 0.0; });
  return parts;
}

SweepResult Rows::finish() {
  result_.model_parts = model_parts();
  result_.statistics = account_.finish();
  std::ranges::copy_if(beyond_bound_, std::back_inserter(result_.statistics.beyond_bound),
                       [](const BeyondBound& each) { return each.rows > 0; });
  return std::move(result_);
}

void tell_shares(const std::vector<double>& sums, std::size_t rows, std::vector<ModelPart>& parts) {
  const double all = std::accumulate(sums.begin(), sums.end(), 0.0);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i].rms = std::sqrt(sums[i] / static_cast<double>(rows));
    parts[i].share = all > 0.0 ? sums[i] / all : 0.0;
  }
  std::ranges::stable_sort(parts, std::ranges::greater{}, &ModelPart::share);
}

void drop_parts(SweepResult& result) {
  result.bounces.clear();
  result.mechanisms.clear();
  for (ModelPart& part : result.model_parts) part.rows.clear();
}

}  // namespace raytube
