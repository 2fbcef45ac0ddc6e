// Goal:   a standby that takes over while the service before it still has the journal gets it as
//         soon as that one lets go, with the term in force; one that cannot be opened is told.
#include "server/service/roster_journal.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <stdexcept>

#include "server/config/config.h"

namespace collision::server {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

class RosterJournalTest : public testing::Test {
 protected:
  RosterJournalTest() { std::filesystem::remove_all(folder_); }
  ~RosterJournalTest() override { std::filesystem::remove_all(folder_); }

  std::unique_ptr<Journal> OpenFile() const {
    return std::make_unique<Journal>(folder_, config_.world(), config_.domain(), 16);
  }

  bool KeepAt(std::int64_t monotonic_ns, RosterJournal* journal) {
    world_.SetReading({.wall_ns = 0, .monotonic_ns = monotonic_ns, .wall_was_set = false});
    return journal->Keep(world_);
  }

  const v1::Config config_ = CompleteConfig({});
  const std::string folder_ =
      testing::TempDir() + "roster_journal_test." + std::to_string(getpid());
  World world_{config_, {}};
};

TEST_F(RosterJournalTest, IsOpenedOnceTheServiceBeforeHasLetGo) {
  std::unique_ptr<Journal> of_the_other = OpenFile();
  std::unique_ptr<Journal> own;
  RosterJournal journal(config_, {.open = [&] { return (own = OpenFile()).get(); }});
  journal.SetTerm(2, 1, 0);
  EXPECT_EQ(journal.awaited(), "") << "it stands by";
  journal.Open();
  journal.SetTerm(3, 1, 0);
  EXPECT_NE(journal.awaited(), "");
  EXPECT_EQ(journal.failure(), "") << "no failure: the other one may stand still";
  of_the_other.reset();
  EXPECT_TRUE(KeepAt(kSecond - 1, &journal));
  EXPECT_EQ(own, nullptr);
  EXPECT_TRUE(KeepAt(kSecond, &journal));
  ASSERT_NE(own, nullptr);
  EXPECT_EQ(own->term(), 3u);
  EXPECT_EQ(journal.awaited(), "");
}

TEST_F(RosterJournalTest, TellsWhyItCannotBeOpenedAndEndsTheServiceIfThatIsWanted) {
  for (const bool ends : {true, false}) {
    v1::Config config = config_;
    config.set_on_state_failure(ends ? v1::Config::END : v1::Config::GO_ON);
    RosterJournal journal(config,
                          {.open = []() -> Journal* { throw std::runtime_error("broken"); }});
    journal.Open();
    journal.SetTerm(3, 1, 0);
    EXPECT_EQ(journal.failure(), "broken");
    EXPECT_EQ(KeepAt(kSecond, &journal), !ends);
  }
}

}  // namespace
}  // namespace collision::server
