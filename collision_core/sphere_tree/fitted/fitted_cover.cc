#include "collision_core/sphere_tree/fitted/fitted_cover.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace collision::sphere_tree {
namespace {

using Eigen::Vector3d;

/// Points that stand for a large part in the greedy cover, and pieces that it takes candidates
/// from.
constexpr std::size_t kSamplesMax = 1500, kStartsMin = 8, kStartsMax = 100;

constexpr int kBisections = 10;

/// Turns of sharing out and fitting; fewer for small parts, of which there are many.
constexpr int kTurns = 4, kTurnsOfFew = 2;
constexpr std::size_t kFew = 200;

/// Queries for the nearest surface when a ball is fitted.
constexpr int kQueries = 15;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

}  // namespace

void CoverSearch::Gather(std::span<const std::uint32_t> part) {
  ++stamp_;
  stamp_of_.resize(pieces_.points(), 0);
  local_of_.resize(pieces_.points());
  points_.clear();
  corners_.clear();
  for (const std::uint32_t index : part) {
    std::array<std::uint32_t, 3> local;
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t point = pieces_[index].corners[i];
      if (stamp_of_[point] != stamp_) {
        stamp_of_[point] = stamp_;
        local_of_[point] = static_cast<std::uint32_t>(points_.size());
        points_.push_back(pieces_.PointAt(point));
      }
      local[i] = local_of_[point];
    }
    corners_.push_back(local);
  }
}

void CoverSearch::AddCandidatesOf(std::uint32_t index, std::uint32_t piece) {
  known_of_.resize(pieces_.size());
  Known& known = known_of_[piece];
  if (known.count == 0) {
    known.first = static_cast<std::uint32_t>(known_.size());
    const auto& [a, b, c] = corners_[index];
    const Vector3d normal = (points_[b] - points_[a]).cross(points_[c] - points_[a]);
    const double length = normal.norm();
    const Vector3d unit = length > 0 ? Vector3d(normal / length) : Vector3d::Zero();
    const SurfacePoint middle{(points_[a] + points_[b] + points_[c]) / 3, unit,
                              pieces_[piece].triangle};
    AppendCandidates(boxes_, middle, length > 0 ? kind_ : SurfaceKind::kOpen, &known_);
    known.count = static_cast<std::uint32_t>(known_.size()) - known.first;
  }
  const auto first = known_.begin() + known.first;
  candidates_.insert(candidates_.end(), first, first + known.count);
}

void CoverSearch::FindCandidates(std::span<const std::uint32_t> part) {
  candidates_.clear();
  // The next start is where the candidates so far need the largest overshoot.
  least_.assign(part.size(), std::numeric_limits<float>::infinity());
  std::uint32_t start = 0;
  for (std::size_t n = 0; n < std::min({kStartsMax, part.size(), kStartsMin + part.size() / 4});
       ++n) {
    const std::size_t before = candidates_.size();
    AddCandidatesOf(start, part[start]);
    least_[start] = -std::numeric_limits<float>::infinity();
    std::uint32_t next = start;
    for (std::uint32_t i = 0; i < part.size(); ++i) {
      for (std::size_t k = before; k < candidates_.size(); ++k) {
        const double d = (points_[corners_[i][0]] - candidates_[k].centre).norm();
        least_[i] = std::min(least_[i], static_cast<float>(d + candidates_[k].signed_distance));
      }
      if (least_[i] > least_[next]) next = i;
    }
    start = next;
  }
  const std::size_t step = (points_.size() + kSamplesMax - 1) / kSamplesMax;
  samples_ = (points_.size() + step - 1) / step;
  asked_.clear();
  for (const FittedBall& candidate : candidates_) {
    for (std::size_t i = 0; i < points_.size(); i += step) {
      const double d = (points_[i] - candidate.centre).norm();
      asked_.push_back(static_cast<float>(d + candidate.signed_distance));
    }
  }
}

/// Greedily; returns how many samples are left.
std::size_t CoverSearch::CoverWithin(float overshoot, std::uint32_t count,
                                     std::vector<std::uint32_t>* chosen) {
  const std::size_t words = (samples_ + 63) / 64;
  bits_.resize(candidates_.size() * words);
  for (std::size_t k = 0; k < candidates_.size(); ++k) {
    for (std::size_t w = 0; w < words; ++w) {
      const float* const asked = asked_.data() + k * samples_ + 64 * w;
      const std::size_t count_here = std::min<std::size_t>(64, samples_ - 64 * w);
      std::uint64_t word = 0;
      for (std::size_t i = 0; i < count_here; ++i) {
        word |= std::uint64_t{asked[i] <= overshoot} << i;
      }
      bits_[k * words + w] = word;
    }
  }
  open_.assign(words, ~std::uint64_t{0});
  if (samples_ % 64 != 0) open_.back() = (std::uint64_t{1} << (samples_ % 64)) - 1;
  covers_max_.assign(candidates_.size(), samples_);
  std::size_t left = samples_;
  chosen->clear();
  while (left > 0 && chosen->size() < count) {
    const std::uint32_t best = WidestCover(words);
    const std::size_t most = covers_max_[best];
    // Neither do the next ones cover more than this.
    if (most * (count - chosen->size()) < left) break;
    chosen->push_back(best);
    left -= most;
    for (std::size_t w = 0; w < words; ++w) open_[w] &= ~bits_[best * words + w];
  }
  return left;
}

