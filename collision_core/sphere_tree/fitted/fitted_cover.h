// A part of a surface shared out among a few balls.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "collision_core/sphere_tree/fitted/fitted_ball.h"
#include "collision_core/sphere_tree/fitted/fitted_pieces.h"

namespace collision::sphere_tree {

/// Balls, and which of them each piece of the part belongs to.
struct FittedCover {
  std::vector<FittedBall> balls;
  std::vector<std::uint32_t> ball_of;
};

/// Some balls of a cover, and one ball about all their pieces.
struct FittedGroup {
  FittedBall ball;
  std::vector<std::uint32_t> members;
};

/// Searches covers of few balls that overshoot little: the overshoot that a ball at c needs to
/// contain a point x is |x − c| + s(c), so the best centres are those of a k-centre problem with
/// that cost. A greedy cover by candidates, found by bisecting the overshoot, is improved by two
/// alternating steps: each piece goes to the ball that needs the least overshoot to contain it, and
/// each centre to the place from which its pieces need the least.
class CoverSearch {
 public:
  /// `leaf_pieces`: a ball with at most this many pieces need not be split.
  CoverSearch(const TriangleBoxTree& boxes, const FittedPieces& pieces, SurfaceKind kind,
              std::uint32_t leaf_pieces)
      : boxes_(boxes), pieces_(pieces), kind_(kind), leaf_pieces_(leaf_pieces), polish_(boxes) {}

  /// At most `count` balls, each with a piece: the best of `starts` searches; 1 <= starts < count.
  FittedCover Find(std::span<const std::uint32_t> part, std::uint32_t count, std::uint32_t starts);

  /// One ball around everything.
  FittedBall FindOne(std::span<const std::uint32_t> part);

  /// One ball around everything, fitted from the ball `start`.
  FittedBall FitTo(std::span<const std::uint32_t> part, FittedBall start);

  /// Merges the balls of the cover found last into `count` groups, or leaves one group a ball if
  /// there are fewer. Greedy: each step merges the two groups whose common ball has the least
  /// estimated overshoot.
  std::vector<FittedGroup> Merge(const FittedCover& cover, std::size_t count);

 private:
  using Points = std::vector<Eigen::Vector3d>;

  void Gather(std::span<const std::uint32_t> part);
  void FindCandidates(std::span<const std::uint32_t> part);
  void AddCandidatesOf(std::uint32_t index, std::uint32_t piece);
  std::vector<FittedBall> Choose(std::uint32_t count);
  void ImproveFrom(std::vector<FittedBall> balls, std::uint32_t count, double* least,
                   FittedCover* best);
  std::size_t CoverWithin(float overshoot, std::uint32_t count, std::vector<std::uint32_t>* chosen);
  std::uint32_t WidestCover(std::size_t words);
  void Assign(FittedCover* cover) const;
  void Release(FittedCover* cover) const;
  void Fit(int queries, FittedCover* cover);
  bool FitOne(std::uint32_t ball, int queries, FittedCover* cover);
  void Refill(std::uint32_t count, FittedCover* cover);
  void SplitBall(std::uint32_t ball, FittedCover* cover);
  double FarthestOf(std::uint32_t piece, const Eigen::Vector3d& centre) const;

  const TriangleBoxTree& boxes_;
  const FittedPieces& pieces_;
  const SurfaceKind kind_;
  const std::uint32_t leaf_pieces_;
  BallPolish polish_;

  /// For every piece, where its candidates found so far stand in `known_`.
  struct Known {
    std::uint32_t first = 0, count = 0;
  };
  std::vector<Known> known_of_;
  std::vector<FittedBall> known_;

  /// For each point: the last part that contained it, and its index in points_.
  std::vector<std::uint32_t> stamp_of_, local_of_;
  std::uint32_t stamp_ = 0;
  Points points_;                                      ///< Of the part, each once.
  std::vector<std::array<std::uint32_t, 3>> corners_;  ///< Of the part's pieces, in points_.
  std::vector<FittedBall> candidates_;
  std::size_t samples_ = 0;
  std::vector<float> asked_;         ///< The overshoot that each candidate needs for each sample.
  std::vector<std::uint64_t> bits_;  ///< For each candidate by each sample: within reach?
  std::vector<std::uint64_t> open_;  ///< For each sample: not covered yet.
  std::vector<std::size_t> covers_max_;  ///< For each candidate: it covers no more of them.
  Points ball_points_;
  std::vector<char> taken_;
  std::vector<float> least_;
};

}  // namespace collision::sphere_tree
