#include "jobs/check_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/decimal.h"
#include "jobs/memory.h"
#include "output/tables/sampled_rows.h"
#include "output/words/plural.h"
#include "output/words/summary.h"

namespace raytube {

namespace {

constexpr std::size_t most_lines = 10;

std::string line(const char* name, const std::string& text) { return fmt::format("{:<12} {}\n", name, text); }

double number_at(const Json& json, const char* name) { return json[name].get<double>(); }
std::uint64_t count_at(const Json& json, const char* name) { return json[name].get<std::uint64_t>(); }

dvec3 vector_of(const Json& json) { return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()}; }

std::vector<double> numbers_of(const Json& one_or_list) {
  return one_or_list.is_array() ? one_or_list.get<std::vector<double>>() : std::vector{one_or_list.get<double>()};
}

std::string values_text(const Json& one_or_list) {
  const std::vector<double> values = numbers_of(one_or_list);
  if (values.size() == 1) return number_text(values.front());
  return fmt::format("{} values from {} to {}", values.size(), number_text(values.front()), number_text(values.back()));
}

std::string lines_of(const Json& texts) {
  std::string text;
  for (const Json& each : texts) text += "  " + each.get<std::string>() + '\n';
  return text;
}

// The first entries of a list, and how many more there are.
template <class Entry>
std::string first_of(const Json& list, const char* others, const Entry& entry) {
  std::string text;
  for (std::size_t i = 0; i < std::min(list.size(), most_lines); ++i) text += "  " + entry(i, list[i]) + '\n';
  if (list.size() > most_lines) text += fmt::format("  and {} more {}\n", list.size() - most_lines, others);
  return text;
}

std::string directions_text(const Json& looks) {
  return fmt::format("theta {} deg, phi {} deg", values_text(looks["theta_deg"]), values_text(looks["phi_deg"]));
}

std::string looks_text(const Json& data) {
  const Json& c = data["case"];
  const std::string count = fmt::format("{} {}", count_at(data, "looks"), data["bistatic"] == true ? "bistatic" : "monostatic");
  const Json* const looks = find(c, "look");
  if (!looks) return count + ", from the positions in [radar]";
  if (looks->contains("looks_csv")) return count + ", listed in " + text_at(*looks, "looks_csv");
  if (looks->contains("list")) return count;
  const std::string transmit = count + ": " + directions_text(*looks);
  return c.contains("receive") ? transmit + "; receive " + directions_text(c["receive"]) : transmit;
}

std::string antenna_lines(const Json& data) {
  const Json* const radar = find(data["case"], "radar");
  if (!radar) return "";
  std::string text;
  if (const Json* range = find(*radar, "range_m"))
    text += line("antennas", fmt::format("{} m from the mesh's origin, the receiver {} m; S is the apparent amplitude",
                                         range->get<double>(), radar->value("receive_range_m", range->get<double>())));
  if (const Json* turns = find(*radar, "turntable_deg"))
    text += line("", fmt::format("the antennas stand still, the target turns: {} deg", values_text(*turns)));
  std::vector<std::string> beams;
  if (const Json* beam = find(*radar, "beamwidth_deg")) beams.push_back(fmt::format("beams of {} deg", values_text(*beam)));
  if (radar->contains("pattern_csv")) beams.push_back(text_at(*radar, "pattern_csv"));
  return beams.empty() ? text : text + line("", fmt::format("{}", fmt::join(beams, ", ")));
}

// How a body moves, or the antennas.
std::string moves_text(const Json& body) {
  std::vector<std::string> how;
  if (const double rate = body.value("deg_per_s", 0.0)) how.push_back(fmt::format("{:.4g} rev/min", std::abs(rate) / 6.0));
  for (const char* table : {"poses_csv", "track_csv"})
    if (body.contains(table)) how.push_back("poses of " + text_at(body, table));
  if (body.contains("poses")) how.push_back(fmt::format("{} poses", body["poses"].size()));
  const Json* const velocity = find(body, "velocity_m_per_s");
  if (const double v = velocity ? glm::length(vector_of(*velocity)) : 0.0) how.push_back(fmt::format("{:.4g} m/s", v));
  return how.empty() ? "stands" : fmt::format("{}", fmt::join(how, ", "));
}

// When, what moves, and what Doppler of the pulses resolves in the middle of the band: imaging/doppler.h.
std::string motion_lines(const Json& c, const std::vector<double>& ghz) {
  const Json* const motion = find(c, "motion");
  if (!motion) return "";
  std::string text;
  if (const Json* pulses = find(*motion, "pulses")) {
    const double interval = number_at(*pulses, "interval_s"), count = number_at(*pulses, "count"),
                 unambiguous = 0.5 * wavelength(0.5e9 * (std::ranges::min(ghz) + std::ranges::max(ghz))) / interval;
    text = line("motion", fmt::format("{} pulses, {:.4g} s apart: Doppler resolves {:.3g} m/s and repeats after {:.3g} m/s",
                                      count, interval, unambiguous / count, unambiguous));
  } else {
    text = line("motion", fmt::format("at {} s", values_text((*motion)["times_s"])));
  }
  if (const Json* radar = find(*motion, "radar")) text += line("", "antennas: " + moves_text(*radar));
  if (const Json* bodies = find(*motion, "bodies"))
    for (const auto& [name, body] : bodies->items())
      text += line("", name + (body.contains("on") ? " on " + text_at(body, "on") : "") + ": " + moves_text(body));
  return text;
}

std::string range_profile_line(const std::vector<double>& ghz) {
  std::vector<double> hertz;
  for (const double each : ghz) hertz.push_back(each * 1e9);
  if (hertz.size() < 4 || !in_even_steps(hertz)) return "";
  const double step = hertz[1] - hertz[0], count = static_cast<double>(hertz.size());
  return line("", fmt::format("in steps of {:.4g} GHz: a range profile resolves {:.3g} m and repeats after {:.3g} m", step / 1e9,
                              speed_of_light / (2.0 * step * count), speed_of_light / (2.0 * step)));
}

std::string tube_lines(const Json& c, double highest_ghz) {
  const Json &tubes = c["tubes"], &bounces = tubes["max_bounces"];
  if (text_at(c["edges"], "method") == "utd")
    return line("tubes", fmt::format("none: rays instead (edges.method \"utd\"), at most {} reflections", bounces.get<int>()));
  const char* const mode = text_at(tubes, "mode") == "uniform" ? "uniform" : "adaptive, cut exactly at edges";
  std::string text = line("tubes", fmt::format("{}, {} per wavelength at {} GHz, at most {} bounces", mode,
                                               number_at(tubes, "per_wavelength"), number_text(highest_ghz), bounces.get<int>()));
  if (const Json* up = find(tubes, "up")) {
    const dvec3 rows = vector_of(*up);
    text += line("", fmt::format("grid rows follow ({}, {}, {})", rows.x, rows.y, rows.z));
  }
  return text;
}

std::string edge_lines(const Json& edges) {
  const std::string method = text_at(edges, "method");
  if (method == "none") return line("edges", "none");
  if (method != "fringe") return "";
  return line("edges", fmt::format("fringe currents (PTD), order {}, creases of {} deg and more", count_at(edges, "order"),
                                   number_at(edges, "min_wedge_deg")));
}

std::string mesh_names(const Json& mesh) {
  return mesh.is_string() ? mesh.get<std::string>() : fmt::format("{}", fmt::join(mesh.get<std::vector<std::string>>(), ", "));
}

std::string case_text(const Json& data) {
  const Json &c = data["case"], &target = c["target"], &output = c["output"];
  const std::vector<double> ghz = numbers_of(c["frequency"]["ghz"]);
  const double highest = std::ranges::max(ghz);
  std::string text = line("size", size_text(vector_of(data["mesh"]["size_m"]), highest * 1e9));
  text += line("case", text_at(data, "case_file"));
  text += line("title", text_at(c, "title"));
  text += line("mesh", fmt::format("{}, one unit is {} m ({}){}", mesh_names(target["mesh"]), number_at(data, "metres_per_unit"),
                                   text_at(target, "unit"), data["materials"].empty() ? ", perfect conductor" : ""));
  text += line("frequency", values_text(c["frequency"]["ghz"]) + " GHz") + range_profile_line(ghz);
  text += line("looks", looks_text(data)) + antenna_lines(data) + motion_lines(c, ghz);
  if (const Json* ground = find(c, "ground")) {
    const std::string material = text_at(*ground, "material");
    text += line("ground", fmt::format("at z = {} m, {}", number_at(*ground, "height_m"),
                                       material == "pec" ? "perfect conductor: target and mirror image together"
                                                         : material + ": four paths"));
  }
  text += tube_lines(c, highest) + edge_lines(c["edges"]);
  text += line("plots", output["plots"] == true ? "yes" : "no");
  if (const Json* looks = find(output, "image_look"))
    text += line("images", fmt::format("look {}: {} cells per wavelength at {} GHz",
                                       fmt::join(looks->get<std::vector<std::size_t>>(), ", "),
                                       number_at(output, "image_per_wavelength"), number_text(number_at(data, "image_ghz"))));
  return text + line("rows", fmt::format("{}", count_at(data, "rows")));
}

std::string mesh_text(const Json& mesh) {
  const dvec3 center = vector_of(mesh["center_m"]);
  std::string text =
      fmt::format("\nmesh report\n  {} read, {} traced, {}\n", count_text(mesh["facets_read"], "facet"),
                  count_text(mesh["triangles_traced"], "triangle"), count_text(mesh["vertices"], "vertex", "vertices"));
  if (const Json* notes = find(mesh, "notes"))
    for (const Json& note : *notes) text += fmt::format("  {}: {}\n", text_at(note, "what"), count_at(note, "count"));
  text += fmt::format("  centre ({:.6g}, {:.6g}, {:.6g}) m, radius {:.6g} m\n", center.x, center.y, center.z,
                      number_at(mesh, "radius_m"));
  text += fmt::format("  planar patches: {}\n  components: {}\n", count_at(mesh, "patches"), mesh["bodies"].size());
  text += first_of(mesh["bodies"], "components", [](std::size_t i, const Json& body) {
    return fmt::format("component {}: {}, {}", i, text_at(body, "state"), count_text(body["triangles"], "triangle"));
  });
  return text + lines_of(mesh["shape"]);
}

std::string materials_text(const Json& lines) {
  std::string text = lines.empty() ? "" : "\n";
  for (const Json& each : lines) text += each.get<std::string>() + '\n';
  return text;
}

std::string wedges_text(const Json& wedges) {
  return fmt::format("\nwedges\n  {}, {:.6g} m in all\n", count_text(wedges["count"], "wedge"), number_at(wedges, "length_m")) +
         first_of(wedges["classes"], "angles",
                  [](std::size_t, const Json& each) {
                    return fmt::format("n = {:.3f} (interior {:.1f} deg): {}, {:.6g} m", number_at(each, "n"),
                                       number_at(each, "interior_deg"), count_text(each["count"], "wedge"),
                                       number_at(each, "length_m"));
                  }) +
         lines_of(wedges["notes"]);
}

std::string curved_text(const Json& curved) {
  const std::uint64_t all = curved["facets_of_all"], facets = curved["facets"];
  const std::string head = "\ncurved surfaces\n";
  if (curved["list"].empty()) return head + fmt::format("  none: all {} are flat\n", count_text(all, "facet"));
  return head +
         fmt::format("  {} of {} represent curved surfaces and are treated as {}{}\n", facets, count_text(all, "facet"),
                     text_at(curved, "counts_as"), count_at(curved, "facets_curved") < facets ? " (tubes.curved)" : "") +
         first_of(curved["list"], "pieces", [](std::size_t, const Json& piece) {
           return fmt::format("piece of {}: the surface rises above them by up to {:.3g} wavelengths",
                              count_text(piece["facets"], "facet"), number_at(piece, "rise_wavelengths"));
         });
}

std::string mechanisms_text(const Json& mechanisms) {
  std::string text = "\nmechanisms beside the tubes\n";
  for (const Json& each : mechanisms) {
    const std::string what = text_at(each, "what").empty() ? "" : ": " + text_at(each, "what");
    const std::string how = each["forced"] == true ? "on" : "auto, " + text_at(each, "when");
    text +=
        fmt::format("  {:<28}{}\n", text_at(each, "label"), each["on"] == true ? how + what : "off: " + text_at(each, "why_not"));
  }
  return text;
}

std::string cost_text(const Json& data) {
  const std::size_t looks = data["looks_computed"], patches = data["mesh"]["patches"];
  if (const Json* range = find(data, "ray_range_m")) {
    std::string text = "\nrays instead of currents (edges.method \"utd\")\n";
    if (*range > 0.0)
      text += fmt::format("  transmitter and receiver {:.6g} m from the origin; amplitudes are the apparent ones at that range\n",
                          range->get<double>());
    return text + fmt::format("  looks computed: {}; {} as mirrors, {}\n", looks,
                              count_text(patches, "planar patch", "planar patches"),
                              count_text(data["wedges"]["count"], "wedge"));
  }
  const Json& grid = data["launch_grid"];
  if (grid.is_null())
    return fmt::format("\ncost\n  looks computed: {}\n  adaptive tubes: {}; the fewer, the quicker, at any frequency\n", looks,
                       count_text(patches, "planar patch", "planar patches"));
  return fmt::format("\ncost\n  first look: {} x {} tubes of {:.4g} mm x {:.4g} mm\n  looks computed: {}\n",
                     count_at(grid, "columns"), count_at(grid, "rows"), number_at(grid, "du_m") * 1e3,
                     number_at(grid, "dv_m") * 1e3, looks);
}

std::string memory_lines(const Json& data) {
  const Json& memory = data["memory"];
  std::string text = fmt::format("\nmemory\n  at most about {}, {} with --parts, however dense the tubes are; {} available\n",
                                 memory_text(data["memory_bytes"]), memory_text(memory["with_parts_bytes"]),
                                 memory_text(memory["available_bytes"]));
  if (const Json* between = find(memory, "between_sheets_bytes"))
    text +=
        fmt::format("  plus about {} where sheets double the number of tubes up to its limit; more where many stand in a row\n",
                    memory_text(*between));
  return text;
}

std::string time_text(const Json& time) {
  const std::string threads = count_text(time["threads"], "thread");
  const std::string whole = seconds_text(time["solve_s"]), look = seconds_text(time["look_s"]);
  if (time["at_most"] == true)
    return fmt::format(
        "\ntime\n  at most about {} on {}, and at least {}: no look was finished in {:.0f} s, each takes at most about {}\n",
        whole, threads, seconds_text(time["least_s"]), number_at(time, "given_up_after_s"), look);
  return fmt::format("\ntime\n  about {} on {}, about {} a look ({} tried)\n", whole, threads, look,
                     count_at(time, "looks_tried"));
}

std::string ranks_text(const Json& ranks) {
  const std::uint64_t looks = ranks["looks"], threads = ranks["threads"], count = ranks["count"];
  std::string text =
      fmt::format("\nranks\n  {} {} on {} of {}; at most about {} of memory for rank 0, {} for each other one\n",
                  ranks["at_most"] == true ? "at most about" : "about", seconds_text(ranks["solve_s"]), count_text(count, "rank"),
                  count_text(threads, "thread"), memory_text(ranks["leader_memory_bytes"]), memory_text(ranks["memory_bytes"]));
  if (count * threads > looks)
    text += fmt::format("  there are only {} to compute: {} of {} would do as well\n", count_text(looks, "look"),
                        count_text((looks + threads - 1) / threads, "rank"), count_text(threads, "thread"));
  return text;
}

}  // namespace

std::string seconds_text(double seconds) {
  if (seconds < 120.0) return fmt::format("{:.2g} s", seconds);
  if (seconds < 7200.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.3g} h", seconds / 3600.0);
}

std::string check_text(const Json& data) {
  std::string text;
  if (data.contains("case"))
    text = case_text(data) + mesh_text(data["mesh"]) + materials_text(data["materials"]) + wedges_text(data["wedges"]) +
           curved_text(data["curved_surfaces"]) + mechanisms_text(data["mechanisms"]) + "\nskipped\n" +
           lines_of(data["skipped"]) + "\nwarnings\n" + (data["warnings"].empty() ? "  none\n" : lines_of(data["warnings"])) +
           cost_text(data) + memory_lines(data);
  if (const Json* time = find(data, "time")) text += time_text(*time);
  if (const Json* ranks = find(data, "ranks")) text += ranks_text(*ranks);
  return text;
}

}  // namespace raytube
