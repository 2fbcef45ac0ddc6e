// Pairs of balls that a search has still to open.
#pragma once

#include <memory>

#include "collision_core/sphere_tree/packed_tree.h"

namespace collision::narrow_phase {

/// Two balls that are still to be opened.
struct BallPair {
  float lower;  ///< A lower bound on the distance of what they hold.
  sphere_tree::BallRef a, b;
  std::uint32_t next;  ///< For two leaves: how many pairs of blocks are done.
};

/// Pairs in the order in which they are opened: those that may be the nearest first, or the newest
/// first. The first ones are kept in place, so that small searches allocate nothing.
class Frontier {
 public:
  explicit Frontier(bool newest_first) : newest_first_(newest_first) {}
  Frontier(const Frontier&) = delete;
  Frontier& operator=(const Frontier&) = delete;

  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  bool newest_first() const { return newest_first_; }
  const BallPair& next() const { return newest_first_ ? data_[size_ - 1] : data_[0]; }
  BallPair Pop();
  void Push(const BallPair& pair) {
    *Room(1) = pair;
    Take(1);
  }
  /// Room for so many to be written, and then taken in; of the newest, the one that may be the
  /// nearest is to come next.
  BallPair* Room(std::size_t count);
  void Take(std::size_t count);
  /// No pair may be nearer.
  double Least() const;

 private:
  static constexpr std::size_t kInPlace = 256;
  void Grow();

  const bool newest_first_;
  std::size_t size_ = 0;
  std::size_t room_ = kInPlace;
  BallPair* data_ = in_place_;
  std::unique_ptr<BallPair[]> more_;
  BallPair in_place_[kInPlace];
};

}  // namespace collision::narrow_phase
