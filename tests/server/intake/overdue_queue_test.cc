#include "server/intake/overdue_queue.h"

#include <gtest/gtest.h>

#include <string>

namespace collision::server {
namespace {

TEST(OverdueQueue, HandsOutWhatIsDueInOrder) {
  OverdueQueue<std::string> queue(100);
  EXPECT_EQ(queue.next_ns(), std::nullopt);
  queue.Add(0, "a");
  queue.Add(50, "b");
  EXPECT_EQ(queue.next_ns(), 100);
  EXPECT_EQ(queue.TakeDue(99), std::nullopt);
  EXPECT_EQ(queue.TakeDue(100), "a");
  EXPECT_EQ(queue.TakeDue(100), std::nullopt);
  EXPECT_EQ(queue.next_ns(), 150);
  EXPECT_EQ(queue.TakeDue(1000), "b");
  EXPECT_EQ(queue.TakeDue(1000), std::nullopt);
}

TEST(OverdueQueue, IsFullAtItsBound) {
  OverdueQueue<int> queue(1);
  for (std::size_t i = 0; i < kOverdueMax; ++i) {
    EXPECT_FALSE(queue.full());
    queue.Add(0, 0);
  }
  EXPECT_TRUE(queue.full());
  EXPECT_EQ(queue.TakeDue(1), 0);
  EXPECT_FALSE(queue.full());
}

}  // namespace
}  // namespace collision::server
