// What a contestant of the narrow phase is asked, and what it answers.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace collision::bench {

/// The caller's triangles, as plain numbers: the libraries have types of their own.
struct PlainMesh {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// B's body frame seen from A's, which is the world's: x_A = rotation x_B + offset. Rows first.
struct PlainPose {
  std::array<std::array<double, 3>, 3> rotation;
  std::array<double, 3> offset;
};

enum class Task {
  kDecision,  ///< Yes (1), no (0), or not decided: [0, 1].
  kDistance,  ///< [m], to 1e-6 of it.
  kBracket    ///< The distance, to 1 % of the diameter.
};
const char* Name(Task task);

/// Libraries answer one number: both ends are the same.
struct Reply {
  double lower = 0;
  double upper = 0;

  double middle() const { return 0.5 * (lower + upper); }
};
inline Reply Plain(double value) { return {value, value}; }

enum class Who {
  kOurs,     ///< What the service uses.
  kOther,    ///< Another way of ours: shown, in no figure.
  kLibrary,  ///< The best one counts in the figures.
  kBaseline  ///< What the paper did: shown, in no figure.
};

struct NarrowQuery {
  std::string contestant;
  Task task;
  Who who;
  std::function<Reply(const PlainPose&)> ask;  ///< Keeps what it needs.
};

using NarrowQueries = std::vector<NarrowQuery>;

/// Each builds its own of the mesh and asks two bodies of it. Those that were not found when this
/// was built answer nothing.
NarrowQueries FclQueries(const PlainMesh& mesh);
NarrowQueries BulletQueries(const PlainMesh& mesh);
NarrowQueries OdeQueries(const PlainMesh& mesh);
NarrowQueries CgalQueries(const PlainMesh& mesh);
NarrowQueries BspQueries(const PlainMesh& mesh);
NarrowQueries PeerQueries(const PlainMesh& mesh);

/// GImpact, whose triangles have a margin [m]. Only where Bullet was found.
std::function<Reply(const PlainPose&)> GImpactDecision(const PlainMesh& mesh, double margin);

/// Building FCL's tree of OBBRSS volumes, processor's time, least of three [s]; nullopt: no FCL.
std::optional<double> FclBuildSeconds(const PlainMesh& mesh);
double FclBuildTime(const PlainMesh& mesh);

}  // namespace collision::bench
