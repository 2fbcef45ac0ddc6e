#include <bit>
#include <cmath>
#include <map>
#include <vector>

#include "client/mesh/scan.h"
#include "client/mesh/words.h"

namespace collision::client {
namespace {

/// A number's kind, as the header names it.
struct Type {
  std::size_t bytes = 0;
  enum class Kind { kSigned, kUnsigned, kFloat } kind = Kind::kSigned;
};

struct Property {
  std::string name;
  bool is_list = false;
  Type count;  ///< Before a list.
  Type value;
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

Type TypeOf(const Words& words, std::string_view name) {
  using Kind = Type::Kind;
  static const std::map<std::string_view, Type> types = {
      {"char", {1, Kind::kSigned}},     {"int8", {1, Kind::kSigned}},
      {"uchar", {1, Kind::kUnsigned}},  {"uint8", {1, Kind::kUnsigned}},
      {"short", {2, Kind::kSigned}},    {"int16", {2, Kind::kSigned}},
      {"ushort", {2, Kind::kUnsigned}}, {"uint16", {2, Kind::kUnsigned}},
      {"int", {4, Kind::kSigned}},      {"int32", {4, Kind::kSigned}},
      {"uint", {4, Kind::kUnsigned}},   {"uint32", {4, Kind::kUnsigned}},
      {"float", {4, Kind::kFloat}},     {"float32", {4, Kind::kFloat}},
      {"double", {8, Kind::kFloat}},    {"float64", {8, Kind::kFloat}}};
  const auto type = types.find(name);
  if (type == types.end()) words.Fail("type " + Quoted(name) + " of a property is unknown");
  return type->second;
}

bool IsIndices(const Property& property) {
  return property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
}

struct Header {
  enum class Format { kNone, kText, kLittle, kBig } format = Format::kNone;
  std::vector<Element> elements;
  std::size_t body = 0;  ///< Where it begins.
};

constexpr std::string_view kOtherLineEnds("\r\f\v\0", 4);

/// Where the line of "end_header" ends.
std::size_t HeaderEnd(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = text.find('\n', at);
    if (end == text.npos) break;
    std::string_view line = text.substr(at, end - at);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    at = end + 1;
    if (line == "end_header") return at;
  }
  throw std::runtime_error("the header has no end_header: not a PLY file, or cut off");
}

Property ReadProperty(Words* words) {
  Property property;
  std::string_view type = words->Next();
  property.is_list = type == "list";
  if (property.is_list) {
    property.count = TypeOf(*words, words->Next());
    type = words->Next();
  }
  property.value = TypeOf(*words, type);
  property.name = words->Next();
  if (property.name.empty()) words->Fail("a property without a name");
  const bool counted = property.count.kind != Type::Kind::kFloat;
  if (counted && !(IsIndices(property) && property.value.kind == Type::Kind::kFloat)) {
    return property;
  }
  words->Fail("a list of " + Quoted(property.name) + " with floating-point counts or indices");
}

/// Of a face, one list may be that of its indices, whichever of its names it has.
void AddProperty(Words* words, Element* element) {
  Property property = ReadProperty(words);
  for (const Property& other : element->properties) {
    if (other.name != property.name && !(IsIndices(other) && IsIndices(property))) continue;
    words->Fail("property " + Quoted(property.name) + " of " + Quoted(element->name) +
                " is there twice");
  }
  element->properties.push_back(std::move(property));
}

void AddElement(Words* words, std::vector<Element>* elements) {
  Element element;
  element.name = words->Next();
  for (const Element& other : *elements) {
    if (other.name == element.name)
      words->Fail("element " + Quoted(element.name) + " is there twice");
  }
  const std::string_view count = words->Next();
  const auto number = NumberOf<std::uint64_t>(count);
  if (!number) words->Fail("number of elements " + Quoted(count) + ", allowed: 0 and more");
  element.count = *number;
  elements->push_back(std::move(element));
}

Header::Format ReadFormat(Words* words) {
  const std::string_view format = words->Next();
  if (format == "ascii") return Header::Format::kText;
  if (format == "binary_little_endian") return Header::Format::kLittle;
  if (format == "binary_big_endian") return Header::Format::kBig;
  words->Fail("unknown format " + Quoted(format));
}

/// Line by line and strictly: where this read a line otherwise than the library that reads the
/// body, the two would take the body for different things. The library trusts the header: of two
/// elements "vertex" it would write the second beyond the memory of the first.
void ReadHeaderLine(Words* words, Header* header) {
  const std::string_view keyword = words->Next();
  if (keyword.empty() || keyword == "comment" || keyword == "obj_info") return;
  if (keyword == "format") {
    if (header->format != Header::Format::kNone) words->Fail("the format is there twice");
    header->format = ReadFormat(words);
    words->Next();  // Its version.
  } else if (keyword == "element") {
    AddElement(words, &header->elements);
  } else if (keyword == "property") {
    if (header->elements.empty()) words->Fail("a property of no element");
    AddProperty(words, &header->elements.back());
  } else {
    words->Fail(Quoted(keyword) + ", allowed: comment, element, format, obj_info or property");
  }
  if (const std::string_view rest = words->Next(); !rest.empty()) {
    words->Fail(Quoted(rest) + " after the end of what " + Quoted(keyword) + " tells");
  }
}

Header ReadHeader(std::string_view text) {
  Header header;
  if (text.substr(0, 3) != "ply") throw std::runtime_error("not a PLY file");
  header.body = HeaderEnd(text);
  std::string_view rest = text.substr(0, header.body);
  for (std::size_t number = 1; !rest.empty(); ++number) {
    const std::size_t end = rest.find('\n');
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    Words words(line, number);
    if (line.find_first_of(kOtherLineEnds) != line.npos) {
      words.Fail("a control character that some take for the end of a line");
    }
    if (number == 1 && line != "ply") words.Fail("not \"ply\" alone");
    if (number > 1 && !rest.empty()) ReadHeaderLine(&words, &header);
  }
  if (header.format == Header::Format::kNone) throw std::runtime_error("the header has no format");
  return header;
}

/// Reads the values of the body in order.
class Body {
 public:
  virtual ~Body() = default;
  virtual double Value(const Type& type) = 0;
  /// Skips that many elements of that many bytes each at once, if it can.
  virtual bool Skip(std::uint64_t, std::size_t) { return false; }
  /// The current place, for messages.
  virtual std::string Where() const = 0;
};

class TextBody : public Body {
 public:
  explicit TextBody(std::string_view text) : words_(text) {}
  double Value(const Type&) override {
    const std::string_view word = words_.Next();
    if (word.empty())
      throw std::runtime_error("the file is cut off: values are missing at its end");
    const auto number = NumberOf<double>(word);
    if (!number) throw std::runtime_error(Where() + ": " + Quoted(word) + " is not a number");
    return *number;
  }
  std::string Where() const override {
    return "line " + std::to_string(words_.line()) + " after the header";
  }

