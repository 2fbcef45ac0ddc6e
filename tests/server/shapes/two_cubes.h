// Two agents with the same shape, for tests of the whole service.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "server/recording/recording.h"
#include "server/recording/replay/replay.h"
#include "tests/server/scripted_bus.h"
#include "tests/server/shapes/shapes.h"

namespace collision::server {

inline constexpr std::int64_t kSecond = 1'000'000'000;
inline constexpr std::uint64_t kAlpha = 10, kBeta = 20;  // senders

inline const std::string& CubeBytes() {
  static const std::string bytes = EncodeShape(Cube(1, UnusedFor(2)));
  return bytes;
}

/// Two agents at rest with next to no acceleration (two that cannot move never meet), `gap` m
/// apart, both with the cube; with new states at each clock.
class TwoCubes {
 public:
  explicit TwoCubes(double distance, std::string bytes = CubeBytes())
      : distance_(distance), bytes_(std::move(bytes)) {}

  std::vector<v1::Input> Descriptions() const {
    std::vector<v1::Input> inputs;
    for (std::uint32_t slot = 0; slot < 2; ++slot) {
      v1::AgentDescription wire = Shaped("alpha", slot, bytes_);
      wire.set_acceleration_max_m_s2(1e-9);
      wire.set_angular_acceleration_max_rad_s2(0);
      inputs.push_back(From(kAlpha, wire));
    }
    return inputs;
  }

  std::vector<v1::Input> Parts() const { return From(kAlpha, PartsOf("alpha", bytes_)); }

  /// States and clock of now, a sixtieth of a second after the last ones.
  std::vector<v1::Input> Tick() {
    v1::AgentStates chunk = Chunk("alpha");
    for (std::uint32_t slot = 0; slot < 2; ++slot) {
      v1::AgentState state = State(slot, clock_ns_, ++sequence_);
      state.mutable_position_m()->set_x(distance_ * slot);
      *chunk.add_states() = state;
    }
    std::vector<v1::Input> inputs = {From(kAlpha, chunk),
                                     From(kAlpha, ClockAfter("alpha", clock_ns_, sequence_, 2))};
    clock_ns_ += kSecond / 60;
    return inputs;
  }

 private:
  const double distance_;
  const std::string bytes_;
  std::int64_t clock_ns_ = 0;
  std::uint64_t sequence_ = 0;
};

/// The newest revision of the only event; POSSIBLE with revision 0 if there is none.
inline v1::CollisionEvent LastEvent(ScriptedDaemon& daemon) {
  v1::CollisionEvent last;
  for (const v1::Output& output : daemon.bus().outputs) {
    if (output.has_collision_event()) last = output.collision_event();
  }
  return last;
}

/// Replays the recording at `path`: its event log is to have this hash and number of events.
inline void ExpectSameReplay(const std::string& path, std::uint64_t hash, std::uint64_t count) {
  RecordingReader reader(path);
  ReplaySource source(reader);
  Daemon replayed(reader.config(), source, source, {.claim = reader.claim()});
  while (replayed.Step()) {
  }
  EXPECT_EQ(reader.error(), "");
  EXPECT_EQ(replayed.event_log().hash(), hash);
  EXPECT_EQ(replayed.event_log().count(), count);
}

inline void Fly(ScriptedDaemon* daemon, TwoCubes* cubes, int ticks) {
  for (int i = 0; i < ticks; ++i) daemon->Step(cubes->Tick(), 1.0 / 60);
}

}  // namespace collision::server
