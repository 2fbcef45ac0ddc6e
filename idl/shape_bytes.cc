#include "idl/shape_bytes.h"

#include <bit>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string_view>

namespace collision {
namespace {

using std::literals::string_view_literals::operator""sv;

constexpr std::string_view kMeshFormat = "CSHAPE\0\1"sv;
constexpr std::string_view kSolidsFormat = "CSHAPE\0\2"sv;

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

template <std::size_t kNumbers>
void Append(const std::array<double, kNumbers>& numbers, std::string* bytes) {
  for (const double x : numbers) Append(std::bit_cast<std::uint64_t>(x), bytes);
}

/// How many of each there are, as the header says.
struct Counts {
  std::uint64_t vertices = 0, triangles = 0, solids = 0, points = 0;
  bool has_solids = false;

  /// At most 216 (2^32 - 1) + 24: no overflow.
  std::uint64_t bytes() const {
    return kShapeHeaderBytes + (has_solids ? kSolidHeaderBytes : 0) +
           kShapeVertexBytes * (vertices + points) + kShapeTriangleBytes * triangles +
           kSolidBytes * solids;
  }

  std::string Text() const {
    std::string text =
        std::to_string(vertices) + " vertices and " + std::to_string(triangles) + " triangles";
    if (!has_solids) return text;
    return text + ", " + std::to_string(solids) + " solids with " + std::to_string(points) +
           " points";
  }
};

Counts CountsOf(const ShapeContent& content) {
  Counts counts{content.vertices.size(), content.triangles.size(), content.solids.size(), 0,
                !content.solids.empty()};
  for (const SolidContent& solid : content.solids) counts.points += solid.points.size();
  return counts;
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

  template <std::size_t kNumbers>
  void Take(std::array<double, kNumbers>* numbers) {
    for (double& x : *numbers) x = std::bit_cast<double>(Take<std::uint64_t>());
  }

 private:
  const char* bytes_;
};

/// The solids and their points; false if these are not as many as the header says.
bool TakeSolids(const Counts& counts, Front* front, std::vector<SolidContent>* solids) {
  solids->resize(counts.solids);
  std::uint64_t left = counts.points;
  for (SolidContent& solid : *solids) {
    solid.kind = static_cast<SolidKind>(front->Take<std::uint32_t>());
    const std::uint64_t points = front->Take<std::uint32_t>();
    if (points > left) return false;
    left -= points;
    solid.points.resize(points);
    front->Take(&solid.position);
    front->Take(&solid.orientation);
    front->Take(&solid.half_extents);
    std::array<double, 1> rounding{};
    front->Take(&rounding);
    solid.rounding = rounding[0];
  }
  if (left != 0) return false;
  for (SolidContent& solid : *solids) {
    for (auto& point : solid.points) front->Take(&point);
  }
  return true;
}

}  // namespace

std::string EncodeShape(const ShapeContent& content) {
  const Counts counts = CountsOf(content);
  std::string bytes(counts.has_solids ? kSolidsFormat : kMeshFormat);
  Append(Count("vertices", counts.vertices), &bytes);
  Append(Count("triangles", counts.triangles), &bytes);
  if (counts.has_solids) {
    Append(Count("solids", counts.solids), &bytes);
    Append(Count("points", counts.points), &bytes);
  }
  bytes.reserve(counts.bytes());
  for (const auto& vertex : content.vertices) Append(vertex, &bytes);
  for (const auto& triangle : content.triangles) {
    for (const std::uint32_t index : triangle) Append(index, &bytes);
  }
  for (const SolidContent& solid : content.solids) {
    Append(static_cast<std::uint32_t>(solid.kind), &bytes);
    Append(static_cast<std::uint32_t>(solid.points.size()), &bytes);
    Append(solid.position, &bytes);
    Append(solid.orientation, &bytes);
    Append(solid.half_extents, &bytes);
    Append(std::array{solid.rounding}, &bytes);
  }
  for (const SolidContent& solid : content.solids) {
    for (const auto& point : solid.points) Append(point, &bytes);
  }
  return bytes;
}

std::optional<ShapeContent> DecodeShape(const std::string& bytes, std::string* error) {
  const bool has_solids = std::string_view(bytes).starts_with(kSolidsFormat);
  const std::uint64_t header = kShapeHeaderBytes + (has_solids ? kSolidHeaderBytes : 0);
  if (bytes.size() < header) {
    *error = std::to_string(bytes.size()) + " bytes are no shape; at least " +
             std::to_string(header) + " are needed";
    return std::nullopt;
  }
  if (!has_solids && !std::string_view(bytes).starts_with(kMeshFormat)) {
    *error = "not in the format of a shape: it does not begin with CSHAPE, 0, 1 or CSHAPE, 0, 2";
    return std::nullopt;
  }
  Front front(bytes.data() + kMeshFormat.size());
  Counts counts{front.Take<std::uint32_t>(), front.Take<std::uint32_t>(), 0, 0, has_solids};
  if (has_solids) {
    counts.solids = front.Take<std::uint32_t>();
    counts.points = front.Take<std::uint32_t>();
  }
  if (bytes.size() != counts.bytes()) {
    *error = std::to_string(bytes.size()) + " bytes; " + counts.Text() + " take " +
             std::to_string(counts.bytes());
    return std::nullopt;
  }
  ShapeContent content;
  content.vertices.resize(counts.vertices);
  content.triangles.resize(counts.triangles);
  for (auto& vertex : content.vertices) front.Take(&vertex);
  for (auto& triangle : content.triangles) {
    for (std::uint32_t& index : triangle) index = front.Take<std::uint32_t>();
  }
  if (!TakeSolids(counts, &front, &content.solids)) {
    *error = "the points of the solids do not add up to " + std::to_string(counts.points);
    return std::nullopt;
  }
  return content;
}

}  // namespace collision
