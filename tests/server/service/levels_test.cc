// Goal:   a level tells when two agents come within its margin, with brackets that contain the true
//         time and are nearly tight, of balls and of shapes alike; it tells each pair that it is
//         meant to watch and no other, again only after they were far apart where it has a
//         hysteresis; and it changes nothing else.
// Method: agents that pass each other so that they cross a margin at times known exactly, at a
//         daemon that gets their states twenty times a second.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "tests/server/service/level_flight.h"
#include "tests/server/shapes/shapes.h"

namespace collision::server {
namespace {

constexpr double kWidth = 2e-3;  // of a bracket [s]; states are 50 ms apart

/// One at rest and one that passes it 4 m beside with 4 m/s: |28 − 4t| = 3 where it is 5 m away.
std::vector<Flyer> Passing() { return {AtRest(Ball(0), 0), Straight(Ball(1), 28, -4, 4)}; }

TEST(Levels, BracketWhenTwoBallsComeWithinTheMarginAndPart) {
  v1::Config config = TwentyAStep();
  AddLevel("near", 3, &config);
  const std::vector<v1::CollisionEvent> events = Fly(config, Passing(), 10);
  const auto begun = Told(events, "near", v1::EVENT_CONFIRMED);
  const auto ended = Told(events, "near", v1::EVENT_ENDED);
  ASSERT_EQ(ended.size(), 1u);
  ASSERT_GE(begun.size(), 1u);
  EXPECT_TRUE(Brackets(ended[0].begin(), 6.25, kWidth));
  EXPECT_TRUE(Brackets(ended[0].end(), 7.75, kWidth));
  EXPECT_EQ(ended[0].margin_m(), 3);
  EXPECT_EQ(ended[0].lower_label().agent_name(), "agent 0");
  const auto forecasts = Told(events, "near", v1::EVENT_POSSIBLE);
  ASSERT_GE(forecasts.size(), 1u);
  EXPECT_GE(forecasts[0].now_ns(), 1'500'000'000) << "look-ahead is that of contacts, 2 s";
  EXPECT_LE(forecasts[0].now_ns(), 4'250'000'000);
  EXPECT_TRUE(Told(events, "", v1::EVENT_CONFIRMED).empty()) << "the bodies stay 2 m apart";
}

// Goal:   a level of what is expected forecasts a pair that will cross it, and not one that could
//         but flies by.
// Method: an agent passes 4 m beside one and 7 m beside another one, which 5 m would cross.
TEST(Levels, ForecastWhatIsExpected) {
  v1::Config config = TwentyAStep();
  AddLevel("possible", 3, &config);
  AddLevel("expected", 3, &config)->set_basis(v1::Level::EXPECTED);
  std::vector<Flyer> flyers = Passing();
  flyers.push_back(AtRest(Ball(2), 0, 11));
  std::map<std::string, std::set<std::uint32_t>> forecast;
  for (const v1::CollisionEvent& event : Fly(config, flyers, 6)) {
    if (event.status() != v1::EVENT_POSSIBLE || event.level().empty()) continue;
    const bool with_first = event.lower().slot() == 0 && event.higher().slot() == 1;
    forecast[event.level()].insert(with_first ? 0 : event.lower().slot() + event.higher().slot());
  }
  EXPECT_TRUE(forecast["possible"].contains(3)) << "of slots 1 and 2";
  EXPECT_TRUE(forecast["expected"].contains(0));
  EXPECT_FALSE(forecast["expected"].contains(3));
}

// Goal:   boxes count from their faces: a level of 1.5 m is crossed where the gap is 1.5 m.
// Method: cubes of 2 m whose faces are 18 m apart and close in at 4 m/s.
TEST(Levels, AreExactForShapes) {
  const std::string bytes = EncodeShape(Cube(1));
  std::vector<v1::Input> parts;
  for (const v1::ShapePart& part : PartsOf("alpha", bytes)) {
    v1::Input input;
    input.set_sender(1);
    *input.mutable_shape_part() = part;
    parts.push_back(input);
  }
  const auto cube = [&](std::uint32_t slot) {
    v1::AgentDescription description = Ball(slot);
    description.set_radius_m(2);
    description.set_angular_acceleration_max_rad_s2(0);
    description.set_shape_hash(Sha256(bytes));
    return description;
  };
  v1::Config config = TwentyAStep();
  AddLevel("near", 1.5, &config);
  const auto events = Fly(config, {AtRest(cube(0), 0), Straight(cube(1), 20, -4, 0)}, 4.5, parts);
  const auto begun = Told(events, "near", v1::EVENT_CONFIRMED);
  ASSERT_GE(begun.size(), 1u);
  EXPECT_TRUE(Brackets(begun.back().begin(), (18 - 1.5) / 4, kWidth));
  EXPECT_TRUE(Told(events, "", v1::EVENT_CONFIRMED).empty());
}

// Goal:   between names the pairs of classes that are watched; all others cross the margin unsaid,
//         also agents without a class.
TEST(Levels, WatchThePairsOfClassesThatTheyName) {
  v1::Config config = TwentyAStep();
  for (const char* name : {"person", "robot"}) {
    v1::AgentClass* one = config.add_classes();
    one->set_name(name);
    one->add_meets("robot");
  }
  AddLevel("all", 3, &config);
  AddLevel("people", 3, &config)->add_between("robot/person");
  const auto events = Fly(config,
                          {AtRest(Ball(0, "person"), 0), AtRest(Ball(1, "robot"), 0, 8),
                           AtRest(Ball(2), 0, -8), Straight(Ball(3, "robot"), 20, -4, 4)},
                          9);
  std::map<std::string, std::set<std::uint32_t>> met;
  for (const char* level : {"all", "people"}) {
    for (const v1::CollisionEvent& event : Told(events, level, v1::EVENT_ENDED)) {
      EXPECT_EQ(event.higher().slot(), 3u);
      met[level].insert(event.lower().slot());
    }
  }
  EXPECT_EQ(met["all"], (std::set<std::uint32_t>{0, 1}));
  EXPECT_EQ(met["people"], (std::set<std::uint32_t>{0}));
}

constexpr double kPi = 3.141592653589793;
constexpr double kOut = 11 * kPi / 6;

/// Hovers about 5 m beside a ball at 0, ± 0.2 m, crossing 5 m inward at π/6, 5π/6 and 9π/6 s; from
/// kOut on it goes out to 6 m and comes back.
std::vector<Flyer> Hovering() {
  const auto motion = [](double t) {
    const double rate = t < kOut ? 3 : 0.6, phase = t < kOut ? 3 * t + kPi / 2 : 0.6 * (t - kOut);
    return std::pair(5 + 0.6 / rate * std::sin(phase), 0.6 * std::cos(phase));
  };
  return {AtRest(Ball(0), 0), {Ball(1), motion, 0}};
}

// Goal:   with a hysteresis of 0.5 m the second crossing that is told is the one after the pair was
//         6 m apart; without one each is told. The first is told by both.
TEST(Levels, TellAPairAgainOnlyAfterItWasFarApart) {
  v1::Config config = TwentyAStep();
  AddLevel("each", 3, &config);
  AddLevel("calm", 3, &config)->set_hysteresis_m(0.5);
  const auto events = Fly(config, Hovering(), 14);
  const auto each = Told(events, "each", v1::EVENT_ENDED);
  ASSERT_EQ(each.size(), 3u);
  const auto calm = Told(events, "calm", v1::EVENT_CONFIRMED);
  ASSERT_GE(calm.size(), 2u);
  EXPECT_TRUE(Brackets(calm.front().begin(), kPi / 6, 0.02));
  EXPECT_TRUE(Brackets(calm.back().begin(), kOut + kPi / 0.6, 0.02));
  std::set<std::uint32_t> contacts;
  for (const v1::CollisionEvent& event : calm) contacts.insert(event.contact());
  EXPECT_EQ(contacts.size(), 2u) << "no other crossing is told";
  EXPECT_EQ(Told(events, "calm", v1::EVENT_ENDED).size(), 1u) << "the second lasts";
}

TEST(Levels, ThereMayBeEightAtOnce) {
  v1::Config config = TwentyAStep();
  for (int i = 1; i <= 8; ++i) AddLevel("m" + std::to_string(i), 2 + 0.5 * i, &config);
  const std::vector<v1::CollisionEvent> events = Fly(config, Passing(), 14);
  std::map<std::pair<std::uint32_t, std::string>, std::string> levels_of_slots;
  for (const v1::CollisionEvent& event : events) {
    if (event.contacts_sequence() > 0) continue;
    const auto key = std::pair(event.pair_slot(), std::string());
    const auto [known, is_new] = levels_of_slots.emplace(key, event.level());
    EXPECT_EQ(known->second, event.level()) << "each slot belongs to one level";
  }
  for (int i = 1; i <= 8; ++i) {
    const double radius = 4 + 0.5 * i;  // 2 m of the bodies and the margin
    const double before = std::sqrt(radius * radius - 16) / 4;
    const auto ended = Told(events, "m" + std::to_string(i), v1::EVENT_ENDED);
    ASSERT_EQ(ended.size(), 1u) << i;
    EXPECT_TRUE(Brackets(ended[0].begin(), 7 - before, 3 * kWidth)) << i;
    EXPECT_TRUE(Brackets(ended[0].end(), 7 + before, 3 * kWidth)) << i;
  }
}

// Goal:   readers keep the newest forecast of each slot: it belongs to one pair of one level.
// Method: three in a row, 4 m apart, that may all come within 3 m of each other.
TEST(Levels, EachForecastHasASlotOfItsOwn) {
  v1::Config config = TwentyAStep();
  AddLevel("near", 3, &config);
  AddLevel("nearer", 2, &config);
  const auto events =
      Fly(config, {AtRest(Ball(0), 0), AtRest(Ball(1), 6), AtRest(Ball(2), 12)}, 0.5);
  std::map<std::uint32_t, std::set<std::string>> of_slots;
  std::set<std::string> all;
  for (const v1::CollisionEvent& event : events) {
    const std::string about = event.level() + " " + std::to_string(event.lower().slot()) + " " +
                              std::to_string(event.higher().slot());
    all.insert(about);
    of_slots[event.pair_slot()].insert(about);
  }
  EXPECT_GE(all.size(), 6u);
  EXPECT_EQ(of_slots.size(), all.size());
  for (const auto& [slot, about] : of_slots) EXPECT_EQ(about.size(), 1u) << slot;
}

// Goal:   contacts are those of a service without levels, but for their numbers, and the same
//         inputs give the same log.
TEST(Levels, ChangeNoContact) {
  const std::vector<Flyer> flyers = {AtRest(Ball(0), 0), Straight(Ball(1), 20, -4, 1)};
  const v1::Config without = TwentyAStep();
  v1::Config with = without;
  AddLevel("near", 3, &with)->set_hysteresis_m(1);
  const auto said = [](const std::vector<v1::CollisionEvent>& events) {
    std::string text;
    for (v1::CollisionEvent event : events) {
      if (!event.level().empty()) continue;
      event.clear_stamp();
      event.clear_pair_slot();
      event.clear_contacts_sequence();
      text += event.ShortDebugString() + "\n";
    }
    return text;
  };
  std::uint64_t hash = 0, again = 0;
  const std::string plain = said(Fly(without, flyers, 8));
  EXPECT_EQ(said(Fly(with, flyers, 8, {}, &hash)), plain);
  EXPECT_NE(plain.find("EVENT_ENDED"), plain.npos);
  Fly(with, flyers, 8, {}, &again);
  EXPECT_EQ(hash, again);
}

// Goal:   a state is wanted also where only a level is near.
// Method: an agent that passes another 30 m away, within a level of 29 m: contact is far off.
TEST(Levels, WantStates) {
  v1::Config config = TwentyAStep();
  const auto wanted_first = [](const v1::Config& of) {
    ScriptedDaemon daemon(of);
    daemon.Step(AlphaJoins(1));
    return daemon.clearance(SimulatorId("alpha")).agents(0).state_wanted_ns();
  };
  const std::int64_t without = wanted_first(config);
  AddLevel("near", 97, &config);
  EXPECT_LT(wanted_first(config), without);
}

// Goal:   what a level announces earlier it wants states for earlier.
// Method: two that may be 66 m apart after 4 s.
TEST(Levels, WantStatesByTheirOwnLookAhead) {
  std::int64_t before = kNeverNs;
  for (const double look_ahead : {1.0, 2.0, 3.0}) {
    v1::Config config = TwentyAStep();
    AddLevel("near", 66, &config)->set_look_ahead_s(look_ahead);
    ScriptedDaemon daemon(config);
    daemon.Step(AlphaJoins(1));
    const std::int64_t wanted_ns =
        daemon.clearance(SimulatorId("alpha")).agents(0).state_wanted_ns();
    EXPECT_LT(wanted_ns, before) << look_ahead;
    before = wanted_ns;
  }
}

}  // namespace
}  // namespace collision::server
