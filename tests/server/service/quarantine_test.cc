// Goal:   a message that fails the service each time it comes back is recognised and refused, with
//         a refusal to its sender; what came with it is served, and honest messages stay accepted.
// Method: daemons one after the other on one folder, each given the same messages, as the network's
//         history gives them; a planted fault throws while one message is applied, or at the end of
//         the step in which it was. A copy of the file stands for a process that was killed.
#include "server/claim/quarantine.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <new>
#include <set>

#include "server/recording/replay/replay.h"
#include "tests/server/captured_log.h"
#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"

namespace collision::server {
namespace {

constexpr std::uint64_t kAlpha = 10, kBeta = 20;  // senders
constexpr int kStepsMax = 50;

/// Fails when it publishes a refusal of what this simulator wrote in this slot.
class FailingBus final : public Bus {
 public:
  FailingBus(ScriptedBus* bus, bool fails) : bus_(*bus), fails_(fails) {}

  bool Receive(std::chrono::nanoseconds timeout, std::size_t limit,
               std::vector<v1::Input>* inputs) override {
    return bus_.Receive(timeout, limit, inputs);
  }
  void Publish(const v1::Output& output) override {
    if (fails_ && output.has_rejection() && output.rejection().field() == "radius_m") {
      throw std::bad_alloc();
    }
    bus_.Publish(output);
  }
  void Flush() override {}
  void Wake() override {}

 private:
  ScriptedBus& bus_;
  const bool fails_;
};

v1::AgentDescription PoisonOf(const std::string& simulator) {
  v1::AgentDescription description = Description(simulator, 7);
  description.set_radius_m(-1);
  return description;
}

class Batches final : public BatchSink {
 public:
  bool Record(const v1::RecordedBatch& batch) override {
    batches.push_back(batch);
    return true;
  }
  std::string error() const override { return {}; }
  std::vector<v1::RecordedBatch> batches;
};

class QuarantineTest : public testing::Test {
 protected:
  QuarantineTest() {
    std::string folder = testing::TempDir() + "quarantineXXXXXX";
    EXPECT_NE(mkdtemp(folder.data()), nullptr);
    folder_ = folder;
  }
  ~QuarantineTest() override { std::filesystem::remove_all(folder_); }

  /// One run of the service, which is given these messages at once. False: the fault ended it.
  bool Run(const std::vector<v1::Input>& inputs, bool fails) {
    scripted_ = {};
    batches_.clear();
    Batches sink;
    Quarantine quarantine(folder_, "lab", 0);
    FailingBus bus(&scripted_, fails);
    Daemon daemon(CompleteConfig(Simulated()), bus, scripted_,
                  {.recorder = &sink, .quarantine = &quarantine});
    scripted_.next = inputs;
    bool survives = true;
    try {
      for (int step = 0; step < kStepsMax; ++step) {
        scripted_.Pass(50'000'000);
        daemon.Step();
      }
    } catch (const std::bad_alloc&) {
      survives = false;
    }
    suspected_ = quarantine.suspected();
    quarantined_ = quarantine.quarantined();
    hash_ = daemon.event_log().hash();
    batches_ = sink.batches;
    return survives;
  }

  /// Slots of a simulator that the last run published clearances of.
  std::set<std::uint32_t> SlotsOf(const std::string& simulator) const {
    std::set<std::uint32_t> slots;
    for (const v1::Output& output : scripted_.outputs) {
      if (output.clearance().simulator_id() != SimulatorId(simulator)) continue;
      for (const v1::AgentClearance& agent : output.clearance().agents()) {
        slots.insert(agent.slot());
      }
    }
    return slots;
  }

  std::vector<v1::Rejection> Rejections() const {
    std::vector<v1::Rejection> all;
    for (const v1::Output& output : scripted_.outputs) {
      if (output.has_rejection()) all.push_back(output.rejection());
    }
    return all;
  }

  static std::vector<v1::Input> WithPoison() {
    std::vector<v1::Input> inputs = AlphaJoins(kAlpha);
    inputs.push_back(From(kBeta, PoisonOf("beta")));
    return inputs;
  }

