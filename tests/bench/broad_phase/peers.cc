#include "tests/bench/broad_phase/peers.h"

#include <algorithm>

#include "tests/bench/harness/measure.h"

namespace collision::bench {
namespace {

/// The first window is this part of the horizon, and each next one so many times the last.
constexpr double kFirstWindow = 1.0 / 16, kWindowGrowth = 4;

class Peer : public Contestant {
 public:
  Peer(std::unique_ptr<BoxPairs> library, Sweep sweep)
      : library_(std::move(library)), sweep_(sweep) {}

  Timed Ask(const baselines::BallScene& scene, double horizon) override {
    const CpuStopwatch asking;
    Timed timed;
    double window = sweep_ == Sweep::kWhole ? horizon : horizon * kFirstWindow;
    for (;; window = std::min(horizon, window * kWindowGrowth)) {
      PairSink sink(scene, window);
      library_->Find(scene, window, &sink);
      timed.answer = sink.answer();
      if (sink.found() || window >= horizon) break;
    }
    timed.answer_in = asking.seconds();
    return timed;
  }

 private:
  std::unique_ptr<BoxPairs> library_;
  Sweep sweep_;
};

// Not used where none of the libraries is there.
[[maybe_unused]] void AddPeer(const std::string& name, std::unique_ptr<BoxPairs> (*make)(),
                              std::vector<Entrant>* peers) {
  peers->push_back({name, false, [make] { return MakePeer(make(), Sweep::kWhole); }});
  peers->push_back(
      {name + ", windows", false, [make] { return MakePeer(make(), Sweep::kWindows); }, name});
}

}  // namespace

std::unique_ptr<Contestant> MakePeer(std::unique_ptr<BoxPairs> library, Sweep sweep) {
  return std::make_unique<Peer>(std::move(library), sweep);
}

std::vector<Entrant> Peers() {
  std::vector<Entrant> peers;
#ifdef COLLISION_HAS_EMBREE
  AddPeer("Embree", MakeEmbree, &peers);
#endif
#ifdef COLLISION_HAS_FCL
  AddPeer("FCL", MakeFcl, &peers);
#endif
#ifdef COLLISION_HAS_BULLET
  AddPeer("Bullet", MakeBullet, &peers);
#endif
#ifdef COLLISION_HAS_CGAL
  AddPeer("CGAL", MakeCgal, &peers);
#endif
  return peers;
}

}  // namespace collision::bench
