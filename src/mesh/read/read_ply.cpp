#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>

#include "core/text.h"
#include "mesh/files/numbers.h"
#include "mesh/files/text_scanner.h"
#include "mesh/read/formats.h"

namespace raytube {

namespace {

enum class Encoding { ascii, little_endian, big_endian };

struct Property {
  std::string name;
  NumberType type;
  std::optional<NumberType> count_type;  // of a list
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;

  std::optional<std::size_t> find(std::string_view property, bool list) const {
    for (std::size_t i = 0; i < properties.size(); ++i)
      if (properties[i].name == property && properties[i].count_type.has_value() == list) return i;
    return std::nullopt;
  }
};

struct Header {
  std::optional<Encoding> encoding;
  std::vector<Element> elements;
};

NumberType scalar_type(const TextScanner& scanner, std::string_view word) {
  static constexpr std::pair<std::string_view, NumberType> names[] = {
      {"char", NumberType::int8},      {"int8", NumberType::int8},       {"uchar", NumberType::uint8},
      {"uint8", NumberType::uint8},    {"short", NumberType::int16},     {"int16", NumberType::int16},
      {"ushort", NumberType::uint16},  {"uint16", NumberType::uint16},   {"int", NumberType::int32},
      {"int32", NumberType::int32},    {"uint", NumberType::uint32},     {"uint32", NumberType::uint32},
      {"float", NumberType::float32},  {"float32", NumberType::float32}, {"double", NumberType::float64},
      {"float64", NumberType::float64}};
  for (const auto& [name, type] : names)
    if (name == word) return type;
  scanner.reject(fmt::format("'{}' is not a PLY number type; correct the header or export the mesh again", quotable(word)));
}

Encoding encoding_of(const TextScanner& scanner, std::string_view word) {
  if (word == "ascii") return Encoding::ascii;
  if (word == "binary_little_endian") return Encoding::little_endian;
  if (word == "binary_big_endian") return Encoding::big_endian;
  scanner.reject(fmt::format("'{}' is not a PLY format; export the mesh as ascii or binary PLY", quotable(word)));
}

Property read_property(TextScanner& scanner) {
  Property property;
  std::string_view word = scanner.word();
  if (word == "list") {
    property.count_type = scalar_type(scanner, scanner.word());
    word = scanner.word();
  }
  property.type = scalar_type(scanner, word);
  property.name = scanner.word();
  return property;
}

Element read_element(TextScanner& scanner) {
  Element element;
  element.name = scanner.word();
  element.count = scanner.count(scanner.word());
  return element;
}

/// Reads up to and including the line `end_header`.
Header read_header(TextScanner& scanner) {
  if (!scanner.next_line() || scanner.word() != "ply")
    scanner.reject("a PLY file starts with the word 'ply'; export the mesh again");
  Header header;
  while (scanner.next_line()) {
    const std::string_view keyword = scanner.word();
    if (keyword == "format") header.encoding = encoding_of(scanner, scanner.word());
    if (keyword == "element") header.elements.push_back(read_element(scanner));
    if (keyword == "property") {
      if (header.elements.empty()) scanner.reject("a property stands before the first element; export the mesh again");
      header.elements.back().properties.push_back(read_property(scanner));
    }
    if (keyword == "end_header") {
      if (!header.encoding) scanner.reject("the header names no format; export the mesh again");
      scanner.skip_line();
      return header;
    }
    static constexpr std::string_view known[] = {"format", "element", "property", "comment", "obj_info"};
    if (std::ranges::find(known, keyword) == std::end(known))
      scanner.reject(
          fmt::format("'{}' is no word of a PLY header; correct the line or export the mesh again", quotable(keyword)));
  }
  scanner.reject("the header has no 'end_header'; the file is cut short, export it again");
}

/// The numbers after the header, one by one.
class Body {
 public:
  Body(const MeshFile& file, TextScanner& scanner, Encoding encoding)
      : file_(file), scanner_(scanner), encoding_(encoding), position_(scanner.position()) {}

  double next(NumberType type) {
    if (encoding_ == Encoding::ascii) return written(type);
    const std::size_t size = size_of(type);
    if (file_.bytes.size() - position_ < size) file_.reject("ends before its last number; it is cut short, export it again");
    position_ += size;
    return number_at(type, file_.bytes.data() + position_ - size, encoding_ == Encoding::big_endian);
  }