/// The candidate that covers most of what is open, of equal ones the first. What each covers only
/// becomes less: those that covered less than the best does now need not be counted again.
std::uint32_t CoverSearch::WidestCover(std::size_t words) {
  const auto count = [&](std::uint32_t k) {
    std::uint32_t covers = 0;
    for (std::size_t w = 0; w < words; ++w) {
      covers += static_cast<std::uint32_t>(std::popcount(bits_[k * words + w] & open_[w]));
    }
    covers_max_[k] = covers;
  };
  const auto widest = std::max_element(covers_max_.begin(), covers_max_.end());
  auto best = static_cast<std::uint32_t>(widest - covers_max_.begin());
  count(best);
  for (std::uint32_t k = 0; k < candidates_.size(); ++k) {
    const auto is_better = [&] {
      return covers_max_[k] > covers_max_[best] ||
             (covers_max_[k] == covers_max_[best] && k < best);
    };
    if (!is_better()) continue;
    count(k);
    if (is_better()) best = k;
  }
  return best;
}

std::vector<FittedBall> CoverSearch::Choose(std::uint32_t count) {
  float low = 0, high = std::numeric_limits<float>::infinity();
  for (std::size_t k = 0; k < candidates_.size(); ++k) {
    const auto row = asked_.begin() + k * samples_;
    high = std::min(high, *std::max_element(row, row + samples_));
  }
  std::vector<std::uint32_t> chosen, trial;
  CoverWithin(high, count, &chosen);
  for (int i = 0; i < kBisections; ++i) {
    const float middle = 0.5f * (low + high);
    if (CoverWithin(middle, count, &trial) == 0) {
      std::swap(chosen, trial);
      high = middle;
    } else {
      low = middle;
    }
  }
  std::vector<FittedBall> balls;
  for (const std::uint32_t k : chosen) balls.push_back(candidates_[k]);
  return balls;
}

double CoverSearch::FarthestOf(std::uint32_t piece, const Vector3d& centre) const {
  double square = 0;
  for (const std::uint32_t c : corners_[piece])
    square = std::max(square, (points_[c] - centre).squaredNorm());
  return std::sqrt(square);
}

void CoverSearch::Assign(FittedCover* cover) const {
  cover->ball_of.assign(corners_.size(), 0);
  for (std::uint32_t i = 0; i < corners_.size(); ++i) {
    double least = kInfinite;
    for (std::uint32_t k = 0; k < cover->balls.size(); ++k) {
      const FittedBall& ball = cover->balls[k];
      const double asked = FarthestOf(i, ball.centre) + ball.signed_distance;
      if (asked < least) least = asked, cover->ball_of[i] = k;
    }
  }
}

/// Fits each ball to its pieces; balls without a piece go.
void CoverSearch::Fit(int queries, FittedCover* cover) {
  std::vector<std::uint32_t> number(cover->balls.size());
  std::uint32_t kept = 0;
  for (std::uint32_t k = 0; k < cover->balls.size(); ++k) {
    if (!FitOne(k, queries, cover)) continue;
    cover->balls[kept] = cover->balls[k];
    number[k] = kept++;
  }
  cover->balls.resize(kept);
  for (std::uint32_t& k : cover->ball_of) k = number[k];
}

/// The farthest piece of a ball goes to another that holds it anyway, as long as there is one.
void CoverSearch::Release(FittedCover* cover) const {
  std::vector<std::pair<double, std::uint32_t>> own;
  auto& balls = cover->balls;
  for (std::uint32_t k = 0; k < balls.size(); ++k) {
    own.clear();
    for (std::uint32_t i = 0; i < corners_.size(); ++i) {
      if (cover->ball_of[i] == k) own.push_back({FarthestOf(i, balls[k].centre), i});
    }
    std::sort(own.begin(), own.end());
    for (; !own.empty(); own.pop_back()) {
      const std::uint32_t piece = own.back().second;
      std::uint32_t to = k;
      for (std::uint32_t j = 0; j < balls.size() && to == k; ++j) {
        if (j != k && FarthestOf(piece, balls[j].centre) <= balls[j].radius) to = j;
      }
      if (to == k) break;
      cover->ball_of[piece] = to;
    }
    balls[k].radius = own.empty() ? 0 : own.back().first;
  }
}

