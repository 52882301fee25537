#include "jobs/moving.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

#include "case/target.h"
#include "core/bytes.h"
#include "jobs/joined_results.h"
#include "jobs/retrace.h"
#include "jobs/solvable.h"
#include "jobs/warnings/warnings.h"
#include "plan/admissible.h"
#include "plan/phase_reference.h"
#include "solve/rows.h"
#include "solve/shared_items.h"

namespace raytube {

namespace {

bool turns(const Pose& pose) { return pose.turn != dmat3(1.0); }

// Seen from a body that is turned and shifted.
Look seen_from(const Pose& pose, Look look) {
  if (!turns(pose)) return look;
  const bool monostatic = look.transmit == look.receive;
  const auto turned = [&](const Direction& from) { return direction_of(spherical_basis(from).radial * pose.turn); };
  look.transmit = turned(look.transmit);
  look.receive = monostatic ? look.transmit : turned(look.receive);
  return look;
}

using Basis = std::array<std::array<double, 2>, 2>;  // [of the body][of the antennas]

// V and H of a direction of the antennas in those of the same one as the body sees it.
Basis turned_basis(const Direction& antennas, const Direction& body, const dmat3& turn) {
  const SphericalBasis a = spherical_basis(antennas), b = spherical_basis(body);
  const dvec3 v = a.theta_hat * turn, h = a.phi_hat * turn;
  return {{{glm::dot(b.theta_hat, v), glm::dot(b.theta_hat, h)}, {glm::dot(b.phi_hat, v), glm::dot(b.phi_hat, h)}}};
}

// A change of bases from both sides: of amplitudes by their signs, of errors by magnitude, which bounds them.
template <class Row, class Factor>
Row turned(const Row& body, const Basis& receive, const Basis& transmit, Factor factor, auto at) {
  Row antennas{};
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q)
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) at(antennas, p, q) += factor(receive[i][p]) * at(body, i, j) * factor(transmit[j][q]);
  return antennas;
}

// A case that stands, and has no looks yet. Those of all times together may take more than all the rest of it.
Case without_looks(const Case& c) {
  Case rest = c;
  rest.sweep.looks.clear(), rest.sweep.times.clear();
  rest.motion.reset();
  return rest;
}

Case with_looks_of_pulse(Case rest, const Case& c, std::size_t pulse) {
  const auto first = c.sweep.looks.begin() + static_cast<std::ptrdiff_t>(pulse * c.looks_at_a_time());
  rest.sweep.looks.assign(first, first + static_cast<std::ptrdiff_t>(c.looks_at_a_time()));
  return rest;
}

std::string bytes_of(const SweepResult& result) {
  ByteWriter writer;
  writer(result);
  return writer.take();
}

// Known before hours of work, not after.
void check_antennas_of_pulses(const Case& c, const MovingTarget& target) {
  if (all_far(c.sweep)) return;
  const Case rest = without_looks(c);
  for (std::size_t pulse = 0; pulse < c.times(); ++pulse) {
    const double time = c.sweep.times[pulse * c.looks_at_a_time()];
    TriangleMesh points;
    points.vertices = target.corners(time);
    points.center = bounding_box(points.vertices).middle();
    for (dvec3& vertex : points.vertices) vertex -= points.center;
    naming_the_case(c, [&] { saying_when(time, [&] { check_antennas(points, with_looks_of_pulse(rest, c, pulse).sweep); }); });
  }
}

// Mechanisms are kept apart whether asked for or not, so that what is kept serves both.
SharedItems<SweepResult> pulses_of(const Case& c, const MovingTarget& target, int threads) {
  const std::size_t all = static_cast<std::size_t>(threads > 0 ? threads : all_threads());
  const int within = static_cast<int>(std::max<std::size_t>(1, all / c.times()));
  const std::size_t rows = c.looks_at_a_time() * c.sweep.frequencies.size();
  return {c.times(), threads,
          [&c, &target, within, without = without_looks(c)](std::size_t pulse, Progress& progress, double share) {
            const Case then = with_looks_of_pulse(without, c, pulse);
            const double time = c.sweep.times[pulse * c.looks_at_a_time()];
            const Target posed(target.at(time).mesh, then.wedges);
            double told = 0.0;
            SweepResult result = saying_when(time, [&] {
              return solve(plan_of_case(posed, then, within, true), [&](double done) {
                progress.add(share * std::max(0.0, done - std::exchange(told, std::max(told, done))));
                return true;
              });
            });
            stop_if_cancelled();
            progress.add(share * (1.0 - told));
            return result;
          },
          bytes_of,
          [rows](const std::string& bytes) -> std::optional<SweepResult> {
            SweepResult result;
            ByteReader reader(bytes);
            reader(result);
            if (!reader.fits() || result.total.size() != rows) return {};
            return result;
          }};
}

}  // namespace

