// Contestants that keep the earliest meeting of all current while one agent after the other is
// renewed.
#pragma once

#include <memory>

#include "tests/bench/broad_phase/answer.h"
#include "tests/bench/broad_phase/updates.h"

namespace collision::bench {

class Updated {
 public:
  virtual ~Updated() = default;
  /// The agent's new state; afterwards Earliest() is true of it.
  virtual void Update(std::uint32_t agent, const baselines::BallAgent& state) = 0;
  virtual Answer Earliest() = 0;
  /// From now on it is measured.
  virtual void WarmedUp() {}
  /// Agents asked again since the start.
  virtual std::uint64_t asked() const = 0;
};

/// How Bullet's tree is used: `kEager` asks the renewed agent at once, `kLazy` only when it is
/// first in the queue, as ours; that is also how it is warmed up.
enum class BulletUse { kEager, kLazy };

std::unique_ptr<Updated> MakeUpdatedBullet(const UpdateStream& stream, BulletUse use);

}  // namespace collision::bench
