// The parts of one shape, as one simulator writes them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "idl/messages.pb.h"
#include "idl/shape_bytes.h"

namespace collision::server {

/// A set of numbers from 0 to n - 1.
class PartSet {
 public:
  explicit PartSet(std::uint64_t n) : present_(n) {}

  bool Contains(std::uint32_t part) const { return present_[part]; }
  void Insert(std::uint32_t part);
  void Erase(std::uint32_t part);
  std::uint64_t count() const { return count_; }
  std::uint64_t size() const { return present_.size(); }

 private:
  std::vector<bool> present_;
  std::uint64_t count_ = 0;
};

/// Takes parts in any order, repetitions included, and hashes them as they come, so that the last
/// part costs no more than the others. Requires of every part that CheckShapePart() accepts it. One
/// thread.
class ShapeGathering {
 public:
  explicit ShapeGathering(std::uint64_t total_bytes);

  std::uint64_t total_bytes() const { return total_bytes_; }
  std::uint64_t parts() const { return arrived_.size(); }
  std::uint64_t arrived() const { return arrived_.count(); }
  bool Contains(std::uint32_t part) const { return arrived_.Contains(part); }

  /// Bytes that it keeps in memory.
  std::uint64_t bytes() const { return bytes_; }

  /// False: the part is there already, with other bytes. Requires the total_bytes of the others.
  bool Add(const v1::ShapePart& part);

  bool complete() const { return !refused_ && prefix_.size() == total_bytes_; }

  /// The hash of all bytes, and the bytes. Each requires complete(), and may be called once.
  std::string Digest() { return hasher_.Digest(); }
  std::string TakeBytes();

  /// Gives the shape up and frees its bytes. Parts that are still on their way are only counted,
  /// until one comes for the second time: the simulator writes the shape again.
  void Refuse();
  bool refused() const { return refused_; }

  /// The parts that have been written and not disposed of.
  PartSet& present() { return present_; }

 private:
  bool Repeats(const v1::ShapePart& part) const;
  void Append(const std::string& bytes);

  const std::uint64_t total_bytes_;
  PartSet arrived_;
  PartSet present_;
  std::string prefix_;                          ///< All parts before the first one that is missing.
  std::map<std::uint32_t, std::string> later_;  ///< Those that have overtaken it.
  Sha256Hasher hasher_;                         ///< Of the prefix.
  std::uint64_t bytes_ = 0;
  bool refused_ = false;
};

}  // namespace collision::server
