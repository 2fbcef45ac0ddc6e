// Goal:   of any number of services in one world exactly one stays.
// Method: services with random starts, partitions of the network and lost samples, simulated in
//         steps, from a seed.
#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

#include "server/claim/service_claim.h"

namespace collision::server {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

/// Services that hear each other while they are on the same side of a parted network.
class Room {
 public:
  explicit Room(std::uint32_t seed) : random_(seed) {}

  void Start() {
    services_.push_back({ServiceClaim({.instance = random_(),
                                       .term_before = static_cast<std::uint32_t>(random_() % 4),
                                       .wait_ns = kSecond,
                                       .heard_for_ns = 2 * kSecond}),
                         random_() % 2 == 0});
    services_.back().first.SetFollowed(random_() % 2 == 0);
  }
  void Part(bool parted) { parted_ = parted; }

  void Run(std::int64_t seconds) {
    for (int i = 0; i < 4 * seconds; ++i, now_ns_ += kSecond / 4) Step();
  }

  std::size_t serving() const {
    std::size_t count = 0;
    for (const auto& [claim, left] : services_) count += claim.phase() == ClaimPhase::kServing;
    return count;
  }

 private:
  void Step() {
    ++sequence_;
    for (const auto& [speaker, speaker_left] : services_) {
      if (speaker.phase() == ClaimPhase::kYielded) continue;
      for (auto& [hearer, hearer_left] : services_) {
        if (parted_ && speaker_left != hearer_left) continue;
        if (random_() % 5 == 0) continue;  // lost
        hearer.Hear({.instance = speaker.instance(),
                     .term = speaker.term(),
                     .phase = speaker.phase() == ClaimPhase::kServing ? OtherPhase::kServing
                                                                      : OtherPhase::kClaiming,
                     .sequence = sequence_,
                     .followed = speaker.followed()},
                    now_ns_);
      }
    }
    for (auto& [claim, left] : services_) claim.Update(now_ns_);
  }

  std::mt19937 random_;
  std::vector<std::pair<ServiceClaim, bool>> services_;
  bool parted_ = false;
  std::int64_t now_ns_ = 0;
  std::uint64_t sequence_ = 0;
};

TEST(ServiceClaims, OfAnyNumberExactlyOneStays) {
  for (std::uint32_t seed = 1; seed <= 300; ++seed) {
    Room room(seed);
    std::mt19937 random(seed);
    for (std::size_t i = 0, starts = 1 + random() % 6; i < starts; ++i) {
      room.Start();
      room.Run(random() % 3);
    }
    room.Run(4);
    EXPECT_EQ(room.serving(), 1u) << "seed " << seed;
    room.Part(true);
    room.Start();
    room.Start();
    room.Run(4);
    EXPECT_GE(room.serving(), 1u) << "seed " << seed;
    EXPECT_LE(room.serving(), 2u) << "seed " << seed;
    room.Part(false);
    room.Run(4);
    EXPECT_EQ(room.serving(), 1u) << "seed " << seed;
  }
}

}  // namespace
}  // namespace collision::server
