// Built only where the data folder is.
#include "tests/client/checker/truth.h"

namespace collision::client {
namespace {

struct Expected {
  const char* a;
  const char* b;
  double begin_s;
  double end_s;
};

// Goal:   the five contacts of the data README, exactly those, to its four decimals.
// Method: balls of 0.2 m around Hermite curves with central-difference velocities.
TEST(CorridorTruth, ExactlyTheFiveContactsOfTheDataReadme) {
  const auto motions = MotionsOf(COLLISION_DATA_DIR "/hermes_corridor_uo-065-240-240.csv", 0.2);
  const auto contacts = checker::TrueContacts(motions);
  const std::vector<Expected> expected = {{"9", "11", 67.0244, 68.5408},
                                          {"9", "11", 69.0250, 69.2585},
                                          {"52", "53", 89.9351, 90.3088},
                                          {"68", "69", 100.3741, 101.0553},
                                          {"61", "62", 103.1515, 103.2920}};
  EXPECT_EQ(motions.size(), 70u);
  ASSERT_EQ(contacts.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    std::string a = motions[contacts[i].a].agent, b = motions[contacts[i].b].agent;
    if (std::stoi(a) > std::stoi(b)) std::swap(a, b);
    EXPECT_EQ(a, expected[i].a);
    EXPECT_EQ(b, expected[i].b);
    EXPECT_NEAR(static_cast<double>(contacts[i].begin_ns * 1e-9L), expected[i].begin_s, 5.1e-5);
    EXPECT_NEAR(static_cast<double>(contacts[i].end_ns * 1e-9L), expected[i].end_s, 5.1e-5);
  }
}

}  // namespace
}  // namespace collision::client
