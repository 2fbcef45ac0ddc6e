// Goal:   what is told of a hypothetical agent reaches its simulator, also one whose reader joins
//         late, and no other one and no monitor; of one that is forgotten it is not kept.
// Method: a service's bus and the sessions of those who listen.
#include <gtest/gtest.h>

#include "idl/identity.h"
#include "tests/idl/dds_bus_support.h"

namespace collision::server {
namespace {

v1::Output Screening(const std::string& simulator, std::uint32_t pair_slot,
                     std::uint64_t sequence) {
  v1::Output output;
  v1::ScreeningEvent& screening = *output.mutable_screening_event();
  screening.set_simulator_id(SimulatorId(simulator));
  screening.set_pair_slot(pair_slot);
  screening.mutable_event()->mutable_stamp()->set_sequence(sequence);
  return output;
}

/// The sequences of screening events.
std::vector<std::uint64_t> Screened(const std::vector<v1::Output>& outputs) {
  std::vector<std::uint64_t> sequences;
  for (const v1::Output& output : outputs) {
    if (!output.has_screening_event()) continue;
    sequences.push_back(output.screening_event().event().stamp().sequence());
  }
  return sequences;
}

using Sequences = std::vector<std::uint64_t>;

TEST(DdsBus, ScreeningIsReadByItsSimulatorAlone) {
  DdsBus bus(TestWorld(), TestDomain());
  DdsSession owner(SimulatorOptions("a")), other(SimulatorOptions("b"));
  DdsSession monitor(MonitorOptions(true));
  std::vector<v1::Output> to_owner, to_other, to_monitor;
  bus.Publish(Screening("a", 1, 1));
  bus.Publish(Screening("b", 1, 2));
  v1::Output last;
  last.mutable_service_status()->set_service_id(1);
  bus.Publish(last);
  bus.Flush();
  ASSERT_TRUE(ReceiveUntil(owner, &to_owner, [&] { return !Screened(to_owner).empty(); }));
  ASSERT_TRUE(ReceiveUntil(other, &to_other, [&] { return !Screened(to_other).empty(); }));
  ASSERT_TRUE(ReceiveUntil(monitor, &to_monitor, [&] { return !to_monitor.empty(); }));
  EXPECT_EQ(Screened(to_owner), Sequences{1});
  EXPECT_EQ(Screened(to_other), Sequences{2});
  EXPECT_EQ(Screened(to_monitor), Sequences{});
}

TEST(DdsBus, ALateSimulatorHasTheNewestScreeningOfEachPairUntilItIsForgotten) {
  DdsBus bus(TestWorld(), TestDomain());
  for (std::uint64_t sequence = 1; sequence <= 3; ++sequence) {
    bus.Publish(Screening("a", 7, sequence));
  }
  bus.Publish(Screening("b", 7, 4));
  bus.Forget(SimulatorId("b"));
  bus.Publish(Screening("b", 8, 5));
  bus.Flush();
  DdsSession late(SimulatorOptions("a"));
  std::vector<v1::Output> heard;
  ASSERT_TRUE(ReceiveUntil(late, &heard, [&] { return !Screened(heard).empty(); }));
  EXPECT_EQ(Screened(heard), Sequences{3});
  const auto end = std::chrono::steady_clock::now() + kDeadline;
  do {
    DdsSession forgotten(SimulatorOptions("b"));
    heard.clear();
    const auto has_last = [&] { return !Screened(heard).empty() && Screened(heard).back() == 5; };
    ASSERT_TRUE(ReceiveUntil(forgotten, &heard, has_last));
  } while (Screened(heard).size() > 1 && std::chrono::steady_clock::now() < end);
  EXPECT_EQ(Screened(heard), Sequences{5});
}

}  // namespace
}  // namespace collision::server
