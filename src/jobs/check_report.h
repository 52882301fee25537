// What a run of a case would do, without doing it.
#pragma once

#include <fmt/format.h>

#include <functional>
#include <string>

#include "case/data/case.h"
#include "core/json.h"
#include "mesh/model/triangle_mesh.h"
#include "plan/plan.h"
#include "solve/probe.h"

namespace raytube {

/// A report for people, told as it is found out, and the same as data.
class CheckReport {
 public:
  explicit CheckReport(std::function<void(const std::string&)> tell) : tell_(std::move(tell)) {}

  template <class... Values>
  void print(fmt::format_string<Values...> format, Values&&... values) {
    tell_(fmt::format(format, std::forward<Values>(values)...));
  }

  JsonValue data;

 private:
  std::function<void(const std::string&)> tell_;
};

/// "0.12 s", "17 min"
std::string seconds_text(double seconds);

/// The resolved case, mesh, wedges, curved surfaces, what is skipped, warnings, cost and memory. The plan is that of the case.
void tell_case(CheckReport& report, const Case& c, const MeshReport& counts, const SolvePlan& plan);

/// How long it will take, from looks that are timed for some seconds.
TimePrediction tell_time(CheckReport& report, const SolvePlan& plan);

}  // namespace raytube
