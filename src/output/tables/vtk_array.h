// Arrays of VTK's XML files.
#pragma once

#include <fmt/format.h>

#include <string>

#include "output/files/files.h"

namespace raytube {

/// One array, a value a line; ends with its scope.
class DataArray {
 public:
  DataArray(OutputFile& out, const char* type, const std::string& name, int components = 1) : out_(out) {
    out_.write(
        fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n", type, name, components));
  }
  ~DataArray() { out_.write("</DataArray>\n"); }
  DataArray(const DataArray&) = delete;

  void line(const std::string& text) { out_.write(text + '\n'); }

 private:
  OutputFile& out_;
};

}  // namespace raytube
