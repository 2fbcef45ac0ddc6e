// Which shapes a simulator's agents refer to, and what the service is told of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "client/shape.h"
#include "idl/messages.pb.h"

namespace collision::client {

/// Bytes of one part, as in the IDL.
inline constexpr std::size_t kShapePartBytes = 49152;

/// Counts the agents of each shape by its content: shapes with the same bytes are one. Parts are
/// written before the first description that refers to them, the removal after the last one.
class ShapeBook {
 public:
  using Writer = std::function<void(const v1::Input&)>;

  ShapeBook(std::uint64_t simulator_id, std::uint32_t run)
      : simulator_id_(simulator_id), run_(run) {}

  /// One agent more has this shape; if it is the first, writes the parts.
  void Add(const std::shared_ptr<const Shape>& shape, const Writer& write);

  /// One agent fewer has the shape of this hash (empty: none had one); if it was the last, writes
  /// the removal.
  void Remove(const std::string& hash, const Writer& write);

  /// Writes the parts of all shapes there are, anew.
  void WriteAll(const Writer& write) const;

 private:
  struct Entry {
    std::shared_ptr<const Shape> shape;
    std::size_t agents = 0;
  };

  void WriteParts(const Shape& shape, const Writer& write) const;

  std::uint64_t simulator_id_;
  std::uint32_t run_;
  std::map<std::string, Entry> entries_;  ///< By content hash.
};

}  // namespace collision::client
