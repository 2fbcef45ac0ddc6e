#include "tests/bench/scenes/frame_stepping.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "client/checker/motion/motion.h"
#include "client/checker/shape/bodies.h"
#include "tests/bench/harness/measure.h"

namespace collision::bench {
namespace {

using checker::AgentMotion;
using checker::Piece;
using checker::TrueContact;
using checker::Vector;

struct Present {
  std::size_t agent;
  const Piece* piece;
  Vector p;
  double reach;
};

const Piece* PieceAt(const AgentMotion& motion, std::int64_t now) {
  if (now < motion.begin_ns() || now > motion.end_ns()) return nullptr;
  const auto after =
      std::upper_bound(motion.pieces.begin(), motion.pieces.end(), now,
                       [](std::int64_t t, const Piece& piece) { return t < piece.t0_ns; });
  const Piece& piece = *std::prev(after);
  return now <= piece.t1_ns ? &piece : nullptr;
}

Vector PositionAt(const Piece& piece, std::int64_t now) {
  const long double s = 1e-9L * static_cast<long double>(now - piece.t0_ns);
  double at[3];
  for (int axis = 0; axis < 3; ++axis) {
    const auto& c = piece.p_WA[static_cast<std::size_t>(axis)];
    at[axis] = static_cast<double>(c[0] + s * (c[1] + s * (c[2] + s * c[3])));
  }
  return {at[0], at[1], at[2]};
}

class Stepper {
 public:
  Stepper(const std::vector<AgentMotion>& motions, SteppingResult* result)
      : motions_(motions), result_(result) {
    for (const AgentMotion& motion : motions) reaches_.push_back(motion.body().reach());
  }

  /// The pairs in contact in this frame.
  std::set<std::pair<std::size_t, std::size_t>> Frame(std::int64_t now) {
    Gather(now);
    near_.clear();
    const double start = CpuNow();
    for (std::size_t i = 0; i < present_.size(); ++i) {
      for (std::size_t j = i + 1; j < present_.size(); ++j) {
        const double reach = present_[i].reach + present_[j].reach;
        if (Squared(present_[j].p - present_[i].p) <= reach * reach) near_.emplace_back(i, j);
      }
    }
    const double between = CpuNow();
    result_->ball_seconds += between - start;
    result_->pair_tests += present_.size() * (present_.size() - 1) / 2;
    std::set<std::pair<std::size_t, std::size_t>> touching;
    for (const auto& [i, j] : near_) {
      if (Touch(present_[i], present_[j], now)) {
        touching.emplace(present_[i].agent, present_[j].agent);
      }
    }
    result_->shape_seconds += CpuNow() - between;
    return touching;
  }

 private:
  void Gather(std::int64_t now) {
    present_.clear();
    for (std::size_t agent = 0; agent < motions_.size(); ++agent) {
      const Piece* piece = PieceAt(motions_[agent], now);
      if (piece != nullptr) {
        present_.push_back({agent, piece, PositionAt(*piece, now), reaches_[agent]});
      }
    }
  }

  bool Touch(const Present& a, const Present& b, std::int64_t now) {
    const checker::Body body_a = motions_[a.agent].body(), body_b = motions_[b.agent].body();
    if (body_a.IsBall() && body_b.IsBall()) return true;
    ++result_->shape_tests;
    const checker::PairMotion motion(*a.piece, *b.piece, now);
    checker::Hint hint;
    return InContact(body_a, body_b, motion.At(0), &hint);
  }

  const std::vector<AgentMotion>& motions_;
  SteppingResult* result_;
  std::vector<double> reaches_;
  std::vector<Present> present_;
  std::vector<std::pair<std::size_t, std::size_t>> near_;
};

}  // namespace

SteppingResult StepThrough(const std::vector<AgentMotion>& motions,
                           const std::vector<TrueContact>& contacts, double rate) {
  SteppingResult result;
  if (motions.empty()) return result;
  std::int64_t begin = motions.front().begin_ns(), end = motions.front().end_ns();
  for (const AgentMotion& motion : motions) {
    begin = std::min(begin, motion.begin_ns()), end = std::max(end, motion.end_ns());
  }
  std::vector<std::optional<double>> seen(contacts.size());
  Stepper stepper(motions, &result);
  for (std::int64_t frame = 0;; ++frame) {
    const std::int64_t now = begin + std::llround(static_cast<double>(frame) * 1e9 / rate);
    if (now > end) break;
    ++result.frames;
    const auto touching = stepper.Frame(now);
    if (touching.empty()) continue;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const TrueContact& contact = contacts[i];
      const bool during = now >= contact.begin_ns && now <= contact.end_ns;
      if (seen[i] || !during || !touching.contains({contact.a, contact.b})) continue;
      seen[i] = 1e-9 * static_cast<double>(now - contact.begin_ns);
    }
  }
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (!contacts[i].certain) continue;
    ++result.contacts;
    if (!seen[i]) {
      ++result.missed;
    } else if (!contacts[i].from_start) {
      result.late.push_back(*seen[i]);
    }
  }
  return result;
}

}  // namespace collision::bench
