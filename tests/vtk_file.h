// What VTK's XML files hold.
#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace raytube::testing {

/// The numbers of the array of this name; none if there is no such array.
inline std::vector<double> vtk_numbers(const std::string& text, const std::string& name) {
  const std::size_t begin = text.find("Name=\"" + name + "\"");
  if (begin == std::string::npos) return {};
  const std::size_t from = text.find('>', begin) + 1;
  std::istringstream body(text.substr(from, text.find('<', from) - from));
  std::vector<double> values;
  for (double value; body >> value;) values.push_back(value);
  return values;
}

}  // namespace raytube::testing