/// Cuts the ball in two whose halves promise most, until there are `count`.
void CoverSearch::Refill(std::uint32_t count, FittedCover* cover) {
  auto& balls = cover->balls;
  // In a large part a ball of few pieces may still be a ball about much.
  const std::size_t enough = corners_.size() > count * leaf_pieces_ ? 1 : leaf_pieces_;
  while (balls.size() < count) {
    std::vector<std::uint32_t> pieces(balls.size(), 0);
    for (const std::uint32_t k : cover->ball_of) ++pieces[k];
    std::uint32_t worst = 0;
    double most = -kInfinite;
    for (std::uint32_t k = 0; k < balls.size(); ++k) {
      if (pieces[k] > enough && balls[k].overshoot() > most) most = balls[k].overshoot(), worst = k;
    }
    if (most == -kInfinite) return;
    SplitBall(worst, cover);
  }
}

/// Each piece to the nearer of two that are far apart.
void CoverSearch::SplitBall(std::uint32_t ball, FittedCover* cover) {
  const auto point_of = [this](std::uint32_t piece) { return points_[corners_[piece][0]]; };
  Vector3d ends[2] = {cover->balls[ball].centre, cover->balls[ball].centre};
  for (int turn = 0; turn < 3; ++turn) {
    double most = -1;
    const Vector3d from = ends[1];
    for (std::uint32_t i = 0; i < corners_.size(); ++i) {
      if (cover->ball_of[i] != ball) continue;
      const double d = (point_of(i) - from).squaredNorm();
      if (d > most) most = d, ends[1] = point_of(i);
    }
    ends[0] = from;
  }
  ball_points_.clear();
  const auto other = static_cast<std::uint32_t>(cover->balls.size());
  cover->balls.push_back(cover->balls[ball]);
  bool odd = false;
  for (std::uint32_t i = 0; i < corners_.size(); ++i) {
    if (cover->ball_of[i] != ball) continue;
    const double first = (point_of(i) - ends[0]).squaredNorm(),
                 second = (point_of(i) - ends[1]).squaredNorm();
    odd = !odd;
    if (second < first || (second == first && odd)) cover->ball_of[i] = other;
  }
  FitOne(ball, kQueries, cover);
  FitOne(other, kQueries, cover);
}

/// Fits one ball to its pieces, if it has any.
bool CoverSearch::FitOne(std::uint32_t ball, int queries, FittedCover* cover) {
  ball_points_.clear();
  taken_.assign(points_.size(), 0);
  for (std::uint32_t i = 0; i < corners_.size(); ++i) {
    if (cover->ball_of[i] != ball) continue;
    for (const std::uint32_t c : corners_[i]) {
      if (!taken_[c]) ball_points_.push_back(points_[c]);
      taken_[c] = 1;
    }
  }
  if (ball_points_.empty()) return false;
  polish_.Run(ball_points_, queries, &cover->balls[ball]);
  return true;
}

FittedBall CoverSearch::FindOne(std::span<const std::uint32_t> part) {
  Gather(part);
  FindCandidates(part);
  FittedBall ball = Choose(1)[0];
  polish_.Run(points_, 4 * kQueries, &ball);
  return ball;
}

FittedCover CoverSearch::Find(std::span<const std::uint32_t> part, std::uint32_t count,
                              std::uint32_t starts) {
  Gather(part);
  FindCandidates(part);
  FittedCover best;
  double least = kInfinite;
  // From fewer balls, which are then cut in two where that promises most, it goes another way.
  for (std::uint32_t start = 0; start < starts; ++start)
    ImproveFrom(Choose(count - start), count, &least, &best);
  return best;
}

void CoverSearch::ImproveFrom(std::vector<FittedBall> balls, std::uint32_t count, double* least,
                              FittedCover* best) {
  FittedCover cover;
  cover.balls = std::move(balls);
  for (int turn = 0; turn < (corners_.size() > kFew ? kTurns : kTurnsOfFew); ++turn) {
    Assign(&cover);
    Fit(kQueries, &cover);
    Assign(&cover);
    Fit(0, &cover);
    Release(&cover);
    Fit(kQueries, &cover);
    Refill(count, &cover);
    double sum = 0;
    for (const FittedBall& ball : cover.balls) sum += ball.overshoot();
    if (sum < *least) *least = sum, *best = cover;
  }
}

FittedBall CoverSearch::FitTo(std::span<const std::uint32_t> part, FittedBall start) {
  Gather(part);
  polish_.Run(points_, kQueries, &start);
  return start;
}

}  // namespace collision::sphere_tree
