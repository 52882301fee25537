#include "point_source/sources_csv.h"

#include <fmt/format.h>

#include <cmath>

#include "core/decimal.h"
#include "output/files/files.h"

namespace raytube {

namespace {

constexpr const char* meanings =
    "# Rays from a source through a scene, one row for each position, launch model, number of rays and part of the scene.\n"
    "# first_hits: rays that meet the part before anything else; all_hits: every time a ray meets it. direct_percent = 100 "
    "first_hits / rays; hit_percent = 100 all_hits / rays.\n"
    "# limit_percent: what direct_percent of this model tends to, exact; limit_bound_percent: how far it can be from that "
    "(random: "
    "four standard deviations).\n"
    "# exact_percent: the share of the full solid angle in which the source sees the part. estimate_percent: the same from the "
    "rays, "
    "each weighted by what it stands for, with its bound.\n"
    "# response_percent: all_hits weighted in the same way: hits per hundred rays of a source that shines alike in all "
    "directions.\n"
    "# escaped, absorbed, cut: how the rays ended (cut: after the last reflection allowed). seconds: launch, trace and count of "
    "all "
    "parts together. An empty cell: not defined for this model, or too costly for this scene.\n";

constexpr const char* source_columns =
    "position,x_m,y_m,z_m,model,rays_asked,rays,part,first_hits,all_hits,direct_percent,hit_percent,limit_percent,"
    "limit_bound_percent,exact_percent,estimate_percent,estimate_bound_percent,response_percent,escaped,absorbed,cut,seconds\n";

std::string percent(double share) { return std::isnan(share) ? "" : number_text(rounded_to_15_digits(100.0 * share)); }

std::string ratio(std::uint64_t part, std::uint64_t whole) {
  return percent(static_cast<double>(part) / static_cast<double>(whole));
}

std::string row(const SourceRun& run, const PartHits& part, const std::string& name) {
  const std::string position =
      fmt::format("{},{},{},{}", run.position, number_text(run.point.x), number_text(run.point.y), number_text(run.point.z));
  const std::string counts = fmt::format("{},{},{},{},{},{}", launch_model_name(run.model), run.rays_asked, run.rays, name,
                                         part.first_hits, part.all_hits);
  const std::string shares =
      fmt::format("{},{},{},{},{},{},{},{}", ratio(part.first_hits, run.rays), ratio(part.all_hits, run.rays),
                  percent(part.limit), percent(part.limit_bound), percent(part.exact), percent(part.estimate),
                  percent(part.estimate_bound), percent(part.response));
  return fmt::format("{},{},{},{},{},{},{:.4g}\n", position, counts, shares, run.escaped, run.absorbed, run.cut, run.seconds);
}

struct MarkedPoint {
  dvec3 point;
  LaunchModel model;
  std::uint32_t bounce;
};

void write_points_ply(const std::filesystem::path& path, const std::string& what, const std::vector<MarkedPoint>& points,
                      bool bounces) {
  OutputFile file(path);
  file.write("ply\nformat ascii 1.0\ncomment " + what + ", lengths in m; model:");
  for (std::size_t i = 0; i < launch_model_names.size(); ++i) file.write(fmt::format(" {} {}", i, launch_model_names[i]));
  file.write(
      fmt::format("\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\nproperty uchar model\n{}"
                  "end_header\n",
                  points.size(), bounces ? "property ushort bounce\n" : ""));
  for (const MarkedPoint& p : points)
    file.write(fmt::format("{} {} {} {}{}\n", number_text(p.point.x), number_text(p.point.y), number_text(p.point.z),
                           static_cast<int>(p.model), bounces ? fmt::format(" {}", p.bounce) : ""));
  file.commit();
}

}  // namespace

void write_sources_csv(const std::filesystem::path& path, const SourceStudy& study) {
  OutputFile file(path);
  file.write(meanings);
  file.write(source_columns);
  for (const SourceRun& run : study.runs)
    for (std::size_t part = 0; part < run.parts.size(); ++part) file.write(row(run, run.parts[part], study.part_names[part]));
  file.commit();
}

void write_launch_ply(const std::filesystem::path& path, const SourceStudy& study) {
  std::vector<MarkedPoint> points;
  for (const SourceView& view : study.views)
    for (const dvec3& point : view.launch_points) points.push_back({point, view.model, 0});
  write_points_ply(path, "launch points", points, false);
}

void write_hits_ply(const std::filesystem::path& path, const SourceStudy& study) {
  std::vector<MarkedPoint> points;
  for (const SourceView& view : study.views)
    for (const CountedHit& hit : view.hits) points.push_back({hit.point, view.model, hit.bounce});
  write_points_ply(path, "hits on " + study.part_names[study.counted], points, true);
}

}  // namespace raytube
