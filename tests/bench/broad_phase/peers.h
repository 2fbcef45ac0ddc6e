// The libraries, each at its best reasonable use: swept boxes over a window, and for each pair of
// boxes that overlap the same closed form in plain double.
#pragma once

#include <limits>

#include "tests/bench/broad_phase/contestant.h"

namespace collision::bench {

/// Keeps the best of the pairs that a library reports.
class PairSink {
 public:
  PairSink(const baselines::BallScene& scene, double horizon) : scene_(scene), limit_(horizon) {}

  void Offer(std::uint32_t a, std::uint32_t b) {
    const double time = baselines::ReferenceIntersectionTime(scene_[a], scene_[b], limit_);
    if (time > limit_) return;
    if (a > b) std::swap(a, b);
    if (found_ && time == limit_ && std::pair(lower_, higher_) < std::pair(a, b)) return;
    found_ = true, limit_ = time, lower_ = a, higher_ = b;
  }

  bool found() const { return found_; }
  double time() const { return limit_; }
  Answer answer() const {
    if (!found_) return {};
    return {true, lower_, higher_, static_cast<std::int64_t>(limit_ * 1e9)};
  }

 private:
  const baselines::BallScene& scene_;
  double limit_;
  bool found_ = false;
  std::uint32_t lower_ = 0, higher_ = 0;
};

/// A library that finds the pairs whose swept boxes overlap.
class BoxPairs {
 public:
  virtual ~BoxPairs() = default;
  /// Offers each pair of agents whose boxes over [0, window] overlap to `sink`, once or twice.
  virtual void Find(const baselines::BallScene& scene, double window, PairSink* sink) = 0;
};

/// How the horizon is swept: whole, or in growing windows until one holds the answer, which is what
/// a careful user would do where hits come early. Both are measured, and the better one counts.
enum class Sweep { kWhole, kWindows };

std::unique_ptr<Contestant> MakePeer(std::unique_ptr<BoxPairs> library, Sweep sweep);

/// Those that were found when this was built.
std::vector<Entrant> Peers();

std::unique_ptr<BoxPairs> MakeEmbree();
std::unique_ptr<BoxPairs> MakeFcl();
std::unique_ptr<BoxPairs> MakeBullet();
std::unique_ptr<BoxPairs> MakeCgal();

}  // namespace collision::bench
