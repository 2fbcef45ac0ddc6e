// A list of a message that is plain C++ (plain_messages_main.cc).
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace collision::plain {

/// What protobuf's repeated fields offer and this project uses, over a vector. Not for bool.
template <class Element>
class List {
 public:
  int size() const { return static_cast<int>(elements_.size()); }
  bool empty() const { return elements_.empty(); }
  const Element& operator[](int i) const { return elements_[static_cast<std::size_t>(i)]; }
  Element& operator[](int i) { return elements_[static_cast<std::size_t>(i)]; }
  const Element& Get(int i) const { return (*this)[i]; }
  Element* Mutable(int i) { return &(*this)[i]; }

  Element* Add() { return &elements_.emplace_back(); }
  void Add(Element element) { elements_.push_back(std::move(element)); }
  void Reserve(int size) { elements_.reserve(static_cast<std::size_t>(size)); }
  void DeleteSubrange(int first, int count) {
    elements_.erase(begin() + first, begin() + first + count);
  }
  void Clear() { elements_.clear(); }

  auto begin() const { return elements_.begin(); }
  auto end() const { return elements_.end(); }
  auto begin() { return elements_.begin(); }
  auto end() { return elements_.end(); }

 private:
  std::vector<Element> elements_;
};

}  // namespace collision::plain
