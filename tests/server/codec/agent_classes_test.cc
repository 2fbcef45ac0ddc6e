// Goal:   two classes meet if either lists the other, an agent without a class meets all, and an
//         unknown class is refused with those that there are.
// Method: a configuration with each case; every pair of its classes.
#include "server/codec/agent_classes.h"

#include <gtest/gtest.h>

#include "idl/limits.h"
#include "server/codec/codec.h"
#include "tests/server/messages.h"

namespace collision::server {
namespace {

v1::Config ConfigWith(
    const std::vector<std::pair<std::string, std::vector<std::string>>>& classes) {
  v1::Config config;
  for (const auto& [name, meets] : classes) {
    v1::AgentClass* one = config.add_classes();
    one->set_name(name);
    for (const std::string& met : meets) one->add_meets(met);
  }
  return config;
}

TEST(AgentClasses, MeetIfEitherListsTheOther) {
  const AgentClasses classes(ConfigWith(
      {{"robot", {"robot", "person"}}, {"person", {}}, {"ghost", {}}, {"zone", {"person"}}}));
  const std::pair<const char*, const char*> meeting[] = {
      {"robot", "robot"}, {"robot", "person"}, {"zone", "person"}};
  const char* names[] = {"", "robot", "person", "ghost", "zone"};
  for (const char* a : names) {
    for (const char* b : names) {
      bool expected = *a == '\0' || *b == '\0';
      for (const auto& [x, y] : meeting) {
        expected |= (std::string(a) == x && std::string(b) == y) ||
                    (std::string(a) == y && std::string(b) == x);
      }
      EXPECT_EQ(CanMeet(*classes.FilterOf(a), *classes.FilterOf(b)), expected) << a << " " << b;
    }
  }
  EXPECT_EQ(*classes.FilterOf(""), broad_phase::CollisionFilter());
}

TEST(AgentClasses, AsManyAsThereMayBeHaveAGroupEach) {
  v1::Config config;
  for (int i = 0; i < wire::kClassesMax; ++i) {
    v1::AgentClass* one = config.add_classes();
    one->set_name("c" + std::to_string(i));
    one->add_meets(one->name());
  }
  const AgentClasses classes(config);
  const auto filter = [&](int i) { return *classes.FilterOf("c" + std::to_string(i)); };
  for (int a = 0; a < wire::kClassesMax; ++a) {
    EXPECT_TRUE(CanMeet(filter(a), broad_phase::CollisionFilter()));
    for (int b = 0; b < wire::kClassesMax; ++b) EXPECT_EQ(CanMeet(filter(a), filter(b)), a == b);
  }
}

TEST(AgentClasses, AnUnknownOneIsRefusedWithThoseThatThereAre) {
  const auto detail = [](const v1::Config& config) {
    v1::AgentDescription description = Description("a", 1);
    description.set_class_name("robt");
    const auto decoded = DecodeDescription(description, AgentClasses(config));
    const Refusal& refusal = std::get<Refusal>(decoded);
    EXPECT_EQ(refusal.reason, v1::REJECTED_OUT_OF_RANGE);
    EXPECT_EQ(refusal.field, "class_name");
    EXPECT_LE(refusal.detail.size(), wire::kRefusalDetailMax);
    return refusal.detail;
  };
  EXPECT_EQ(
      detail(ConfigWith({{"robot", {}}, {"person", {}}})),
      "\"robt\"; allowed: the classes of the service's configuration: person, robot; or none");
  EXPECT_EQ(detail({}),
            "\"robt\"; allowed: the classes of the service's configuration: none is configured; or "
            "none");
  v1::Config many;
  for (int i = 0; i < wire::kClassesMax; ++i) {
    many.add_classes()->set_name(std::string(30, 'c') + std::to_string(10 + i));
  }
  EXPECT_TRUE(detail(many).ends_with(", ... (31 in all); or none")) << detail(many);
}

}  // namespace
}  // namespace collision::server
