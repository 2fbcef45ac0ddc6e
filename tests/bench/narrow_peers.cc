#include "tests/bench/narrow_contact_case.h"
#include "tests/bench/narrow_convex.h"
#include "tests/bench/narrow_query.h"

namespace collision::bench {
namespace {

void Append(NarrowQueries some, NarrowQueries* all) {
  for (NarrowQuery& query : some) all->push_back(std::move(query));
}

}  // namespace

const char* Name(Task task) {
  switch (task) {
    case Task::kDecision:
      return "decision";
    case Task::kDistance:
      return "distance";
    case Task::kBracket:
      return "bracket";
  }
  return "";
}

NarrowQueries PeerQueries(const PlainMesh& mesh) {
  NarrowQueries queries;
#ifdef COLLISION_HAS_FCL
  Append(FclQueries(mesh), &queries);
#endif
#ifdef COLLISION_HAS_BULLET
  Append(BulletQueries(mesh), &queries);
#endif
#ifdef COLLISION_HAS_ODE
  Append(OdeQueries(mesh), &queries);
#endif
#ifdef COLLISION_HAS_CGAL
  Append(CgalQueries(mesh), &queries);
#endif
  Append(BspQueries(mesh), &queries);
  return queries;
}

NarrowQueries ConvexPeerQueries([[maybe_unused]] const PlainConvex& a,
                                [[maybe_unused]] const PlainConvex& b) {
  NarrowQueries queries;
#ifdef COLLISION_HAS_FCL
  Append(FclConvexQueries(a, b), &queries);
#endif
#ifdef COLLISION_HAS_BULLET
  Append(BulletConvexQueries(a, b), &queries);
#endif
  return queries;
}

std::vector<ContactLibrary> ContactPeers() {
  std::vector<ContactLibrary> libraries;
#ifdef COLLISION_HAS_FCL
  for (ContactLibrary& library : FclContact()) libraries.push_back(std::move(library));
#endif
#ifdef COLLISION_HAS_BULLET
  for (ContactLibrary& library : BulletContact()) libraries.push_back(std::move(library));
#endif
  return libraries;
}

std::optional<double> FclBuildSeconds([[maybe_unused]] const PlainMesh& mesh) {
#ifdef COLLISION_HAS_FCL
  return FclBuildTime(mesh);
#else
  return std::nullopt;
#endif
}

}  // namespace collision::bench
