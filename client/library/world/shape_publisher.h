// The shapes that a simulator's agents refer to, and the messages that publish them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "collision/shape.h"
#include "idl/messages.pb.h"

namespace collision::client {

/// Counts the agents of each shape by content: shapes with the same bytes are one. The parts of a
/// shape are written before the first description that refers to it, the removal after the last.
class ShapePublisher {
 public:
  using Writer = std::function<void(const v1::Input&)>;

  /// Shapes are numbered from `first_number` on; another program of the same name must not use the
  /// same numbers.
  ShapePublisher(std::uint64_t simulator_id, std::uint32_t run, std::uint32_t first_number)
      : simulator_id_(simulator_id), run_(run), next_number_(first_number) {}

  /// What is written from here on belongs to this run.
  void SetRun(std::uint32_t run) { run_ = run; }

  /// One more agent has this shape; writes the parts if it is the first.
  void Add(const std::shared_ptr<const Shape>& shape, const Writer& write);

  /// One agent fewer has the shape of this hash (empty: it was a ball); writes the removal if it
  /// was the last.
  void Remove(const std::string& hash, const Writer& write);

  /// Repeats the parts of all shapes.
  void WriteAll(const Writer& write) const;

 private:
  struct Entry {
    std::shared_ptr<const Shape> shape;
    std::uint32_t number = 0;
    std::size_t agents = 0;
  };

  void WriteParts(const Entry& entry, const Writer& write) const;

  std::uint64_t simulator_id_;
  std::uint32_t run_;
  std::uint32_t next_number_;             ///< After 2^32 - 1 comes 0.
  std::map<std::string, Entry> entries_;  ///< By content hash.
};

}  // namespace collision::client
