#include "server/shapes/shape_numbers.h"

namespace collision::server {

const std::string* ShapeNumbers::HashOf(std::uint64_t simulator, std::uint32_t number) const {
  const auto found = hashes_.find({simulator, number});
  return found == hashes_.end() ? nullptr : &found->second;
}

void ShapeNumbers::Set(std::uint64_t simulator, std::uint32_t number, const std::string& hash) {
  const auto former = numbers_.try_emplace({simulator, hash}, number).first;
  if (former->second != number) hashes_.erase({simulator, former->second});
  former->second = number;
  hashes_.insert_or_assign({simulator, number}, hash);
}

void ShapeNumbers::Erase(std::uint64_t simulator, const std::string& hash) {
  const auto found = numbers_.find({simulator, hash});
  if (found == numbers_.end()) return;
  hashes_.erase({simulator, found->second});
  numbers_.erase(found);
}

void ShapeNumbers::Release(std::uint64_t simulator) {
  hashes_.erase(hashes_.lower_bound({simulator, 0}), hashes_.upper_bound({simulator, UINT32_MAX}));
  const auto first = numbers_.lower_bound({simulator, std::string()});
  auto end = first;
  while (end != numbers_.end() && end->first.first == simulator) ++end;
  numbers_.erase(first, end);
}

}  // namespace collision::server
