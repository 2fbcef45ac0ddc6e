// Goal:   a reader that stops misses no contact that the writer's history holds, whatever else is
//         told meanwhile; beyond it, and to a reader that joins later, the newest count.
// Method: numbered contacts to a child process that is stopped, to a session that does not read,
//         and to one that is made afterwards.
#include <gtest/gtest.h>

#include <algorithm>

#include "idl/limits.h"
#include "tests/idl/dds_bus_support.h"

namespace collision::server {
namespace {

/// 10 s at 1,000 contacts a second, each told three times.
constexpr std::uint64_t kTenSeconds = 30'000;
constexpr std::uint64_t kFlushPeriod = 100;  // contacts between two flushes

void PublishContacts(DdsBus& bus, std::uint64_t first, std::uint64_t last) {
  for (std::uint64_t sequence = first; sequence <= last; ++sequence) {
    v1::Output output;
    output.mutable_collision_event()->set_contacts_sequence(sequence);
    bus.Publish(output);
    if (sequence % kFlushPeriod == 0) bus.Flush();
  }
  bus.Flush();
}

std::vector<std::uint64_t> Sequences(const std::vector<v1::Output>& outputs) {
  std::vector<std::uint64_t> sequences;
  for (const v1::Output& output : outputs) {
    if (output.has_collision_event())
      sequences.push_back(output.collision_event().contacts_sequence());
  }
  return sequences;
}

std::vector<std::uint64_t> FromTo(std::uint64_t first, std::uint64_t last) {
  std::vector<std::uint64_t> numbers;
  for (std::uint64_t number = first; number <= last; ++number) numbers.push_back(number);
  return numbers;
}

TEST(DdsBusContact, AStoppedProcessMissesNone) {
  DdsBus bus(TestWorld(), TestDomain());
  v1::Output status;
  status.mutable_service_status()->set_world(TestWorld());
  bus.Publish(status);
  bus.Flush();
  ChildSimulator child(kTenSeconds);
  std::vector<v1::Input> inputs;
  const auto clock = [&](std::int64_t ns) {
    return [&inputs, ns] {
      return std::any_of(inputs.begin(), inputs.end(), [ns](const v1::Input& input) {
        return input.has_simulator_clock() && input.simulator_clock().clock_ns() == ns;
      });
    };
  };
  ASSERT_TRUE(ReceiveUntil(bus, &inputs, clock(1)));
  child.Stop();
  PublishContacts(bus, 1, kTenSeconds);
  EXPECT_EQ(bus.counters().writes_failed, 0u);
  child.Continue();
  EXPECT_TRUE(ReceiveUntil(bus, &inputs, clock(2)));
}

TEST(DdsBusContact, AReaderThatDoesNotReadKeepsTheNewestInTheirOrder) {
  constexpr std::uint64_t kBeyond = 500;
  DdsBus bus(TestWorld(), TestDomain());
  DdsSession sleeper(MonitorOptions(false)), reader(MonitorOptions(false));
  PublishContacts(bus, 1, wire::kContactsKept + kBeyond);
  std::vector<v1::Output> outputs;
  const auto last = [&] {
    return !outputs.empty() &&
           outputs.back().collision_event().contacts_sequence() == wire::kContactsKept + kBeyond;
  };
  ASSERT_TRUE(ReceiveUntil(reader, &outputs, last));
  // What has reached one reader has been sent to the other, which takes a moment to store it.
  outputs.clear();
  ASSERT_TRUE(ReceiveUntil(sleeper, &outputs, last));
  const std::vector<std::uint64_t> heard = Sequences(outputs);
  EXPECT_GE(heard.size(), static_cast<std::size_t>(wire::kContactsKept));
  EXPECT_EQ(heard, FromTo(heard.front(), wire::kContactsKept + kBeyond));
}

TEST(DdsBusContact, ALateJoinerGetsTheNewestAndThenEachOne) {
  constexpr std::uint64_t kEarlier = 3000;
  DdsBus bus(TestWorld(), TestDomain());
  PublishContacts(bus, 1, kEarlier);
  DdsSession late(MonitorOptions(false));
  std::vector<v1::Output> outputs;
  const auto heard = [&](std::uint64_t count) {
    return [&outputs, count] { return Sequences(outputs).size() >= count; };
  };
  ASSERT_TRUE(ReceiveUntil(late, &outputs, heard(wire::kContactsForLateJoiners)));
  PublishContacts(bus, kEarlier + 1, 2 * kEarlier);
  ASSERT_TRUE(ReceiveUntil(late, &outputs, heard(wire::kContactsForLateJoiners + kEarlier)));
  EXPECT_EQ(Sequences(outputs), FromTo(kEarlier - wire::kContactsForLateJoiners + 1, 2 * kEarlier));
}

}  // namespace
}  // namespace collision::server
