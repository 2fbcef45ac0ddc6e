// Indices that cannot be mistaken for each other.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "collision_core/base/check.h"

namespace collision {

/// An index into one kind of table. Indices of different tags do not convert into each other or
/// into integers; `value()` is the way out. Ordered and hashed by value. Trivially copyable.
template <typename Tag>
class Index {
 public:
  constexpr Index() = default;
  constexpr explicit Index(std::uint32_t value) : value_(value) {}
  constexpr explicit Index(std::size_t value) : value_(static_cast<std::uint32_t>(value)) {}

  /// An index that no table has.
  static constexpr Index None() { return Index(~std::uint32_t{0}); }
  constexpr bool is_none() const { return value_ == ~std::uint32_t{0}; }

  constexpr std::uint32_t value() const { return value_; }

  friend constexpr auto operator<=>(const Index&, const Index&) = default;

 private:
  std::uint32_t value_ = 0;
};

/// An agent in the detector's tables. The broad phase and PairRules use plain integers (`value()`):
/// their callers choose the indices, also for half-spaces, and wide vectors hold them as 32-bit
/// integers.
using AgentIndex = Index<struct AgentTag>;
using PairSlot = Index<struct PairTag>;   ///< A tracked pair in the pair table.
using NodeIndex = Index<struct NodeTag>;  ///< A node of one sphere tree.
/// An element of one shape. With n triangles in its surface, 0 to n − 1 are these triangles, and
/// n + k is its convex solid k.
using ElementIndex = Index<struct ElementTag>;

/// A vector that takes only one kind of index. `operator[]` does not check it; `at()` does.
template <typename IndexType, typename T>
class IndexedVector {
 public:
  IndexedVector() = default;
  explicit IndexedVector(std::size_t size) : values_(size) {}

  decltype(auto) operator[](IndexType index) { return values_[index.value()]; }
  decltype(auto) operator[](IndexType index) const { return values_[index.value()]; }
  decltype(auto) at(IndexType index) {
    CORE_CHECK(contains(index), "an index lies within its table", index.value(), size());
    return values_[index.value()];
  }
  decltype(auto) at(IndexType index) const {
    CORE_CHECK(contains(index), "an index lies within its table", index.value(), size());
    return values_[index.value()];
  }

  bool contains(IndexType index) const { return index.value() < values_.size(); }
  IndexType end_index() const { return IndexType(values_.size()); }
  std::size_t size() const { return values_.size(); }
  void resize(std::size_t size, const T& value = T()) { values_.resize(size, value); }
  void push_back(T value) { values_.push_back(std::move(value)); }
  auto begin() { return values_.begin(); }
  auto end() { return values_.end(); }
  auto begin() const { return values_.begin(); }
  auto end() const { return values_.end(); }

 private:
  std::vector<T> values_;
};

}  // namespace collision

/// @cond INTERNAL
template <typename Tag>
struct std::hash<collision::Index<Tag>> {
  std::size_t operator()(collision::Index<Tag> index) const { return index.value(); }
};
/// @endcond
