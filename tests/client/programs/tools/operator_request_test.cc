// Goal:   a command is handed to a service that serves, once, and its own answer decides the
//         outcome; silence is told apart from refusal.
// Method: a network under the test's control plays the service.
#include "client/programs/tools/collisionctl/operator_request.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/client/fake_transport.h"

namespace collision::client {
namespace {

class OperatorRequestTest : public testing::Test {
 protected:
  v1::ServiceStatus* Status(v1::ServicePhase phase = v1::PHASE_SERVING) {
    v1::ServiceStatus* status = network_->arriving.emplace_back().mutable_service_status();
    status->set_phase(phase);
    return status;
  }

  void Answer(const std::string& key, const std::string& value) {
    v1::KeyValue* extension = Status()->add_extensions();
    extension->set_key(key);
    extension->set_value(value);
  }

  RequestResult Ask(std::chrono::nanoseconds timeout = std::chrono::hours(1)) {
    command_.set_command_id(0xab);
    command_.set_kind(v1::OPERATOR_EVICT);
    command_.set_simulator("beta");
    FakeTransport transport(network_);
    return Request(&transport, command_, Deadline(timeout));
  }

  std::shared_ptr<FakeNetwork> network_ = std::make_shared<FakeNetwork>();
  v1::OperatorCommand command_;
};

TEST_F(OperatorRequestTest, TheAnswerToThisCommandDecides) {
  for (const char* text : {"done: simulator \"beta\" is removed", "refused: no simulator"}) {
    *network_ = {};
    Status();
    network_->on_wait = [&](FakeNetwork* network) {
      ASSERT_EQ(network->written.size(), 1u) << "it is written once";
      EXPECT_EQ(network->flushed, 1u);
      EXPECT_EQ(network->written[0].operator_command().simulator(), "beta");
      Answer("operator.00000000000000ac", "done: somebody else's");
      Status();
      Answer("operator.00000000000000ab", text);
    };
    const RequestResult result = Ask();
    EXPECT_EQ(result.answer, text);
    EXPECT_EQ(result.outcome, text[0] == 'd' ? RequestOutcome::kDone : RequestOutcome::kRefused);
  }
}

TEST_F(OperatorRequestTest, AServiceThatClaimsIsNotAsked) {
  Status(v1::PHASE_CLAIMING);
  int waits = 0;
  network_->on_wait = [&](FakeNetwork* network) {
    EXPECT_EQ(network->written.empty(), waits == 0);
    if (waits++ == 0) {
      Status();
    } else {
      Answer("operator.00000000000000ab", "done: ");
    }
  };
  EXPECT_EQ(Ask().outcome, RequestOutcome::kDone);
}

TEST_F(OperatorRequestTest, NoServiceAndNoAnswerAreToldApart) {
  EXPECT_EQ(Ask(std::chrono::nanoseconds(0)).outcome, RequestOutcome::kNoService);
  EXPECT_TRUE(network_->written.empty());
  Status();
  EXPECT_EQ(Ask(std::chrono::nanoseconds(0)).outcome, RequestOutcome::kNoAnswer);
  EXPECT_EQ(network_->written.size(), 1u);
}

TEST(OperatorRequest, EachCommandHasAnIdOfItsOwn) {
  std::set<std::uint64_t> ids;
  for (int i = 0; i < 100; ++i) ids.insert(MakeCommand(v1::OPERATOR_EVICT, "x").command_id());
  EXPECT_EQ(ids.size(), 100u);
}

// Goal:   a program learns whether it was obeyed, and why not, whatever the words are.
TEST(OperatorJson, TellsDoneFromRefusedAndFromSilence) {
  EXPECT_EQ(ResultJson({RequestOutcome::kDone, "done: \"beta\" is out"}),
            R"({"schema":"collision/1","kind":"answer","done":true,"answer":"\"beta\" is out"})");
  EXPECT_EQ(ResultJson({RequestOutcome::kRefused, "refused: no simulator"}),
            R"({"schema":"collision/1","kind":"answer","done":false,"answer":"no simulator"})");
  EXPECT_EQ(ResultJson({RequestOutcome::kNoAnswer, ""}),
            R"({"schema":"collision/1","kind":"answer","done":false,"answer":null})");
}

}  // namespace
}  // namespace collision::client
