#include "idl/shape_bytes.h"

#include <bit>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string_view>

namespace collision {
namespace {

using std::literals::string_view_literals::operator""sv;

constexpr std::string_view kFormat = "CSHAPE\0\1"sv;

template <class Unsigned>
void Append(Unsigned value, std::string* bytes) {
  for (std::size_t i = 0; i < sizeof value; ++i) {
    *bytes += static_cast<char>(value >> (8 * i) & 0xff);
  }
}

std::uint32_t Count(const char* what, std::size_t count) {
  if (count <= std::numeric_limits<std::uint32_t>::max()) return static_cast<std::uint32_t>(count);
  throw std::length_error(std::string(what) + ": " + std::to_string(count) +
                          ", allowed 0 to 4294967295");
}

/// Hands out numbers from the front. There are enough: the length has been checked.
class Front {
 public:
  explicit Front(const char* bytes) : bytes_(bytes) {}

  template <class Unsigned>
  Unsigned Take() {
    Unsigned value = 0;
    for (std::size_t i = 0; i < sizeof value; ++i) {
      value |= static_cast<Unsigned>(static_cast<unsigned char>(*bytes_++)) << (8 * i);
    }
    return value;
  }

 private:
  const char* bytes_;
};

}  // namespace

std::string EncodeShape(const ShapeContent& content) {
  std::string bytes(kFormat);
  Append(Count("vertices", content.vertices.size()), &bytes);
  Append(Count("triangles", content.triangles.size()), &bytes);
  bytes.reserve(kShapeHeaderBytes + kShapeVertexBytes * content.vertices.size() +
                kShapeTriangleBytes * content.triangles.size());
  for (const auto& vertex : content.vertices) {
    for (const double x : vertex) Append(std::bit_cast<std::uint64_t>(x), &bytes);
  }
  for (const auto& triangle : content.triangles) {
    for (const std::uint32_t index : triangle) Append(index, &bytes);
  }
  return bytes;
}

std::optional<ShapeContent> DecodeShape(const std::string& bytes, std::string* error) {
  if (bytes.size() < kShapeHeaderBytes) {
    *error = std::to_string(bytes.size()) + " bytes are no shape; at least " +
             std::to_string(kShapeHeaderBytes) + " are needed";
    return std::nullopt;
  }
  if (!std::string_view(bytes).starts_with(kFormat)) {
    *error = "not in the format of a shape: it does not begin with CSHAPE, 0, 1";
    return std::nullopt;
  }
  Front front(bytes.data() + kFormat.size());
  const std::uint64_t vertices = front.Take<std::uint32_t>();
  const std::uint64_t triangles = front.Take<std::uint32_t>();
  // At most 24 (2^32 - 1) + 12 (2^32 - 1) + 16: no overflow.
  const std::uint64_t needed =
      kShapeHeaderBytes + kShapeVertexBytes * vertices + kShapeTriangleBytes * triangles;
  if (bytes.size() != needed) {
    *error = std::to_string(bytes.size()) + " bytes; " + std::to_string(vertices) +
             " vertices and " + std::to_string(triangles) + " triangles take " +
             std::to_string(needed);
    return std::nullopt;
  }
  ShapeContent content;
  content.vertices.resize(vertices);
  content.triangles.resize(triangles);
  for (auto& vertex : content.vertices) {
    for (double& x : vertex) x = std::bit_cast<double>(front.Take<std::uint64_t>());
  }
  for (auto& triangle : content.triangles) {
    for (std::uint32_t& index : triangle) index = front.Take<std::uint32_t>();
  }
  return content;
}

}  // namespace collision
