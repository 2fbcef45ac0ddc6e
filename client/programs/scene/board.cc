#include "client/programs/scene/board.h"

namespace collision::client {

void Board::Put(const std::string& name, Payload payload) {
  const std::lock_guard lock(mutex_);
  const auto [place, is_new] = numbers_.try_emplace(name, 0);
  if (!is_new) changes_.erase(place->second);
  place->second = ++last_;
  changes_.emplace(last_, Entry{name, std::move(payload)});
}

Board::News Board::After(std::uint64_t seen, std::size_t bytes_max) const {
  const std::lock_guard lock(mutex_);
  News news;
  news.seen = seen;
  std::size_t bytes = 0;
  for (auto next = changes_.upper_bound(seen); next != changes_.end(); ++next) {
    bytes += next->second.payload->size();
    if (!news.items.empty() && bytes > bytes_max) break;
    news.items.push_back({next->second.name, next->second.payload});
    news.seen = next->first;
  }
  return news;
}

void Board::Remove(const std::string& name) {
  const std::lock_guard lock(mutex_);
  const auto place = numbers_.find(name);
  if (place == numbers_.end()) return;
  changes_.erase(place->second);
  numbers_.erase(place);
}

void Board::Clear() {
  const std::lock_guard lock(mutex_);
  changes_.clear();
  numbers_.clear();
}

std::size_t Board::size() const {
  const std::lock_guard lock(mutex_);
  return changes_.size();
}

}  // namespace collision::client
