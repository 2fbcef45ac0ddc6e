// Goal:   keys steer the ship as their help says, in whatever pieces they arrive; and the pilot's
//         screen has room for everything at any size.
#include "client/programs/simulators/spaceship/spaceship_helm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "client/programs/shared/terminal.h"
#include "client/programs/simulators/spaceship/spaceship_panel.h"

namespace collision::client {
namespace {

std::int64_t StepTime(int step) { return std::llround(step * 1e9 / 60); }

std::vector<HelmKey> KeysOf(std::string typed) { return TakeKeys(&typed); }

TEST(HelmKeys, AreFoundAmongOthers) {
  EXPECT_EQ(KeysOf("w\033[Dzq"),
            (std::vector<HelmKey>{HelmKey::kThrust, HelmKey::kYawLeft, HelmKey::kQuit}));
  // Page up and a shifted arrow are not keys of the helm, nor are the letters in their sequences.
  EXPECT_EQ(KeysOf("\033[5~\033[1;2Ab"), (std::vector<HelmKey>{HelmKey::kBrake}));
  EXPECT_EQ(KeysOf("\033q"), (std::vector<HelmKey>{HelmKey::kQuit})) << "escape, then q";
  EXPECT_EQ(KeysOf("\033OC"), (std::vector<HelmKey>{HelmKey::kYawRight}));
}

TEST(HelmKeys, MayArriveInPieces) {
  std::string typed = "\033";
  EXPECT_TRUE(TakeKeys(&typed).empty());
  typed += "[";
  EXPECT_TRUE(TakeKeys(&typed).empty());
  typed += "Aq";
  EXPECT_EQ(TakeKeys(&typed), (std::vector<HelmKey>{HelmKey::kThrust, HelmKey::kQuit}));
  EXPECT_TRUE(typed.empty());
}

// Steps a ship for a second with a key held as a keyboard repeats it, 30 times a second.
Ship Held(HelmKey key, const RigidState& state = {}) {
  Ship ship(ShipLimits(), state);
  Helm helm;
  for (int step = 0; step < 60; ++step) {
    if (step % 2 == 0) helm.Press(key, step / 60.0);
    ship.Step(helm.Command(ship, step / 60.0), StepTime(step), StepTime(step + 1));
  }
  return ship;
}

TEST(Helm, SteersAsTheHelpSays) {
  EXPECT_NEAR(Held(HelmKey::kThrust).state().velocity_m_s[0], 6, 0.01);
  EXPECT_GT(Held(HelmKey::kYawLeft).heading()[1], 0.5);
  EXPECT_LT(Held(HelmKey::kYawRight).heading()[1], -0.5);
  EXPECT_GT(Held(HelmKey::kPitchUp).heading()[2], 0.5);
  EXPECT_LT(Held(HelmKey::kPitchDown).heading()[2], -0.5);
  // Rolling to the right lowers the right wing, the body's −y; the nose stays.
  const Quaternion right = Held(HelmKey::kRollRight).state().orientation;
  EXPECT_LT(Rotated(right, {0, -1, 0})[2], -0.5);
  EXPECT_NEAR(Rotated(right, {1, 0, 0})[0], 1, 1e-12);
  EXPECT_GT(Rotated(Held(HelmKey::kRollLeft).state().orientation, {0, -1, 0})[2], 0.5);
}

TEST(Helm, AKeyHoldsForAMomentAndThenTheTurnStops) {
  Ship ship(ShipLimits(), {});
  Helm helm;
  helm.Press(HelmKey::kYawLeft, 0);
  helm.Press(HelmKey::kThrust, 0);
  EXPECT_EQ(helm.Command(ship, Helm::kHold * 0.9).thrust, 1);
  EXPECT_GT(helm.Command(ship, Helm::kHold * 0.9).turn_rate_rad_s[2], 0);
  EXPECT_EQ(helm.Command(ship, Helm::kHold * 1.1).thrust, 0);
  EXPECT_EQ(helm.Command(ship, Helm::kHold * 1.1).turn_rate_rad_s, (Vector3{}));
  helm.Press(HelmKey::kThrust, 5);
  helm.Press(HelmKey::kSteady, 5.1);
  EXPECT_EQ(helm.Command(ship, 5.1).thrust, 0);
}

TEST(Helm, BrakesUntilItStopsOrAnotherKeyIsPressed) {
  RigidState state;
  state.velocity_m_s = {5, 3, -2};
  Ship ship(ShipLimits(), state);
  Helm helm;
  helm.Press(HelmKey::kBrake, 0);
  int step = 0;
  while (step < 900 && (helm.braking() || step == 0)) {
    ship.Step(helm.Command(ship, step / 60.0), StepTime(step), StepTime(step + 1));
    ++step;
  }
  EXPECT_FALSE(helm.braking());
  EXPECT_LE(Norm(ship.state().velocity_m_s), 0.3);
  helm.Press(HelmKey::kBrake, 20);
  EXPECT_TRUE(helm.braking());
  helm.Press(HelmKey::kFarther, 20);
  EXPECT_TRUE(helm.braking()) << "the radar does not steer";
  helm.Press(HelmKey::kYawLeft, 20);
  EXPECT_FALSE(helm.braking());
}

TEST(Helm, HelpNamesEveryLetter) {
  std::string help;
  for (const std::string& line : HelmHelp()) help += " " + line + " ";
  for (const char* key : {" w ", " a ", " d ", " r ", " f, ", " i ", " k ", " j ", " l ", " s ",
                          " space", " b ", " h ", " q ", " + ", " - "}) {
    const std::string bare(key);
    EXPECT_NE(help.find(bare), std::string::npos) << key;
  }
}

SpaceshipPanel Panel() {
  SpaceshipPanel panel;
  panel.time_s = 12.34;
  panel.speed_m_s = 4.5;
  panel.radar.heading = {0, 1, 0};
  panel.thrust = 0.6;
  panel.clearance = "clear for 1.20 s";
  panel.nearest = "drone-3, 12.1 m";
  panel.earliest = "drone-1 × drone-2 in 0.80 s";
  panel.radar.others = {{{10, 0, 0}}};
  for (int i = 0; i < 40; ++i) panel.events.push_back("event " + std::to_string(i));
  return panel;
}

TEST(SpaceshipPanel, ShowsInstrumentsRadarEventsAndKeys) {
  const auto lines = PanelLines(Panel(), 100, 40);
  ASSERT_EQ(lines.size(), 40u);
  EXPECT_NE(lines[0].find("12.3 s"), std::string::npos);
  EXPECT_NE(lines[0].find("4.5 m/s"), std::string::npos);
  EXPECT_NE(lines[0].find("heading 000°"), std::string::npos);
  EXPECT_NE(lines[0].find("███··"), std::string::npos);
  for (const char* part : {"clear for 1.20 s", "drone-3, 12.1 m", "drone-1 × drone-2"}) {
    EXPECT_NE(lines[1].find(part), std::string::npos) << part;
  }
  EXPECT_NE(std::find(lines.begin(), lines.end(), "event 39"), lines.end());
  EXPECT_EQ(std::find(lines.begin(), lines.end(), "event 0"), lines.end());
  EXPECT_NE(lines.back().find("q: end"), std::string::npos);
  SpaceshipPanel help = Panel();
  help.help = true;
  EXPECT_EQ(PanelLines(help, 100, 40).back(), HelmHelp().back());
}

TEST(SpaceshipPanel, FitsAnySize) {
  for (std::size_t columns : {1, 10, 20, 80, 300}) {
    for (std::size_t rows = 1; rows <= 60; ++rows) {
      const auto lines = PanelLines(Panel(), columns, rows);
      ASSERT_EQ(lines.size(), rows);
      for (const std::string& line : lines) ASSERT_EQ(Cut(line, columns), line);
    }
  }
}

}  // namespace
}  // namespace collision::client
