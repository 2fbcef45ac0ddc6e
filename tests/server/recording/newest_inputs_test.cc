#include "server/recording/newest_inputs.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/server/messages.h"

namespace collision::server {
namespace {

constexpr std::uint64_t kPlenty = 1 << 20;

void Take(const v1::Input& input, NewestInputs* newest) {
  newest->Take(input, input.SerializeAsString());
}

std::vector<v1::Input> AllOf(const NewestInputs& newest) {
  std::vector<v1::Input> all;
  const auto add = [&](const std::string& bytes) {
    EXPECT_TRUE(all.emplace_back().ParseFromString(bytes));
  };
  newest.Visit(add);
  newest.VisitReady(add);
  return all;
}

v1::Input Part(std::uint64_t sender, std::uint32_t number, const std::string& hash) {
  v1::Input input;
  input.set_sender(sender);
  input.mutable_shape_part()->set_simulator_id(SimulatorId("alpha"));
  input.mutable_shape_part()->set_shape(number);
  input.mutable_shape_part()->set_run(1);
  input.mutable_shape_part()->set_content_hash(hash);
  return input;
}

v1::Input Ready(const std::string& hash) {
  v1::Input input;
  input.mutable_shape_ready()->set_content_hash(hash);
  return input;
}

std::map<std::uint64_t, PresentSimulator> Alpha(
    std::vector<std::pair<std::uint32_t, std::uint32_t>> agents) {
  return {{SimulatorId("alpha"),
           {.sender = 1, .run = 1, .is_in_time = true, .agents = std::move(agents)}}};
}

// Goal:   of each key the newest counts, as for a reader that joins now.
TEST(NewestInputs, KeepsTheNewestOfEachKey) {
  NewestInputs newest(kPlenty);
  for (const std::int64_t at : {1, 2, 3}) {
    Take(From(1, State(0, at, at), "alpha"), &newest);
    Take(From(1, ClockOf("alpha", at)), &newest);
    Take(From(2, ClockOf("beta", 10 * at)), &newest);
    Take(From(1, Description("alpha", static_cast<std::uint32_t>(at))), &newest);
  }
  std::vector<std::int64_t> clocks;
  int states = 0, descriptions = 0;
  for (const v1::Input& input : AllOf(newest)) {
    if (input.has_simulator_clock()) clocks.push_back(input.simulator_clock().clock_ns());
    descriptions += input.has_agent_description();
    if (!input.has_agent_states()) continue;
    ++states;
    EXPECT_EQ(input.agent_states().states(0).stamp_ns(), 3);
  }
  std::sort(clocks.begin(), clocks.end());
  EXPECT_EQ(clocks, (std::vector<std::int64_t>{3, 30}));
  EXPECT_EQ(states, 1);
  EXPECT_EQ(descriptions, 3);
}

// Goal:   what was removed is forgotten: agents, shapes with their trees, simulators and runs that
//         the service has let go of. What nobody has named yet waits for one turn.
TEST(NewestInputs, ForgetsWhatHasLeft) {
  NewestInputs newest(kPlenty);
  for (std::uint32_t slot : {0, 1, 2}) Take(From(1, Description("alpha", slot)), &newest);
  Take(Removal(1, "alpha", 1), &newest);
  EXPECT_EQ(newest.size(), 2u);
  Take(Part(1, 7, "hash"), &newest);
  Take(Ready("hash"), &newest);
  Take(From(1, ClockOf("alpha", 5)), &newest);
  Take(From(9, Description("alpha", 0, 2)), &newest);  // a successor that was refused
  Take(From(3, ClockOf("gone", 5)), &newest);
  EXPECT_EQ(newest.size(), 7u);
  newest.Keep(Alpha({{0, 1}}));
  EXPECT_EQ(newest.size(), 5u) << "slot 2 and the successor have left";
  newest.Keep(Alpha({{0, 2}}));
  EXPECT_EQ(newest.size(), 3u) << "so has that generation of slot 0, and nobody knows \"gone\"";
  v1::Input removal;
  removal.set_sender(1);
  removal.mutable_shape_removal()->set_simulator_id(SimulatorId("alpha"));
  removal.mutable_shape_removal()->set_shape(7);
  Take(removal, &newest);
  newest.Keep(Alpha({}));
  ASSERT_EQ(newest.size(), 1u) << "its clock";
  auto out_of_time = Alpha({});
  out_of_time.begin()->second.is_in_time = false;
  newest.Keep(out_of_time);
  EXPECT_EQ(newest.size(), 0u);
  EXPECT_EQ(newest.bytes(), 0u);
}

// Goal:   it never holds more than its bound, and says what it left out; what it knows goes on.
TEST(NewestInputs, IsBounded) {
  const std::uint64_t bound = 10 * NewestInputs::kOverhead;
  NewestInputs newest(bound);
  for (std::uint32_t slot = 0; slot < 100; ++slot) {
    Take(From(1, Description("alpha", slot)), &newest);
    EXPECT_LE(newest.bytes(), bound);
  }
  EXPECT_GT(newest.size(), 3u);
  EXPECT_EQ(newest.size() + newest.left_out(), 100u);
  const std::uint64_t left_out = newest.left_out();
  Take(From(1, Description("alpha", 0)), &newest);
  EXPECT_EQ(newest.left_out(), left_out);
  // What has outgrown its room is not there in an older form.
  v1::AgentDescription longer = Description("alpha", 0);
  longer.set_agent_name(std::string(bound, 'x'));
  const std::size_t size = newest.size();
  Take(From(1, longer), &newest);
  EXPECT_EQ(newest.size(), size - 1);
  EXPECT_EQ(newest.left_out(), left_out + 1);
}

// Goal:   ever-new keys, written or removed, of names that nobody has take no memory, and what the
//         service has stays.
TEST(NewestInputs, EverNewKeysTakeNoMemory) {
  NewestInputs newest(std::uint64_t{1} << 40);
  Take(From(1, Description("alpha", 0)), &newest);
  Take(From(1, ClockOf("alpha", 1)), &newest);
  const std::size_t of_alpha = newest.size();
  const std::map<std::uint64_t, PresentSimulator> present = {
      {SimulatorId("alpha"),
       {.sender = 1, .run = 1, .is_in_time = true, .descriptions_seen = 1, .agents = {{0, 1}}}}};
  constexpr int kKeys = 200'000;
  int censuses = 0;
  for (int key = 0; key < kKeys; ++key) {
    const std::string name = "stranger" + std::to_string(key);
    Take(key % 2 == 0 ? From(2, ClockOf(name, 1)) : Removal(2, name, 0), &newest);
    if (newest.wants_census()) {
      newest.Keep(present);
      ++censuses;
    }
    ASSERT_LT(newest.bytes(), 2 * NewestInputs::kNewBytes + 10'000) << key;
  }
  EXPECT_GT(censuses, 3);
  EXPECT_LT(censuses, 20) << "each costs a look at the whole world";
  newest.Keep(present);
  newest.Keep(present);
  EXPECT_EQ(newest.size(), of_alpha);
}

// Goal:   two halves, one after another, are as the whole.
TEST(NewestInputs, LaterOnesReplaceAndRemove) {
  const std::vector<v1::Input> inputs = {
      From(1, Description("alpha", 0)), From(1, Description("alpha", 1)),
      From(1, ClockOf("alpha", 1)),     Removal(1, "alpha", 0),
      From(1, ClockOf("alpha", 2)),     From(1, Description("alpha", 2)),
      Removal(1, "alpha", 2),           From(1, Description("alpha", 0))};
  NewestInputs whole(kPlenty);
  for (const v1::Input& input : inputs) Take(input, &whole);
  for (std::size_t half = 0; half <= inputs.size(); ++half) {
    NewestInputs first(kPlenty), second(kPlenty, true);
    for (std::size_t i = 0; i < inputs.size(); ++i) Take(inputs[i], i < half ? &first : &second);
    first.Take(&second);
    const std::vector<v1::Input> all = AllOf(first), wanted = AllOf(whole);
    ASSERT_EQ(all.size(), wanted.size()) << half;
    for (std::size_t i = 0; i < all.size(); ++i) {
      EXPECT_EQ(all[i].DebugString(), wanted[i].DebugString()) << half;
    }
    EXPECT_EQ(second.size(), 0u);
  }
}

}  // namespace
}  // namespace collision::server
