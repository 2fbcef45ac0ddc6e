// Shapes as a simulator writes them, for tests to spoil.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "idl/shape_bytes.h"
#include "tests/server/messages.h"

namespace collision::server {

/// A cube of side 2 `half` about the reference point, closed. `unused` vertices make it take more
/// bytes, and so more parts, and nothing else.
inline ShapeContent Cube(double half, std::size_t unused = 0) {
  ShapeContent content;
  for (int corner = 0; corner < 8; ++corner) {
    content.vertices.push_back(
        {corner & 1 ? half : -half, corner & 2 ? half : -half, corner & 4 ? half : -half});
  }
  content.vertices.resize(8 + unused);
  content.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                       {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return content;
}

/// The same body as Cube(1), of 12 n² triangles: for what counts triangles.
inline ShapeContent FineCube(std::uint32_t n) {
  ShapeContent content;
  const auto at = [n](std::uint32_t i) { return -1 + 2.0 * i / n; };
  for (int face = 0; face < 6; ++face) {
    const auto first = static_cast<std::uint32_t>(content.vertices.size());
    const int axis = face / 2;
    const bool upper = face % 2 == 1;
    for (std::uint32_t j = 0; j <= n; ++j) {
      for (std::uint32_t i = 0; i <= n; ++i) {
        std::array<double, 3> p{};
        p[axis] = upper ? 1 : -1;
        p[(axis + 1) % 3] = at(i);
        p[(axis + 2) % 3] = at(j);
        content.vertices.push_back(p);
      }
    }
    for (std::uint32_t j = 0; j < n; ++j) {
      for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t a = first + j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
        content.triangles.push_back(upper ? std::array<std::uint32_t, 3>{a, b, d}
                                          : std::array<std::uint32_t, 3>{a, d, b});
        content.triangles.push_back(upper ? std::array<std::uint32_t, 3>{a, d, c}
                                          : std::array<std::uint32_t, 3>{a, c, d});
      }
    }
  }
  return content;
}

/// √3 rounded up: how far the corners of Cube(1) are.
inline constexpr double kCubeRadius = 1.7320508075688774;

/// Vertices that add so many parts.
inline std::size_t UnusedFor(std::size_t parts) {
  return parts * wire::kShapePartBytes / kShapeVertexBytes;
}

/// A number that no other shape of a test has.
inline std::uint32_t ShapeNumberOf(const std::string& bytes) {
  std::uint32_t number = 0;
  std::memcpy(&number, Sha256(bytes).data(), sizeof number);
  return number;
}

/// All parts of these bytes, under the hash that they have.
inline std::vector<v1::ShapePart> PartsOf(const std::string& simulator, const std::string& bytes,
                                          std::uint32_t run = 1) {
  std::vector<v1::ShapePart> parts(ShapeParts(bytes.size()));
  for (std::uint32_t i = 0; i < parts.size(); ++i) {
    parts[i].set_simulator_id(SimulatorId(simulator));
    parts[i].set_shape(ShapeNumberOf(bytes));
    parts[i].set_content_hash(Sha256(bytes));
    parts[i].set_part(i);
    parts[i].set_parts(static_cast<std::uint32_t>(parts.size()));
    parts[i].set_run(run);
    parts[i].set_total_bytes(bytes.size());
    parts[i].set_bytes(bytes.substr(i * wire::kShapePartBytes, wire::kShapePartBytes));
  }
  return parts;
}

inline v1::Input From(std::uint64_t sender, const v1::ShapePart& message) {
  v1::Input input;
  input.set_sender(sender);
  *input.mutable_shape_part() = message;
  return input;
}

inline std::vector<v1::Input> From(std::uint64_t sender, const std::vector<v1::ShapePart>& parts) {
  std::vector<v1::Input> inputs;
  for (const v1::ShapePart& part : parts) inputs.push_back(From(sender, part));
  return inputs;
}

/// The disposal of every part.
inline std::vector<v1::Input> RemovalsOf(std::uint64_t sender,
                                         const std::vector<v1::ShapePart>& parts) {
  std::vector<v1::Input> inputs;
  for (const v1::ShapePart& part : parts) {
    v1::Input& input = inputs.emplace_back();
    input.set_sender(sender);
    input.mutable_shape_removal()->set_simulator_id(part.simulator_id());
    input.mutable_shape_removal()->set_shape(part.shape());
    input.mutable_shape_removal()->set_part(part.part());
  }
  return inputs;
}

/// An agent with this shape.
inline v1::AgentDescription Shaped(const std::string& simulator, std::uint32_t slot,
                                   const std::string& bytes, double radius_m = 2) {
  v1::AgentDescription wire = Description(simulator, slot);
  wire.set_shape_hash(Sha256(bytes));
  wire.set_radius_m(radius_m);
  wire.set_angular_acceleration_max_rad_s2(1);
  return wire;
}

}  // namespace collision::server
