// The numbers of the benchmark report, as JSON on the standard output: bench/run makes tables and plots of them.
//   report_data STUDY [--quick] [--threads N] [--repeat N]       STUDY: machine, error, throughput, growth or jobs
#include <fmt/format.h>
#include <tbb/info.h>

#include <CLI/CLI.hpp>

#include "bodies.h"
#include "core/instruction_set.h"
#include "shapes.h"
#include "studies.h"

namespace {

using namespace raytube;
using namespace raytube::bench;

Json machine(const Settings& settings) {
  const LoadedMesh plate = build_mesh(shapes::plate(1.0), 1.0);
  return {{"compiler", RAYTUBE_COMPILER},
          {"embree", name_of(allowed_instruction_set())},
          {"cores", tbb::info::default_concurrency()},
          {"threads", settings.threads},
          {"repeats", settings.repeats}};
}

}  // namespace

int main(int argc, char** argv) {
  const std::map<std::string, Json (*)(const Settings&)> studies = {{"machine", machine},
                                                                    {"error", error_study},
                                                                    {"throughput", throughput_study},
                                                                    {"growth", growth_study},
                                                                    {"jobs", job_study}};
  Settings settings;
  std::string study;
  CLI::App app("Numbers of the benchmark report");
  app.add_option("study", study)->required()->check(CLI::IsMember(studies));
  app.add_flag("--quick", settings.quick, "small sizes only");
  app.add_option("--threads", settings.threads);
  app.add_option("--repeat", settings.repeats, "runs of which the median is taken");
  CLI11_PARSE(app, argc, argv);
  fmt::print("{}\n", studies.at(study)(settings).dump(1));
}
