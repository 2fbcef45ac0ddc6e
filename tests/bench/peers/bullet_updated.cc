// Bullet's dynamic tree, kept current: each agent's leaf is its swept box.
#include <limits>
#include <vector>

#include "collision_core/numeric/seconds.h"
#include "tests/baselines/lazy_earliest.h"
#include "tests/bench/broad_phase/updated.h"
#include "tests/bench/peers/bullet_box.h"

namespace collision::bench {
namespace {

class UpdatedBullet : public Updated, private baselines::AgentAsker, private btDbvt::ICollide {
 public:
  UpdatedBullet(const UpdateStream& stream, BulletUse use)
      : agents_(stream.start),
        reach_(stream.horizon + 1.01 * stream.period),
        use_(use),
        earliest_(agents_.size(), stream.horizon, this) {
    for (std::size_t i = 0; i < agents_.size(); ++i) {
      leaves_.push_back(tree_.insert(BulletBox(baselines::SweptBoxOf(agents_[i], reach_)),
                                     reinterpret_cast<void*>(i)));
    }
    // As Bullet's own broad phase does at times: the tree of leaves that came in any order.
    tree_.optimizeIncremental(static_cast<int>(agents_.size()));
    for (std::size_t i = 0; i < agents_.size(); ++i)
      earliest_.Ask(static_cast<std::uint32_t>(i), Instant());
  }

  void Update(std::uint32_t agent, const baselines::BallAgent& state) override {
    agents_[agent] = state;
    now_ = numeric::AddRoundedDown(Instant(), state.stamp);
    btDbvtVolume box = BulletBox(baselines::SweptBoxOf(state, state.stamp + reach_));
    tree_.update(leaves_[agent], box);
    earliest_.Renewed(agent);
    if (eager_) earliest_.Ask(agent, now_);
  }

  void WarmedUp() override { eager_ = use_ == BulletUse::kEager; }

  Answer Earliest() override {
    const auto found = earliest_.Earliest(now_);
    if (!found) return {};
    return {true, std::min(found->agent, found->partner), std::max(found->agent, found->partner),
            found->when.nanoseconds()};
  }

  std::uint64_t asked() const override { return earliest_.asked(); }

 private:
  std::optional<baselines::AgentMeeting> Ask(std::uint32_t agent, Instant, Instant until) override {
    first_ = static_cast<double>(until.nanoseconds()) * 1e-9;
    asking_ = agent, partner_ = agent;
    // Only as far as is asked about, which the others' boxes hold at least.
    const btDbvtVolume box = BulletBox(baselines::SweptBoxOf(agents_[agent], first_));
    tree_.collideTVNoStackAlloc(tree_.m_root, box, stack_, *this);
    if (partner_ == agent) return std::nullopt;
    return baselines::AgentMeeting{partner_, numeric::AddRoundedDown(Instant(), first_)};
  }

  void Process(const btDbvtNode* leaf) override {
    const std::uint32_t other = AgentOf(leaf);
    if (other == asking_) return;
    const double time =
        baselines::ReferenceIntersectionTime(agents_[asking_], agents_[other], first_);
    if (time <= first_) first_ = time, partner_ = other;
  }

  baselines::BallScene agents_;
  double reach_;  ///< Of a box, from its agent's stamp on [s].
  BulletUse use_;
  bool eager_ = false;
  Instant now_;
  btDbvt tree_;
  btNodeStack stack_;
  std::vector<btDbvtNode*> leaves_;
  baselines::LazyEarliest earliest_;
  std::uint32_t asking_ = 0, partner_ = 0;
  double first_ = 0;  ///< The best so far [s].
};

}  // namespace

std::unique_ptr<Updated> MakeUpdatedBullet(const UpdateStream& stream, BulletUse use) {
  return std::make_unique<UpdatedBullet>(stream, use);
}

}  // namespace collision::bench
