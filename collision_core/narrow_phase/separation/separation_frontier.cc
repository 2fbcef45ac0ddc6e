#include "collision_core/narrow_phase/separation/separation_frontier.h"

#include <algorithm>
#include <limits>

#include "collision_core/base/check.h"

namespace collision::narrow_phase {
namespace {

// A heap's front is the greatest: the least lower bound, of equals the first balls.
bool IsLater(const BallPair& x, const BallPair& y) {
  if (x.lower != y.lower) return x.lower > y.lower;
  if (x.a != y.a) return x.a > y.a;
  return x.b > y.b;
}

}  // namespace

BallPair Frontier::Pop() {
  CORE_CHECK(!empty(), "the frontier has a pair");
  if (order_ == FrontierOrder::kNearestFirst) std::pop_heap(data_, data_ + size_, IsLater);
  return data_[--size_];
}

BallPair* Frontier::Room(std::size_t count) {
  while (size_ + count > room_) Grow();
  return data_ + size_;
}

void Frontier::Take(std::size_t count) {
  if (order_ == FrontierOrder::kNewestFirst) {
    BallPair* const pairs = data_ + size_;
    size_ += count;
    if (count < 2) return;
    BallPair* nearest = pairs;
    for (BallPair* pair = pairs + 1; pair != pairs + count; ++pair) {
      nearest = pair->lower < nearest->lower ? pair : nearest;
    }
    std::swap(*nearest, pairs[count - 1]);
    return;
  }
  for (; count > 0; --count) std::push_heap(data_, data_ + ++size_, IsLater);
}

void Frontier::Grow() {
  std::unique_ptr<BallPair[]> more(new BallPair[2 * room_]);
  std::copy_n(data_, size_, more.get());
  more_ = std::move(more);
  data_ = more_.get();
  room_ *= 2;
}

double Frontier::Least() const {
  if (empty()) return std::numeric_limits<double>::infinity();
  if (order_ == FrontierOrder::kNearestFirst) return static_cast<double>(data_[0].lower);
  float least = data_[0].lower;
  for (std::size_t i = 1; i < size_; ++i) least = std::min(least, data_[i].lower);
  return static_cast<double>(least);
}

}  // namespace collision::narrow_phase
