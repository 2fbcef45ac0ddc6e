// Goal:   the service says who it is before anything else and again when that changes; a simulator
//         that does not fit is refused with all that it writes, whichever of it comes first, and
//         another one is not disturbed.
// Method: a daemon whose every step the test writes.
#include <gtest/gtest.h>

#include "idl/limits.h"
#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"

namespace collision::server {
namespace {

v1::Input HelloFrom(std::uint64_t sender, const std::string& simulator, std::uint32_t revision) {
  v1::Input input;
  input.set_sender(sender);
  v1::SimulatorHello& hello = *input.mutable_simulator_hello();
  hello.set_simulator_id(SimulatorId(simulator));
  hello.set_simulator_name(simulator);
  hello.set_wire_revision(revision);
  return input;
}

std::size_t Mismatches(const ScriptedDaemon& daemon) {
  std::size_t count = 0;
  for (const v1::Rejection& one : daemon.rejections()) {
    count += one.reason() == v1::REJECTED_MISMATCH;
  }
  return count;
}

TEST(HelloOfService, ComesFirstAndAgainWithAnotherEpoch) {
  v1::Config config = Simulated();
  config.set_frame("ENU 1");
  ScriptedDaemon daemon(config);
  daemon.Step(AlphaJoins(1));
  ASSERT_FALSE(daemon.bus().outputs.empty());
  ASSERT_TRUE(daemon.bus().outputs.front().has_service_hello());
  const v1::ServiceHello hello = daemon.bus().outputs.front().service_hello();
  EXPECT_EQ(hello.wire_revision(), wire::kWireRevision);
  EXPECT_EQ(hello.frame(), "ENU 1");
  EXPECT_EQ(hello.epoch(), 1u);
  EXPECT_EQ(hello.service_id(), daemon.daemon().claim().instance());
  EXPECT_EQ(daemon.status().frame(), "ENU 1");
  daemon.Step({Command(7, v1::OPERATOR_RESTART_TIME)});
  daemon.Step({}, 1);
  std::vector<std::uint32_t> epochs;
  for (const v1::Output& output : daemon.bus().outputs) {
    if (output.has_service_hello()) epochs.push_back(output.service_hello().epoch());
  }
  EXPECT_EQ(epochs, (std::vector<std::uint32_t>{1, 2}));
}

TEST(HelloOfSimulator, WithAnotherRevisionNothingOfItIsTaken) {
  ScriptedDaemon daemon(Simulated());
  daemon.Step({HelloFrom(1, "alpha", wire::kWireRevision + 1)});
  daemon.Step(AlphaJoins(1));
  EXPECT_EQ(daemon.status().simulators_size(), 0);
  EXPECT_EQ(Mismatches(daemon), 1u);
  EXPECT_EQ(Extension(daemon.status(), "unfit"),
            "alpha: wire_revision 4; allowed: 3, that of the service: use one version for both");
  daemon.Step(AlphaJoins(2));
  EXPECT_EQ(daemon.status().agents(), 2u) << "another program of the name fits";
}

TEST(HelloOfSimulator, ThatComesLateEndsItsRun) {
  ScriptedDaemon daemon(Simulated());
  daemon.Step(AlphaJoins(1));
  ASSERT_EQ(daemon.status().agents(), 2u);
  daemon.Step({HelloFrom(1, "alpha", wire::kWireRevision)});
  EXPECT_EQ(daemon.status().agents(), 2u);
  daemon.Step({HelloFrom(1, "alpha", wire::kWireRevision + 1)});
  daemon.Step({}, 1);
  EXPECT_EQ(daemon.status().agents(), 0u);
  v1::RunEnd ended = v1::RUN_GOES_ON;
  for (const v1::Output& output : daemon.bus().outputs) {
    if (output.has_simulator_report()) ended = output.simulator_report().ended();
  }
  EXPECT_EQ(ended, v1::RUN_REFUSED);
}

}  // namespace
}  // namespace collision::server