  std::string folder_;
  ScriptedBus scripted_;
  std::vector<v1::RecordedBatch> batches_;
  std::uint32_t suspected_ = 0, quarantined_ = 0;
  std::uint64_t hash_ = 0;
};

TEST_F(QuarantineTest, WhatFailsTwiceIsRefusedAndTheRestIsServed) {
  EXPECT_FALSE(Run(WithPoison(), true));  // nobody knows which message it was
  EXPECT_FALSE(Run(WithPoison(), true));  // the message is alone
  ASSERT_TRUE(Run(WithPoison(), true));
  EXPECT_EQ(quarantined_, 1u);
  EXPECT_EQ(suspected_, 0u);
  EXPECT_FALSE(SlotsOf("alpha").empty());
  ASSERT_EQ(Rejections().size(), 1u);
  const v1::Rejection rejection = Rejections().front();
  EXPECT_EQ(rejection.simulator_id(), SimulatorId("beta"));
  EXPECT_EQ(rejection.slot(), 7u);
  EXPECT_EQ(rejection.field(), "content");
  EXPECT_NE(rejection.detail().find("allowed: other content"), std::string::npos);
}

TEST_F(QuarantineTest, OtherContentIsAcceptedAndTheFileRemovedEndsIt) {
  EXPECT_FALSE(Run(WithPoison(), true));
  EXPECT_FALSE(Run(WithPoison(), true));
  std::vector<v1::Input> mended = WithPoison();
  mended.back().mutable_agent_description()->set_radius_m(1);
  ASSERT_TRUE(Run(mended, true));
  EXPECT_TRUE(Rejections().empty());
  ASSERT_TRUE(Run(WithPoison(), false));
  EXPECT_EQ(Rejections().at(0).field(), "content");
  std::filesystem::remove_all(folder_);
  std::filesystem::create_directories(folder_);
  ASSERT_TRUE(Run(WithPoison(), false));
  EXPECT_EQ(Rejections().at(0).field(), "radius_m");
}

TEST_F(QuarantineTest, AFaultThatDoesNotComeAgainLeavesNothingBehind) {
  EXPECT_FALSE(Run(WithPoison(), true));
  ASSERT_TRUE(Run(WithPoison(), false));
  EXPECT_EQ(quarantined_, 0u);
  EXPECT_EQ(suspected_, 0u);
  EXPECT_FALSE(SlotsOf("alpha").empty());
}

TEST_F(QuarantineTest, ARunWithSuspectsIsReplayedBitForBit) {
  EXPECT_FALSE(Run(WithPoison(), true));
  EXPECT_FALSE(Run(WithPoison(), true));
  ASSERT_TRUE(Run(WithPoison(), true));
  const std::string path = folder_ + "/run.rec";
  {
    RecordingWriter writer(path, CompleteConfig(Simulated()));
    for (const v1::RecordedBatch& batch : batches_) ASSERT_TRUE(writer.Record(batch));
  }
  RecordingReader reader(path);
  std::size_t rejections = 0;
  ReplaySource source(reader, [&](const v1::Output& output) {
    rejections += output.rejection().field() == "content";
  });
  Daemon daemon(reader.config(), source, source);
  while (daemon.Step()) {
  }
  EXPECT_EQ(daemon.event_log().hash(), hash_);
  EXPECT_EQ(rejections, 1u);
}

// The message that was being applied is known, whatever came with it.
TEST_F(QuarantineTest, AProcessThatIsKilledLeavesTheMessageThatWasBeingApplied) {
  std::filesystem::create_directories(folder_ + "/killed");
  const std::vector<v1::Input> inputs = WithPoison();
  const auto killed_at = [&](std::size_t last) {
    Quarantine quarantine(folder_, "lab", 0);
    quarantine.BeginStep();
    for (std::size_t i = 0; i <= last; ++i) quarantine.Apply(inputs[i]);
    std::filesystem::copy(quarantine.path(), folder_ + "/killed",
                          std::filesystem::copy_options::overwrite_existing);
    quarantine.EndMessages();
    quarantine.EndStep();
  };
  killed_at(1);
  Quarantine after(folder_ + "/killed", "lab", 0);
  EXPECT_EQ(after.suspected(), 1u);
  std::vector<v1::Input> batch = inputs;
  after.Screen(&batch);
  ASSERT_EQ(batch.size(), 1u);
  EXPECT_TRUE(batch[0].suspected());
  EXPECT_EQ(MarkOf(batch[0]), MarkOf(inputs[1]));
  EXPECT_TRUE(after.holds());
  after.BeginStep();
  after.EndStep();
  batch.clear();
  after.Screen(&batch);
  EXPECT_EQ(batch.size(), inputs.size() - 1);
  EXPECT_FALSE(after.holds());
  EXPECT_EQ(after.suspected(), 0u);
}

// Goal:   an operator reads whose message is suspected, or that none is.
TEST_F(QuarantineTest, LogAndStatusNameTheSimulator) {
  const std::vector<v1::Input> inputs = WithPoison();
  const auto killed_after = [&](std::size_t messages) {
    std::filesystem::create_directory(folder_ + "/killed");
    Quarantine quarantine(folder_, "lab", 0);
    quarantine.BeginStep();
    for (std::size_t i = 0; i < messages; ++i) quarantine.Apply(inputs[inputs.size() - 1 - i]);
    std::filesystem::copy(quarantine.path(), folder_ + "/killed",
                          std::filesystem::copy_options::overwrite_existing);
    quarantine.EndStep();
  };
  const std::string beta = IdText(SimulatorId("beta"));
  killed_after(0);
  CapturedLog log;
  EXPECT_EQ(Quarantine(folder_ + "/killed", "lab", 0).Summary(), "");
  EXPECT_NE(log.Take().find("no message is suspected"), std::string::npos);
  killed_after(1);
  const Quarantine::Roster roster = {
      {SimulatorId("beta"), {.id = SimulatorId("beta"), .run = 1, .name = "beta", .granted = {}}}};
  {
    Quarantine named(folder_ + "/killed", "lab", 0, roster);
    EXPECT_TRUE(named.Summary().starts_with("1 suspected, the first: simulator " + beta +
                                            " \"beta\", description of slot 7, content "))
        << named.Summary();
    const std::string text = log.Take();
    EXPECT_NE(text.find("suspected, and applied in steps of their own: simulator " + beta +
                        " \"beta\", description of slot 7"),
              std::string::npos)
        << text;
  }
  killed_after(1);
  Quarantine unnamed(folder_ + "/killed", "lab", 0);
  EXPECT_TRUE(unnamed.Summary().starts_with("1 suspected, the first: simulator " + beta + ", "));
  std::vector<v1::Input> batch = inputs;
  unnamed.Screen(&batch);
  EXPECT_TRUE(
      unnamed.Summary().starts_with("1 suspected, the first: simulator " + beta + " \"beta\", "))
      << "it has come back, and says its name";
}

TEST_F(QuarantineTest, AnEndBetweenTwoStepsSuspectsNothing) {
  { Run(WithPoison(), false); }
  EXPECT_EQ(Quarantine(folder_, "lab", 0).suspected(), 0u);
  EXPECT_EQ(Quarantine(folder_, "lab", 0).Summary(), "");
}

TEST_F(QuarantineTest, AFileOfSomethingElseIsBegunAnew) {
  const std::string path = Quarantine(folder_, "lab", 0).path();
  std::ofstream(path) << "something else";
  EXPECT_EQ(Quarantine(folder_, "lab", 0).Summary(), "");
  EXPECT_THROW(Quarantine(folder_ + "/missing", "lab", 0), std::runtime_error);
}

TEST(MessageMark, ChangesWithTheContentAndNotWithTheWriting) {
  v1::AgentDescription description = Description("alpha", 3);
  const MessageMark mark = MarkOf(From(kAlpha, description));
  description.set_sequence(description.sequence() + 1);
  EXPECT_EQ(MarkOf(From(kBeta, description)), mark);
  description.set_radius_m(description.radius_m() + 1);
  EXPECT_NE(MarkOf(From(kAlpha, description)), mark);
  v1::Input removal;
  removal.mutable_agent_removal()->set_slot(3);
  EXPECT_EQ(MarkOf(removal).kind, 0u);
}

}  // namespace
}  // namespace collision::server
