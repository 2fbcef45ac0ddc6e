// Goal:   the board has what the world has: agents, the newest revision of each event with those
//         before, forecasts that were overtaken, shapes that are whole; and nothing twice.
// Method: messages by hand through a monitor without a network.
#include "client/programs/scene/scene.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "client/programs/scene/page_items.h"
#include "tests/client/fake_transport.h"
#include "tests/client/programs/tools/collisionctl_fixture.h"

namespace collision::client {
namespace {

class SceneTest : public CollisionctlTest {
 protected:
  /// What is new since the last call, without the bytes around JSON.
  std::vector<std::string> News() {
    items_.Put(scene_, scene_.TakeChanges(), {.service_alive = true});
    const auto news = board_.After(seen_, 1 << 20);
    seen_ = news.seen;
    std::vector<std::string> items;
    for (const Board::Item& item : news.items) {
      items.push_back(item.name + " " + item.payload->substr(8));
    }
    return items;
  }

  static bool Has(const std::vector<std::string>& items, const std::string& name,
                  const std::string& text) {
    for (const std::string& item : items) {
      if (item.starts_with(name + " ") && item.find(text) != std::string::npos) return true;
    }
    return false;
  }

  v1::CollisionEvent Possible(std::uint32_t slot, std::uint32_t other, std::uint32_t revision) {
    v1::CollisionEvent event = OwnEvent(1, revision, 0);
    event.set_status(v1::EVENT_POSSIBLE);
    event.set_pair_slot(slot);
    event.mutable_higher()->set_slot(other);
    event.set_now_ns(revision);
    return event;
  }

  Board board_;
  ShapeStore shapes_;
  Scene scene_{&shapes_};
  PageItems items_{&board_};
  MessageMonitor::Callbacks all_ = scene_.Callbacks();
  std::uint64_t seen_ = 0;
};

TEST_F(SceneTest, AnEventComesWithItsRevisions) {
  all_.event(Possible(5, 1, 1));
  all_.event(Possible(5, 1, 2));
  const auto items = News();
  EXPECT_TRUE(Has(items, "event/1", "\"revision\":2")) << testing::PrintToString(items);
  EXPECT_TRUE(Has(items, "event/1", "\"revisions\":[{\"now_ns\":\"1\""));
  EXPECT_TRUE(Has(items, "event/1", "\"now_ns\":\"2\",\"now_s\":0.000000002,\"begin\":"));
  EXPECT_TRUE(News().empty()) << "nothing is told twice";
}

TEST_F(SceneTest, AForecastThatAnotherPairReplacedIsOver) {
  all_.event(Possible(5, 1, 1));
  EXPECT_TRUE(Has(News(), "event/1", "\"superseded\":false"));
  all_.event(Possible(5, 2, 1));
  const auto items = News();
  EXPECT_TRUE(Has(items, "event/1", "\"superseded\":true")) << testing::PrintToString(items);
  EXPECT_TRUE(Has(items, "event/2", "\"superseded\":false"));
}

TEST_F(SceneTest, AContactIsNotOverBecauseItsSlotIsUsed) {
  v1::CollisionEvent contact = Possible(5, 1, 1);
  contact.set_status(v1::EVENT_CONFIRMED);
  all_.event(Possible(5, 1, 1));
  all_.event(contact);
  all_.event(Possible(5, 2, 1));
  EXPECT_TRUE(Has(News(), "event/1", "\"superseded\":false"));
}

TEST_F(SceneTest, OldEventsThatAreOverMakeRoom) {
  for (std::uint32_t i = 1; i <= EventBook::kEventsMax + 10; ++i) {
    v1::CollisionEvent event = Possible(i, i, 1);
    if (i == 3) event.set_status(v1::EVENT_DISMISSED);
    all_.event(event);
  }
  News();
  const auto kept = board_.After(0, 1 << 30);
  std::size_t events = 0;
  for (const Board::Item& item : kept.items) events += item.name.starts_with("event/");
  EXPECT_EQ(events, EventBook::kEventsMax);
  EXPECT_FALSE(std::ranges::any_of(kept.items, [](const Board::Item& item) {
    return item.name == "event/3";
  })) << "what is over goes first";
  EXPECT_TRUE(std::ranges::any_of(kept.items, [](const Board::Item& item) {
    return item.name.starts_with("gone/") &&
           item.payload->find("\"event/3\",\"event\":null") != std::string::npos;
  })) << "and those who have it are told";
}

TEST_F(SceneTest, WhatWasToldInAFormerEpochIsForgotten) {
  v1::ServiceStatus status;
  status.set_service_id(1);
  status.mutable_stamp()->set_epoch(1);
  all_.status(status);
  v1::CollisionEvent old = Possible(1, 1, 1), fresh = Possible(2, 2, 1);
  old.mutable_stamp()->set_epoch(1);
  all_.event(old);
  EXPECT_TRUE(Has(News(), "event/1", "\"epoch\":1"));
  fresh.mutable_stamp()->set_epoch(2);
  all_.event(fresh);
  status.mutable_stamp()->set_epoch(2);
  all_.status(status);
  all_.event(old);  // that the network kept
  const auto items = News();
  EXPECT_TRUE(Has(items, "gone/0", "\"event/1\",\"event\":null")) << testing::PrintToString(items);
  EXPECT_TRUE(Has(items, "event/2", "\"epoch\":2"));
  EXPECT_FALSE(Has(items, "event/3", ""));
}

TEST_F(SceneTest, AnAgentOfASilentSimulatorIsTold) {
  v1::AgentDescription description;
  description.set_simulator_id(9);
  description.set_run(1);
  description.set_simulator_name("people");
  description.set_agent_name("ada");
  description.set_radius_m(0.5);
  all_.description(description);
  v1::ServiceStatus status;
  v1::SimulatorStatus* people = status.add_simulators();
  people->set_simulator_id(9);
  people->set_name("people");
  people->set_run(1);
  people->set_alive(true);
  all_.status(status);
  EXPECT_TRUE(Has(News(), "agent/0", "\"presence\":\"held\""));
  all_.status(status);
  EXPECT_FALSE(Has(News(), "agent/0", "")) << "nothing has changed of it";
  people->set_alive(false);
  all_.status(status);
  EXPECT_TRUE(Has(News(), "agent/0", "\"presence\":\"silent\""));
}

TEST_F(SceneTest, AnAgentIsDescribedAndLeaves) {
  v1::AgentDescription description;
  description.set_simulator_id(9);
  description.set_slot(4);
  description.set_run(1);
  description.set_simulator_name("people");
  description.set_agent_name("ada");
  description.set_radius_m(0.5);
  all_.description(description);
  EXPECT_TRUE(Has(News(), "agent/0", "\"name\":\"ada\""));
  v1::AgentRemoval removal;
  removal.set_simulator_id(9);
  removal.set_slot(4);
  all_.removal(removal);
  EXPECT_TRUE(Has(News(), "agent/0", "\"agent\":null"));
}

}  // namespace
}  // namespace collision::client
