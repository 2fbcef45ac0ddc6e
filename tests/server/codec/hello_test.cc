// Goal:   a simulator that does not fit the service is refused by the field that differs, and no
//         other is.
// Method: a hello that fits, spoiled in one place at a time.
#include "server/codec/hello.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <string>

#include "idl/identity.h"
#include "idl/limits.h"
#include "server/config/config.h"

namespace collision::server {
namespace {

v1::SimulatorHello Fitting() {
  v1::SimulatorHello hello;
  hello.set_simulator_name("a");
  hello.set_simulator_id(SimulatorId("a"));
  hello.set_incarnation(5);
  hello.set_wire_revision(wire::kWireRevision);
  hello.set_clock_kind(v1::CLOCK_LOCK_STEP);
  hello.set_frame("ENU 1");
  return hello;
}

v1::ServiceHello Service(const std::string& frame = "ENU 1") {
  v1::Config config;
  config.set_frame(frame);
  config.set_epoch_utc("2026-01-01T00:00:00Z");
  config.mutable_clock()->set_skew_max_s(0.002);
  return HelloOf(CompleteConfig(config));
}

TEST(Hello, SaysWhatTheConfigurationStates) {
  const v1::ServiceHello hello = Service();
  EXPECT_EQ(hello.wire_revision(), wire::kWireRevision);
  EXPECT_EQ(hello.clock_kind(), v1::CLOCK_LOCK_STEP);
  EXPECT_EQ(hello.skew_max_ns(), 2'000'000);
  EXPECT_EQ(hello.world(), "default");
  EXPECT_EQ(hello.frame(), "ENU 1");
  EXPECT_EQ(hello.epoch_utc(), "2026-01-01T00:00:00Z");
  ASSERT_EQ(hello.regions_size(), 1);
  EXPECT_EQ(hello.regions(0), hello.region());
}

TEST(Hello, TellsWhichClassesMeetIfThereIsRoom) {
  v1::Config config;
  const auto add = [&config](const std::string& name) {
    v1::AgentClass* one = config.add_classes();
    one->set_name(name);
    return one;
  };
  v1::AgentClass* robot = add("robot");
  robot->add_meets("person");
  robot->add_meets("robot");
  add("person");
  config.add_excluded();
  const auto told = [&config] {
    std::map<std::string, std::string> extensions;
    const v1::ServiceHello hello = HelloOf(config);
    for (const v1::KeyValue& one : hello.extensions()) extensions[one.key()] = one.value();
    return extensions;
  };
  EXPECT_EQ(told(), (std::map<std::string, std::string>{{"excluded", "1"},
                                                        {"class.robot", "person robot"},
                                                        {"class.person", ""},
                                                        {"levels", ""}}));
  for (int i = 2; i < wire::kHelloExtensionsMax - 1; ++i) add("class-" + std::to_string(i));
  EXPECT_EQ(told().size(), static_cast<std::size_t>(wire::kHelloExtensionsMax));
  for (int i = 0; i < 40; ++i) robot->add_meets("class-" + std::to_string(i % 9 + 2));
  EXPECT_EQ(told().size(), 2u) << "a list is too long";
  robot->clear_meets();
  add("one-more");
  EXPECT_EQ(told().size(), 2u) << "too many classes";
}

// Goal:   all levels are told, or none, where their names have no room.
TEST(Hello, TellsItsLevelsIfThereIsRoom) {
  v1::Config config;
  const auto told = [&config] {
    const v1::ServiceHello hello = HelloOf(config);
    const v1::KeyValue& last = hello.extensions(hello.extensions_size() - 1);
    return last.key() + "=" + last.value();
  };
  config.add_levels()->set_name("near");
  config.add_levels()->set_name("keep-out");
  EXPECT_EQ(told(), "levels=near keep-out");
  for (int i = 0; i < 6; ++i) config.add_levels()->set_name(std::string(64, 'a'));
  EXPECT_EQ(told(), "excluded=0");
}

TEST(Hello, WhatDoesNotFitIsRefusedByField) {
  const auto refusal = [](const std::function<void(v1::SimulatorHello*)>& spoil) {
    v1::SimulatorHello hello = Fitting();
    spoil(&hello);
    return CheckHello(hello, Service());
  };
  using H = v1::SimulatorHello;
  EXPECT_FALSE(refusal([](H*) {}));
  const auto name = refusal([](H* h) { h->set_simulator_name("a\x1b[2J"); });
  ASSERT_TRUE(name);
  EXPECT_EQ(name->field, "simulator_name");
  const auto frame = refusal([](H* h) { h->set_frame("two\nlines"); });
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->field, "frame");
  EXPECT_EQ(frame->reason, v1::REJECTED_OUT_OF_RANGE);
  const auto revision = refusal([](H* h) { h->set_wire_revision(1); });
  ASSERT_TRUE(revision);
  EXPECT_EQ(revision->reason, v1::REJECTED_MISMATCH);
  EXPECT_EQ(revision->topic, v1::TOPIC_SIMULATOR_HELLO);
  EXPECT_EQ(revision->incarnation, 5u);
  EXPECT_EQ(revision->field, "wire_revision");
  EXPECT_EQ(revision->detail, "1; allowed: 3, that of the service: use one version for both");
  EXPECT_EQ(refusal([](H* h) { h->set_clock_kind(v1::CLOCK_REAL_TIME); })->field, "clock_kind");
  EXPECT_EQ(refusal([](H* h) { h->set_frame("ENU 2"); })->field, "frame");
  EXPECT_EQ(refusal([](H* h) { h->set_simulator_name("b"); })->reason, v1::REJECTED_ID_MISMATCH);
}

TEST(Hello, AFrameThatOneSideDoesNotStateFits) {
  v1::SimulatorHello hello = Fitting();
  EXPECT_FALSE(CheckHello(hello, Service("")));
  hello.clear_frame();
  EXPECT_FALSE(CheckHello(hello, Service()));
}

}  // namespace
}  // namespace collision::server
