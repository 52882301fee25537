// XML as elements that begin and end (Expat), with the line number for messages.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "mesh/files/mesh_file.h"

namespace raytube {

/// One XML text, read once. Errors name its place in the mesh file.
class XmlReader {
 public:
  /// An element's attributes, as long as its beginning is dealt with.
  class Element {
   public:
    Element(const XmlReader& reader, std::string_view element_name, const char* const* attributes)
        : name(element_name), reader_(reader), attributes_(attributes) {}

    std::string_view name;  // "namespace|name"; the name alone where there is no namespace

    /// Nothing if there is no attribute of that name.
    std::optional<std::string_view> find(std::string_view attribute) const;
    /// Each rejects the file if the attribute is missing or not of its kind.
    std::string_view text(std::string_view attribute) const;
    double coordinate(std::string_view attribute) const;
    std::uint32_t index(std::string_view attribute) const;

   private:
    const XmlReader& reader_;
    const char* const* attributes_;
  };

  /// `part` names the text inside the file.
  XmlReader(const MeshFile& file, std::string part) : file_(file), part_(std::move(part)) {}

  std::function<void(const Element&)> begin = [](const Element&) {};
  std::function<void(std::string_view)> end = [](std::string_view) {};
  /// A prefix and the namespace it stands for.
  std::function<void(std::string_view, std::string_view)> prefix = [](std::string_view, std::string_view) {};

  /// Throws InputError, also whatever the functions above throw.
  void read(std::string_view text);

  /// The number that a text stands for; rejects the file if it is none or not finite.
  double finite_number(std::string_view text) const;

  [[noreturn]] void reject(const std::string& sentence) const;

 private:
  struct Callbacks;
  const MeshFile& file_;
  std::string part_;
  std::size_t line_ = 0;
};

}  // namespace raytube
