// What is told of a case, line by line.
#pragma once

#include <fmt/format.h>

#include <functional>
#include <string>
#include <utility>

#include "core/json.h"

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

}  // namespace raytube
