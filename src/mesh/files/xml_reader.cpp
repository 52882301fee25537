#include "mesh/files/xml_reader.h"

#include <expat.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <exception>
#include <memory>
#include <new>

#include "core/text.h"
#include "mesh/files/text_scanner.h"

namespace raytube {

namespace {

// Stands between an element's name and its namespace.
constexpr char namespace_end = '|';

// From 2.9 on Expat has a name of its own for numbers of 64 bits, and warns of the old one.
std::size_t current_line(XML_Parser parser) {
#if XML_MAJOR_VERSION > 2 || XML_MINOR_VERSION >= 9
  return XML_GetCurrentLineNumber64(parser);
#else
  return XML_GetCurrentLineNumber(parser);
#endif
}

}  // namespace

/// What Expat calls. Nothing is thrown through it: an exception waits until it has returned.
struct XmlReader::Callbacks {
  XmlReader& reader;
  XML_Parser parser;
  std::exception_ptr thrown = nullptr;

  template <class Action>
  static void guard(void* callbacks, const Action& action) {
    auto& [reader, parser, thrown] = *static_cast<Callbacks*>(callbacks);
    reader.line_ = current_line(parser);
    try {
      if (!thrown) action(reader);
    } catch (...) {
      thrown = std::current_exception();
      XML_StopParser(parser, XML_FALSE);
    }
  }

  static void on_begin(void* self, const char* name, const char** attributes) {
    guard(self, [&](XmlReader& reader) { reader.begin({reader, name, attributes}); });
  }
  static void on_end(void* self, const char* name) {
    guard(self, [&](XmlReader& reader) { reader.end(name); });
  }
  static void on_prefix(void* self, const char* prefix, const char* uri) {
    guard(self, [&](XmlReader& reader) { reader.prefix(prefix ? prefix : "", uri ? uri : ""); });
  }
};

std::optional<std::string_view> XmlReader::Element::find(std::string_view attribute) const {
  for (const char* const* entry = attributes_; *entry; entry += 2)
    if (*entry == attribute) return entry[1];
  return std::nullopt;
}

std::string_view XmlReader::Element::text(std::string_view attribute) const {
  const std::optional<std::string_view> value = find(attribute);
  if (!value) reader_.reject(fmt::format("the attribute '{}' is missing; the file is damaged, export it again", attribute));
  return *value;
}

double XmlReader::Element::coordinate(std::string_view attribute) const { return reader_.finite_number(text(attribute)); }

std::uint32_t XmlReader::Element::index(std::string_view attribute) const {
  const std::string_view digits = text(attribute);
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size())
    reader_.reject(fmt::format("'{}' is not a vertex number; the file is damaged, export it again", quotable(digits)));
  return value;
}

double XmlReader::finite_number(std::string_view text) const {
  const std::optional<double> value = number_of(text);
  if (!value || !std::isfinite(*value))
    reject(fmt::format("'{}' is not a finite number; correct the line or export the mesh again", quotable(text)));
  return *value;
}

void XmlReader::read(std::string_view text) {
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(XML_ParserCreateNS(nullptr, namespace_end),
                                                                            XML_ParserFree);
  if (!parser) throw std::bad_alloc();
  Callbacks callbacks{*this, parser.get()};
  XML_SetUserData(parser.get(), &callbacks);
  XML_SetElementHandler(parser.get(), Callbacks::on_begin, Callbacks::on_end);
  XML_SetStartNamespaceDeclHandler(parser.get(), Callbacks::on_prefix);
  constexpr std::size_t most_at_once = 1 << 26;  // Expat counts in int
  bool whole = true;
  do {
    const std::string_view piece = text.substr(0, most_at_once);
    text.remove_prefix(piece.size());
    whole = XML_Parse(parser.get(), piece.data(), static_cast<int>(piece.size()), text.empty()) == XML_STATUS_OK;
  } while (whole && !text.empty());
  if (callbacks.thrown) std::rethrow_exception(callbacks.thrown);
  line_ = current_line(parser.get());
  if (!whole)
    reject(fmt::format("its XML is damaged or cut short ({}); export the mesh again",
                       XML_ErrorString(XML_GetErrorCode(parser.get()))));
}

void XmlReader::reject(const std::string& sentence) const {
  file_.reject(fmt::format("{}, line {}: {}", quotable(part_), line_, sentence));
}

}  // namespace raytube
