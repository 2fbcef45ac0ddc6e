// A set of indices that is cheap to fill, to walk over and to empty.
#pragma once

#include <cstdint>
#include <vector>

#include "collision_core/base/check.h"
#include "collision_core/base/ids.h"

namespace collision {

/// Indices without duplicates, in the order of their insertion unless one is erased: then the last
/// takes its place. All operations but Clear() (O(size)) and Validate() are O(1). Memory is
/// O(greatest index ever inserted), so that a set that is never emptied stays bounded.
template <typename IndexType>
class IndexSet {
 public:
  /// False: the index was there already.
  bool Insert(IndexType index) {
    CORE_CHECK(!index.is_none(), "a set holds indices of a table");
    if (place_.size() <= index.value()) place_.resize(index.value() + 1, kAbsent);
    if (place_[index.value()] != kAbsent) return false;
    place_[index.value()] = static_cast<std::uint32_t>(indices_.size());
    indices_.push_back(index);
    return true;
  }

  /// False: the index was not there.
  bool Erase(IndexType index) {
    if (!Contains(index)) return false;
    const std::uint32_t place = place_[index.value()];
    indices_[place] = indices_.back();
    place_[indices_[place].value()] = place;
    indices_.pop_back();
    place_[index.value()] = kAbsent;
    return true;
  }

  void Clear() {
    for (const IndexType index : indices_) place_[index.value()] = kAbsent;
    indices_.clear();
  }

  bool Contains(IndexType index) const {
    return index.value() < place_.size() && place_[index.value()] != kAbsent;
  }
  bool empty() const { return indices_.empty(); }
  std::size_t size() const { return indices_.size(); }
  auto begin() const { return indices_.begin(); }
  auto end() const { return indices_.end(); }

  /// Walks the whole set: each index's place is right.
  void Validate() const {
    std::size_t placed = 0;
    for (const std::uint32_t place : place_) placed += place != kAbsent;
    CORE_CHECK(placed == indices_.size(), "each recorded place is taken", placed, indices_.size());
    for (std::size_t k = 0; k < indices_.size(); ++k) {
      CORE_CHECK(place_[indices_[k].value()] == k, "an index's place is recorded", k);
    }
  }

 private:
  static constexpr std::uint32_t kAbsent = ~0u;

  std::vector<IndexType> indices_;
  std::vector<std::uint32_t> place_;  // by index
};

}  // namespace collision
