// The libraries, each behind the same few functions: those that were found when this was built.
//
// Each query has two lists: `...Peers` asks every library as a careful user would, for
// the contest; `...PeerCurves` asks it over all its settings, for error against time.
//
// The files of the libraries are compiled with other options of Eigen than ours. So this header and
// all that it includes hold plain numbers only, and none of the core's types.
#pragma once

#include <optional>

#include "tests/bench/pairs/contact_method.h"
#include "tests/bench/pairs/method.h"
#include "tests/bench/pairs/plain_convex.h"

namespace collision::bench {

/// Two bodies of one mesh, of which each library builds what it needs.
PairMethods MeshPeers(const PlainMesh& mesh);
PairMethods MeshPeerCurves(const PlainMesh& mesh);

/// Two convex solids: each library uses its own routine for their kinds.
PairMethods ConvexPeers(const PlainConvex& a, const PlainConvex& b);
PairMethods ConvexPeerCurves(const PlainConvex& a, const PlainConvex& b);

/// When two moving bodies begin to touch.
ContactMethods ContactPeers();
ContactMethods ContactPeerCurves();

/// Building FCL's tree of OBBRSS volumes, processor time, least of three [s]; nullopt: no FCL.
std::optional<double> FclBuildSeconds(const PlainMesh& mesh);

// One library each. peers.cc calls those that exist in this build.
PairMethods FclMesh(const PlainMesh& mesh);
PairMethods FclMeshCurves(const PlainMesh& mesh);
PairMethods FclConvex(const PlainConvex& a, const PlainConvex& b);
PairMethods FclConvexCurves(const PlainConvex& a, const PlainConvex& b);
ContactMethods FclContact();
ContactMethods FclContactCurves();
double FclBuildTime(const PlainMesh& mesh);
PairMethods BulletMesh(const PlainMesh& mesh);
PairMethods BulletMeshCurves(const PlainMesh& mesh);
PairMethods BulletConvex(const PlainConvex& a, const PlainConvex& b);
PairMethods BulletConvexCurves(const PlainConvex& a, const PlainConvex& b);
ContactMethods BulletContact();
ContactMethods BulletContactCurves();
PairMethods OdeMesh(const PlainMesh& mesh);
PairMethods CgalMesh(const PlainMesh& mesh);
PairMethods BspMesh(const PlainMesh& mesh);

}  // namespace collision::bench
