// Pairs of balls that a search has still to open.
#pragma once

#include <memory>

#include "collision_core/base/check.h"
#include "collision_core/sphere_tree/packed_tree.h"

namespace collision::narrow_phase {

/// Two balls that are still to be opened.
struct BallPair {
  float lower;  ///< A lower bound on the distance of what they hold.
  sphere_tree::BallRef a, b;
  std::uint32_t next;  ///< For two leaves: how many pairs of blocks are done.
};

/// Which pair of a frontier comes next.
enum class FrontierOrder : std::uint8_t {
  kNearestFirst,  ///< The pair that may be the nearest.
  kNewestFirst    ///< Of the pairs pushed last, the one that may be the nearest.
};

/// Pairs in the order in which they are opened. The first kInPlace of them are kept in place, so
/// that small searches allocate nothing.
class Frontier {
 public:
  explicit Frontier(FrontierOrder order) : order_(order) {}
  Frontier(const Frontier&) = delete;
  Frontier& operator=(const Frontier&) = delete;

  bool empty() const { return size_ == 0; }
  FrontierOrder order() const { return order_; }
  /// Requires a pair.
  const BallPair& next() const {
    CORE_CHECK(!empty(), "the frontier has a pair");
    return order_ == FrontierOrder::kNewestFirst ? data_[size_ - 1] : data_[0];
  }
  /// Removes next(). Requires a pair.
  BallPair Pop();
  void Push(const BallPair& pair) {
    *Room(1) = pair;
    Take(1);
  }
  /// Room for `count` pairs to be written to, of which Take() then takes in the first ones.
  BallPair* Room(std::size_t count);
  /// Takes in the first `count` pairs that were written to Room().
  void Take(std::size_t count);
  /// The least lower bound of all pairs; +infinity if there is none.
  double Least() const;

 private:
  static constexpr std::size_t kInPlace = 256;
  void Grow();

  const FrontierOrder order_;
  std::size_t size_ = 0;
  std::size_t room_ = kInPlace;
  BallPair* data_ = in_place_;
  std::unique_ptr<BallPair[]> more_;
  BallPair in_place_[kInPlace];
};

}  // namespace collision::narrow_phase