  /// Numbers beyond the last one announced would be lost in silence. Blanks and zeros that pad a file are none.
  void require_end() {
    const bool over = encoding_ == Encoding::ascii ? scanner_.word_of_any_line().empty()
                                                   : file_.bytes.find_first_not_of(padding, position_) == std::string::npos;
    if (!over) file_.reject("goes on after the last item its header announces; correct the counts there, or export it again");
  }

 private:
  static constexpr std::string_view padding{"\0 \t\r\n", 5};

  double written(NumberType type) {
    const std::string_view word = scanner_.word_of_any_line();
    if (type == NumberType::float32 || type == NumberType::float64) scanner_.note_digits(word);
    return scanner_.number(word);
  }

  const MeshFile& file_;
  TextScanner& scanner_;
  Encoding encoding_;
  std::size_t position_;
};

std::uint32_t whole(const MeshFile& file, double number, const char* what) {
  if (!(number >= 0.0 && number < no_index) || number != static_cast<std::uint32_t>(number))
    file.reject(fmt::format("{} is not {}; the file is damaged, export it again", number, what));
  return static_cast<std::uint32_t>(number);
}

/// One vertex, face or other thing: a list of numbers for each property, of length one if the property is no list.
void read_item(const MeshFile& file, Body& body, const Element& element, std::vector<std::vector<double>>& values) {
  values.resize(element.properties.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Property& property = element.properties[i];
    const std::uint32_t count = property.count_type ? whole(file, body.next(*property.count_type), "the length of a list") : 1;
    values[i].clear();
    for (std::uint32_t k = 0; k < count; ++k) values[i].push_back(body.next(property.type));
  }
}

void read_vertices(const MeshFile& file, Body& body, const Element& element, PolygonSoup& soup) {
  const auto x = element.find("x", false), y = element.find("y", false), z = element.find("z", false);
  if (!x || !y || !z) file.reject("its vertices lack x, y or z; export the mesh again");
  std::vector<std::vector<double>> values;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    read_item(file, body, element, values);
    soup.points.push_back({values[*x][0], values[*y][0], values[*z][0]});
  }
}

std::optional<std::size_t> find_corners(const Element& element) {
  const auto corners = element.find("vertex_indices", true);
  return corners ? corners : element.find("vertex_index", true);
}

void read_faces(const MeshFile& file, Body& body, const Element& element, PolygonSoup& soup) {
  const auto corners = find_corners(element);
  if (!corners) file.reject("its faces lack the list vertex_indices; export the mesh again");
  std::vector<std::vector<double>> values;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    read_item(file, body, element, values);
    std::vector<std::uint32_t>& polygon = soup.polygons.emplace_back();
    for (const double corner : values[*corners]) polygon.push_back(whole(file, corner, "a vertex number"));
  }
}

/// What is no vertex and no face. Triangle strips and the like hold surface; edges, cameras and what programs note beside the
/// surface do not.
void skip_items(const MeshFile& file, Body& body, const Element& element, PolygonSoup& soup) {
  if (element.count > 0 && find_corners(element))
    file.reject(fmt::format("its surface is in {} '{}', of which faces alone are read; export the mesh as faces", element.count,
                            quotable(element.name)));
  static constexpr std::string_view without_surface[] = {"edge", "camera", "material", "texture"};
  if (element.count > 0 && std::ranges::find(without_surface, element.name) == std::end(without_surface))
    soup.remarks.push_back(
        fmt::format("{} items '{}' left out, as vertices and faces alone are read; export them as faces if they "
                    "carry a surface",
                    element.count, quotable(element.name)));
  std::vector<std::vector<double>> values;
  for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i) read_item(file, body, element, values);
}

}  // namespace

PolygonSoup parse_ply(const MeshFile& file) {
  TextScanner scanner(file);
  const Header header = read_header(scanner);
  Body body(file, scanner, *header.encoding);
  PolygonSoup soup;
  for (const Element& element : header.elements) {
    if (element.name == "vertex")
      read_vertices(file, body, element, soup);
    else if (element.name == "face")
      read_faces(file, body, element, soup);
    else
      skip_items(file, body, element, soup);
  }
  body.require_end();
  soup.digits = scanner.digits();
  return soup;
}

}  // namespace raytube
