// Goal:   a page that is opened late gets the states of before, the oldest first, and no more than
//         may be kept.
// Method: a table of states that changes, and a clock by hand.
#include "client/programs/scene/past.h"

#include <gtest/gtest.h>

#include <cstring>

namespace collision::client {
namespace {

constexpr std::int64_t kSecondNs = 1'000'000'000;
constexpr std::size_t kRowBytes = StateTable::kHeaderBytes + StateTable::kStateBytes;

class PastTest : public testing::Test {
 protected:
  /// All of `agents` tell a state at this second, and it is kept if it is due.
  void Tell(std::int64_t second, std::uint32_t agents) {
    v1::AgentStates states;
    states.set_simulator_id(7);
    states.set_run(1);
    for (std::uint32_t slot = 0; slot < agents; ++slot) {
      v1::AgentState* state = states.add_states();
      state->set_slot(slot);
      state->set_stamp_ns(second * kSecondNs);
      state->mutable_orientation()->set_w(1);
    }
    table_.Take(states);
    past_.Keep(table_, second * kSecondNs);
  }

  /// The number of states in each item.
  std::vector<std::size_t> Counts() const {
    const std::string items = past_.Items();
    std::vector<std::size_t> counts;
    for (std::size_t at = 0; at < items.size();) {
      std::uint32_t length = 0;
      std::memcpy(&length, items.data() + at + 4, sizeof length);
      counts.push_back(length / kRowBytes);
      at += 8 + length;
    }
    return counts;
  }

  StateTable table_;
  Past past_;
};

TEST_F(PastTest, KeepsOneStateASecond) {
  EXPECT_TRUE(Counts().empty());
  for (const std::int64_t second : {1, 2, 3}) Tell(second, 2);
  past_.Keep(table_, 3 * kSecondNs + kSecondNs / 2);
  EXPECT_EQ(Counts(), (std::vector<std::size_t>{2, 2, 2}));
  past_.Keep(table_, 5 * kSecondNs);
  EXPECT_EQ(Counts().size(), 3u) << "nothing has changed";
}

TEST_F(PastTest, KeepsTenMinutes) {
  for (std::int64_t second = 0; second < 700; ++second) Tell(second, 1);
  EXPECT_EQ(Counts().size(), 601u);
}

TEST_F(PastTest, KeepsFewerOfMany) {
  constexpr std::uint32_t kAgents = 2000;  // one state in six seconds
  for (std::int64_t second = 0; second < 600; ++second) Tell(second, kAgents);
  const auto counts = Counts();
  EXPECT_EQ(counts.size(), 100u);
  EXPECT_LE(counts.size() * kAgents, Past::kStatesMax);
}

TEST_F(PastTest, ForgetsATimeThatIsOver) {
  for (const std::int64_t second : {100, 101, 102}) Tell(second, 2);
  Tell(0, 3);
  EXPECT_EQ(Counts(), (std::vector<std::size_t>{3}));
}

}  // namespace
}  // namespace collision::client
