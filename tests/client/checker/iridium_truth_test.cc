#include "tests/client/checker/truth.h"

namespace collision::client {
namespace {

// Goal:   the checker's own truth is that of the literature, both for the begin and the end.
// Method: 500 m spheres around both satellites, cubic Hermite curves through their rows; the
//         published times have six decimals.
TEST(IridiumTruth, SpheresTouchAndPartAtThePublishedTimes) {
  const auto motions = MotionsOf(COLLISION_SCENES_DIR "/iridium33_cosmos2251_2009-02-10.csv", 500);
  ASSERT_EQ(motions.size(), 2u);
  const auto contacts = checker::TrueContacts(motions);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_NEAR(static_cast<double>(contacts[0].begin_ns * 1e-9L), 599.734303, 6e-7);
  EXPECT_NEAR(static_cast<double>(contacts[0].end_ns * 1e-9L), 599.857266, 6e-7);
  EXPECT_FALSE(contacts[0].from_start);
  EXPECT_FALSE(contacts[0].to_end);
}

// Goal:   the scene's declared bound holds for the curve that is played, and is not idle.
// Method: the derived bound of both curves against the declared 7.9 m/s².
TEST(IridiumTruth, PlayedMotionKeepsTheDeclaredBound) {
  const std::string path = COLLISION_SCENES_DIR "/iridium33_cosmos2251_2009-02-10.csv";
  std::ifstream file(path);
  const CsvRows rows = ReadCsv(file, path);
  for (const auto& [id, agent_rows] : rows.rows) {
    const double bound = Trajectory(agent_rows, rows.velocities, 0).AccelerationMax();
    EXPECT_LE(bound, 7.9) << id;
    EXPECT_GE(bound, 7.5) << id;
  }
}

}  // namespace
}  // namespace collision::client