bool is_one_plan(const Case& c, const MovingTarget& target) {
  if (!target.moves_as_one()) return false;
  if (target.stands()) return true;
  const auto turned = [&](double time) { return turns(target.pose(time)); };
  if (any_rough(c.sweep.materials) && std::ranges::any_of(c.sweep.times, turned)) return false;
  return !c.ground && c.edges.method != EdgeMethod::utd && std::ranges::all_of(c.sweep.looks, &Look::far);
}

Case case_of_pulse(const Case& c, std::size_t pulse) { return with_looks_of_pulse(without_looks(c), c, pulse); }

Case case_of_plan(const Case& c, const MovingTarget& target) {
  if (!is_one_plan(c, target)) return case_of_pulse(c, 0);
  Case body = c;
  for (std::size_t i = 0; i < body.sweep.looks.size(); ++i)
    body.sweep.looks[i] = seen_from(target.pose(c.sweep.times[i]), c.sweep.looks[i]);
  body.sweep.times.clear();
  body.motion.reset();
  return body;
}

Case case_of_plan(const Case& c, const MovingTarget* target) {
  if (!target) return c;
  return case_of_plan(is_one_plan(c, *target) ? computed_case(c, *target) : c, *target);
}

LoadedMesh mesh_of_plan(const Case& c, const MovingTarget& target) {
  return is_one_plan(c, target) ? target.at_rest() : target.at(c.sweep.times.front());
}

LoadedCaseTarget load_target_of_plan(const Case& c) {
  if (!c.motion) return {nullptr, load_target(c)};
  auto moving = std::make_shared<const MovingTarget>(read_target(c), c);
  LoadedMesh loaded = mesh_of_plan(c, *moving);
  return {std::move(moving), std::move(loaded)};
}

std::vector<std::string> warnings_before(const Case& c, const SolvePlan& plan, std::span<const dvec3> outermost,
                                         const MovingTarget* target) {
  if (!target) return warnings_of(c, plan, outermost);
  if (!is_one_plan(c, *target)) check_antennas_of_pulses(c, *target);
  std::vector<std::string> sentences = warnings_of(case_of_pulse(c, 0), plan, outermost);
  std::ranges::copy(target->warnings(c.sweep), std::back_inserter(sentences));
  return sentences;
}

void refer_to_antennas(const Case& c, const MovingTarget& target, SweepResult& result) {
  if (target.stands()) return;
  const Sweep& sweep = c.sweep;
  for (std::size_t look = 0; look < sweep.looks.size(); ++look) {
    const Look& asked = sweep.looks[look];
    const Pose pose = target.pose(sweep.times[look]);
    const Look body = seen_from(pose, asked);
    const Basis receive = turned_basis(asked.receive, body.receive, pose.turn),
                transmit = turned_basis(asked.transmit, body.transmit, pose.turn);
    for (std::size_t f = 0; f < sweep.frequencies.size(); ++f) {
      const std::size_t row = sweep.row(look, f);
      const Complex phase = shifted_phase(pose.shift, asked, sweep.frequencies[f]);
      const auto refer = [&](ScatteringMatrix& s) {
        if (turns(pose))
          s = turned(
              s, receive, transmit, std::identity(), [](auto& m, int p, int q) -> auto& { return m.s[p][q]; });
        s *= phase;
      };
      const auto refer_error = [&](ChannelErrors& e) {
        if (turns(pose))
          e = turned(
              e, receive, transmit, [](double x) { return std::abs(x); }, [](auto& m, int p, int q) -> auto& { return m[p][q]; });
      };
      refer(result.total[row]);
      for (std::vector<ScatteringMatrix>& column : result.bounces) refer(column[row]);
      for (MechanismRows& mechanism : result.mechanisms)
        if (!mechanism.rows.empty()) refer(mechanism.rows[row]);
      refer_error(result.error[row]), refer_error(result.model[row]);
      for (ModelPart& part : result.model_parts)
        if (!part.rows.empty()) refer_error(part.rows[row]);
    }
  }
}

SweepResult solve_pulses(const Case& c, const MovingTarget& target, int threads, bool keep_parts,
                         const std::function<bool(double)>& progress, const KeptLooks& kept, WorkTeam* team) {
  const auto start = std::chrono::steady_clock::now();
  if (kept.begin) kept.begin(c.times());
  std::vector<SweepResult> found(c.times());
  compute_shared<SweepResult>(pulses_of(c, target, threads), {}, progress, kept, team,
                              [&](std::size_t pulse, const SweepResult& result) {
                                found[pulse] = result;
                                if (!keep_parts) drop_parts(found[pulse]);
                              });
  SweepResult all = joined_results(std::move(found), c.looks_at_a_time());
  all.statistics.solve_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return all;
}

void solve_shard_of_pulses(const Case& c, const MovingTarget& target, const Shard& shard, int threads,
                           const std::function<bool(double)>& progress, const KeptLooks& kept, WorkTeam* team) {
  compute_shard(pulses_of(c, target, threads), shard, progress, kept, team);
}

void help_to_solve_pulses(const Case& c, const MovingTarget& target, int threads, WorkTeam& team,
                          const std::function<bool(double)>& progress) {
  compute_for_leader(pulses_of(c, target, threads), team, progress);
}

}  // namespace raytube
