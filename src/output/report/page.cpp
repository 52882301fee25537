#include "output/report/page.h"

#include <array>
#include <utility>

#include "output/report/assets.h"

namespace raytube {

namespace {

// JSON inside an element of a page, which ends at the first "</script" inside it: "<" stands in its strings alone.
std::string inside_script(std::string_view json) {
  std::string safe;
  safe.reserve(json.size());
  for (const char c : json) c == '<' ? safe += "\\u003c" : safe += c;
  return safe;
}

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '<')
      safe += "&lt;";
    else if (c == '&')
      safe += "&amp;";
    else
      safe += c;
  }
  return safe;
}

}  // namespace

std::string report_page(const JsonValue& data, std::string_view title, std::string_view three) {
  std::string scripts;
  for (const std::string_view script : asset_scripts) scripts.append(script).append("\n");
  const std::array<std::pair<std::string_view, std::string>, 5> parts = {{{"@title@", escaped(title)},
                                                                          {"@style@", std::string(asset_style)},
                                                                          {"@data@", inside_script(json_text(data, -1))},
                                                                          {"@three@", std::string(three)},
                                                                          {"@script@", scripts}}};
  std::string page(report_head);
  std::string_view rest = asset_page;
  for (const auto& [mark, text] : parts) {
    const std::size_t at = rest.find(mark);
    page.append(rest.substr(0, at)).append(text);
    rest.remove_prefix(at + mark.size());
  }
  return page.append(rest);
}

}  // namespace raytube
