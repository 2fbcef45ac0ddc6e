#include "tests/bench/pairs/peers.h"

namespace collision::bench {

PairMethods MeshPeers(const PlainMesh& mesh) {
  PairMethods methods;
#ifdef COLLISION_HAS_FCL
  Append(FclMesh(mesh), &methods);
#endif
#ifdef COLLISION_HAS_BULLET
  Append(BulletMesh(mesh), &methods);
#endif
#ifdef COLLISION_HAS_ODE
  Append(OdeMesh(mesh), &methods);
#endif
#ifdef COLLISION_HAS_CGAL
  Append(CgalMesh(mesh), &methods);
#endif
  Append(BspMesh(mesh), &methods);
  return methods;
}

PairMethods MeshPeerCurves(const PlainMesh& mesh) {
  PairMethods methods;
#ifdef COLLISION_HAS_FCL
  Append(FclMeshCurves(mesh), &methods);
#endif
#ifdef COLLISION_HAS_BULLET
  Append(BulletMeshCurves(mesh), &methods);
#endif
  for (PairMethod& method : MeshPeers(mesh)) {
    // Decisions have no other setting, except the margins of GImpact, which are there already.
    const bool is_new = method.task == Task::kDecision && method.name != "Bullet GImpact";
    if (is_new) methods.push_back(std::move(method));
  }
  return methods;
}

PairMethods ConvexPeers([[maybe_unused]] const PlainConvex& a,
                        [[maybe_unused]] const PlainConvex& b) {
  PairMethods methods;
#ifdef COLLISION_HAS_FCL
  Append(FclConvex(a, b), &methods);
#endif
#ifdef COLLISION_HAS_BULLET
  Append(BulletConvex(a, b), &methods);
#endif
  return methods;
}

PairMethods ConvexPeerCurves([[maybe_unused]] const PlainConvex& a,
                             [[maybe_unused]] const PlainConvex& b) {
  PairMethods methods;
#ifdef COLLISION_HAS_FCL
  Append(FclConvexCurves(a, b), &methods);
#endif
#ifdef COLLISION_HAS_BULLET
  Append(BulletConvexCurves(a, b), &methods);
#endif
  return methods;
}

ContactMethods ContactPeers() {
  ContactMethods methods;
#ifdef COLLISION_HAS_FCL
  Append(FclContact(), &methods);
#endif
#ifdef COLLISION_HAS_BULLET
  Append(BulletContact(), &methods);
#endif
  return methods;
}

ContactMethods ContactPeerCurves() {
  ContactMethods methods;
#ifdef COLLISION_HAS_FCL
  Append(FclContactCurves(), &methods);
#endif
#ifdef COLLISION_HAS_BULLET
  Append(BulletContactCurves(), &methods);
#endif
  return methods;
}

std::optional<double> FclBuildSeconds([[maybe_unused]] const PlainMesh& mesh) {
#ifdef COLLISION_HAS_FCL
  return FclBuildTime(mesh);
#else
  return std::nullopt;
#endif
}

}  // namespace collision::bench