 private:
  Words words_;
};

class BinaryBody : public Body {
 public:
  BinaryBody(std::string_view bytes, bool big) : bytes_(bytes), big_(big) {}
  double Value(const Type& type) override {
    Require(type.bytes <= bytes_.size() - at_);
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < type.bytes; ++i) {
      const std::size_t place = at_ + (big_ ? i : type.bytes - 1 - i);
      bits = bits << 8 | static_cast<unsigned char>(bytes_[place]);
    }
    at_ += type.bytes;
    if (type.kind == Type::Kind::kFloat) {
      return type.bytes == 4 ? std::bit_cast<float>(static_cast<std::uint32_t>(bits))
                             : std::bit_cast<double>(bits);
    }
    if (type.kind == Type::Kind::kUnsigned) return static_cast<double>(bits);
    const int shift = static_cast<int>(64 - 8 * type.bytes);
    return static_cast<double>(static_cast<std::int64_t>(bits << shift) >> shift);
  }
  bool Skip(std::uint64_t count, std::size_t size) override {
    Require(size == 0 || count <= (bytes_.size() - at_) / size);
    at_ += count * size;
    return true;
  }
  std::string Where() const override { return "byte " + std::to_string(at_) + " after the header"; }

 private:
  void Require(bool there) const {
    if (!there) throw std::runtime_error("the file is cut off: values are missing at its end");
  }
  std::string_view bytes_;
  bool big_;
  std::size_t at_ = 0;
};

/// Counts the corners of one face and checks their indices.
void ScanFace(const Element& element, std::uint64_t vertices, Body* body, MeshScan* scan) {
  std::uint64_t corners = 0;
  for (const Property& property : element.properties) {
    const double values = property.is_list ? body->Value(property.count) : 1;
    if (!(values >= 0)) throw std::runtime_error(body->Where() + ": a list of negative length");
    const bool indices = element.name == "face" && IsIndices(property);
    for (double i = 0; i < values; ++i) {
      const double value = body->Value(property.value);
      const bool whole = value == std::floor(value);
      if (!indices || (whole && value >= 0 && value < static_cast<double>(vertices))) continue;
      throw std::runtime_error(body->Where() + ": a face names vertex " + std::to_string(value) +
                               ", allowed: 0 to " + std::to_string(vertices) + " - 1");
    }
    if (indices) corners = static_cast<std::uint64_t>(values);
  }
  ++(corners < 3 ? scan->thin : scan->faces);
}

void ScanOther(const Element& element, Body* body) {
  std::size_t bytes = 0;
  bool lists = false;
  for (const Property& property : element.properties) {
    lists = lists || property.is_list;
    bytes += property.value.bytes;
  }
  if (!lists && body->Skip(element.count, bytes)) return;
  MeshScan ignored;
  // Without a property an element has no bytes, however many there are.
  const std::uint64_t count = element.properties.empty() ? 0 : element.count;
  for (std::uint64_t i = 0; i < count; ++i) ScanFace(element, ~std::uint64_t{0}, body, &ignored);
}

bool HasIndices(const Element& element) {
  for (const Property& property : element.properties) {
    if (IsIndices(property)) return true;
  }
  return false;
}

}  // namespace

MeshScan ScanPly(std::string_view text) {
  const Header header = ReadHeader(text);
  TextBody words(text.substr(header.body));
  BinaryBody bytes(text.substr(header.body), header.format == Header::Format::kBig);
  Body* const body = header.format == Header::Format::kText ? static_cast<Body*>(&words) : &bytes;
  MeshScan scan;
  std::uint64_t vertices = 0;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") vertices = element.count;
    if (element.name == "face" && HasIndices(element)) {
      for (std::uint64_t i = 0; i < element.count; ++i) ScanFace(element, vertices, body, &scan);
    } else {
      ScanOther(element, body);
    }
  }
  if (scan.faces == 0) throw std::runtime_error("no faces (elements \"face\" with vertex_indices)");
  return scan;
}

}  // namespace collision::client
