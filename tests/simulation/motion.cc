#include "tests/simulation/motion.h"

#include <cmath>

namespace collision::server {
Motion Straight(const Eigen::Vector3d& p, const Eigen::Vector3d& v, std::int64_t end_ns) {
  return {.pieces = {{.start_ns = 0, .end_ns = end_ns, .p = p, .v = v}}, .jumps_ns = {}};
}

Motion Wander(const WanderOptions& options, std::int64_t end_ns, Random* random) {
  const auto somewhere = [&options, random] {
    // One statement each: compilers evaluate arguments in different orders.
    const double h = options.half_side;
    const double z = random->Uniform(-h, h);
    const double y = random->Uniform(-h, h);
    const double x = random->Uniform(-h, h);
    return Eigen::Vector3d(x, y, z);
  };
  Motion motion;
  Piece piece{.p = somewhere(), .v = options.speed * 0.5 * random->UnitVector()};
  while (piece.start_ns < end_ns) {
    piece.end_ns =
        piece.start_ns + options.piece_min_ns +
        static_cast<std::int64_t>(random->Below(options.piece_max_ns - options.piece_min_ns + 1));
    Eigen::Vector3d wish = random->UnitVector() - piece.p / options.half_side;
    if (piece.v.dot(piece.v) > options.speed * options.speed) wish = -piece.v;
    const double length = std::sqrt(wish.dot(wish));
    piece.a = wish * (0.98 * options.acceleration_max * random->Uniform(0.2, 1) / (length + 1e-9));
    motion.pieces.push_back(piece);
    piece = piece.From(piece.end_ns);
    if (random->Chance(options.jumps_per_piece)) {
      piece.p = somewhere();
      motion.jumps_ns.push_back(piece.start_ns);
    }
  }
  return motion;
}

}  // namespace collision::server
