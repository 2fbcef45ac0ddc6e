// How the balls of a cover become one, pair by pair.
#include <algorithm>

#include "collision_core/sphere_tree/fitted/fitted_cover.h"

namespace collision::sphere_tree {
namespace {

using Eigen::Vector3d;

constexpr int kQueries = 20;

/// A group with its points.
struct Cluster {
  FittedGroup group;
  std::vector<Vector3d> points;
};

/// The better of two balls for both their points, as they are.
FittedBall BetterOf(const Cluster& a, const Cluster& b) {
  FittedBall of_a = a.group.ball, of_b = b.group.ball;
  of_a.radius = std::max(of_a.radius, FarthestFrom(of_a.centre, b.points).distance);
  of_b.radius = std::max(of_b.radius, FarthestFrom(of_b.centre, a.points).distance);
  return of_b.overshoot() < of_a.overshoot() ? of_b : of_a;
}

}  // namespace

std::vector<FittedGroup> CoverSearch::Merge(const FittedCover& cover, std::size_t count) {
  std::vector<Cluster> clusters(cover.balls.size());
  for (std::uint32_t k = 0; k < clusters.size(); ++k) clusters[k].group = {cover.balls[k], {k}};
  for (std::uint32_t i = 0; i < corners_.size(); ++i) {
    auto& points = clusters[cover.ball_of[i]].points;
    for (const std::uint32_t c : corners_[i]) points.push_back(points_[c]);
  }
  while (clusters.size() > count) {
    std::size_t first = 0, second = 1;
    FittedBall best = BetterOf(clusters[0], clusters[1]);
    for (std::size_t j = 2; j < clusters.size(); ++j) {
      for (std::size_t i = 0; i < j; ++i) {
        const FittedBall ball = BetterOf(clusters[i], clusters[j]);
        if (ball.overshoot() < best.overshoot()) best = ball, first = i, second = j;
      }
    }
    Cluster &into = clusters[first], &from = clusters[second];
    into.points.insert(into.points.end(), from.points.begin(), from.points.end());
    polish_.Run(into.points, kQueries, &best);
    into.group.ball = best;
    auto& members = into.group.members;
    members.insert(members.end(), from.group.members.begin(), from.group.members.end());
    clusters.erase(clusters.begin() + static_cast<std::ptrdiff_t>(second));
  }
  std::vector<FittedGroup> groups;
  for (Cluster& cluster : clusters) groups.push_back(std::move(cluster.group));
  return groups;
}

}  // namespace collision::sphere_tree
