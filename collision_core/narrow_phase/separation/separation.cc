#include "collision_core/narrow_phase/separation/separation.h"

#include "collision_core/narrow_phase/convex_pair/convex_pair_query.h"
#include "collision_core/narrow_phase/separation/containment.h"
#include "collision_core/narrow_phase/separation/hull_gap.h"
#include "collision_core/narrow_phase/separation/separation_search.h"

namespace collision::narrow_phase {
namespace {

void RecheckLeaves(const BodyTree& a, const BodyTree& b, NodePair leaves,
                   SeparationFindings* findings, WorkBudget* work) {
  if (!a.shape() || !b.shape()) {
    const BodyTree& meshed = a.shape() ? a : b;
    const sphere_tree::SphereNode& leaf = meshed.node(a.shape() ? leaves.a : leaves.b);
    for (const ElementIndex t : meshed.shape()->tree().ElementsOf(leaf)) {
      if (work->exhausted()) return;
      findings->MeasureBallAgainst(t, work);
    }
    return;
  }
  for (const ElementIndex t : a.shape()->tree().ElementsOf(a.node(leaves.a))) {
    for (const ElementIndex u : b.shape()->tree().ElementsOf(b.node(leaves.b))) {
      if (work->exhausted()) return;
      findings->RecheckElements({t, u}, work);
    }
  }
}

// Beyond this distance [m] squares might overflow; SeparationSearch handles it.
constexpr double kSeenAtOnceMax = 1e100;

// If the balls around the whole bodies are apart, so are the bodies, their insides included.
bool RootsDecide(const PosedPair& pair, SeparationBracket* bracket) {
  const auto& [a, b, pose] = pair;
  const sphere_tree::SphereNode& root_a = a.root();
  const sphere_tree::SphereNode& root_b = b.root();
  const double distance = (pose.ToA(root_b.centre) - root_a.centre).norm();
  if (!(distance < kSeenAtOnceMax)) return false;
  double slack = SlackOf(pair);
  if (pose.chord_A > 0) slack += pose.chord_A * root_a.centre.norm();
  if (pose.chord_B > 0) slack += pose.chord_B * root_b.centre.norm();
  bracket->lower = distance - root_a.radius - root_b.radius - slack;
  bracket->upper = distance + root_a.signed_distance + root_b.signed_distance + slack;
  return bracket->CertainlyApart(pose.translation);
}

/// A body that is one convex solid; else null.
const geometry::ConvexSet* LoneSolid(const BodyTree& surface) {
  const shape::Shape* shape = surface.shape();
  const bool lone = shape && shape->solids().size() == 1 && shape->mesh().triangles.empty();
  return lone ? &shape->solids()[0].set() : nullptr;
}

Decision DecideLone(const geometry::ConvexSet& a, const geometry::ConvexSet& b,
                    const RelativePose& pose, WorkBudget* work) {
  Decision decision;
  decision.verdict = DecideConvexPair(a, b, pose, work);
  if (decision.verdict == Verdict::kApart) decision.bracket.lower = pose.translation;
  if (decision.verdict == Verdict::kTouching) decision.bracket.upper = -pose.translation;
  return decision;
}

}  // namespace

SeparationBracket QuerySeparation(const PosedPair& pair, Goal goal, WorkBudget* work,
                                  const ContactWitness& hint) {
  SeparationSearch search(pair, goal);
  search.Start(work);
  if (hint.kind == ContactWitness::Kind::kLeaves) search.TryLeaves(hint.nodes, work);
  search.Refine(work);
  return search.Result();
}

SeparationBracket BracketSeparation(const PosedPair& pair, const BracketTolerance& tolerance,
                                    WorkBudget* work) {
  SeparationSearch search(pair, Goal::kDecision, tolerance);
  search.Start(work);
  search.Refine(work);
  return search.Result();
}

SeparationBracket RecheckWitness(const PosedPair& pair, const ContactWitness& witness,
                                 WorkBudget* work) {
  SeparationFindings findings(pair, Goal::kDecision, {});
  const BodyTree &a = pair.a, &b = pair.b;
  const bool meshes = a.shape() && b.shape();
  switch (witness.kind) {
    case ContactWitness::Kind::kNone:
      break;
    case ContactWitness::Kind::kNodes:
      work->Spend(1);
      findings.MeasureNodes(witness.nodes);
      break;
    case ContactWitness::Kind::kElements:
      if (meshes) {
        findings.RecheckElements(witness.elements, work);
      } else {
        findings.MeasureBallAgainst(witness.elements.a, work);
      }
      break;
    case ContactWitness::Kind::kLeaves:
      RecheckLeaves(a, b, witness.nodes, &findings, work);
  }
  return findings.Result({});
}

Decision DecideAt(const PosedPair& pair, WorkBudget* work) {
  const auto& [a, b, pose] = pair;
  const geometry::ConvexSet *lone_a = LoneSolid(a), *lone_b = LoneSolid(b);
  if (lone_a && lone_b) return DecideLone(*lone_a, *lone_b, pose, work);
  Decision decision;
  if (RootsDecide(pair, &decision.bracket)) {
    work->Spend(1);
    decision.verdict = Verdict::kApart;
    return decision;
  }
  // If the convex bodies around them are apart, so are the bodies, their insides included.
  const double gap = HullGapOf(pair, pose.translation, work);
  if (gap > pose.translation) {
    decision.bracket.lower = std::max(decision.bracket.lower, gap);
    decision.verdict = Verdict::kApart;
    return decision;
  }
  SeparationSearch search(pair, Goal::kYesNo);
  search.Start(work);
  search.Refine(work);
  decision.bracket = search.Result();
  const SeparationBracket& bracket = decision.bracket;
  if (bracket.CertainlyTouching(pose.translation)) {
    decision.verdict = Verdict::kTouching;
  } else if (bracket.CertainlyApart(pose.translation)) {
    const Containment nesting = TestContainment(pair, work);
    if (nesting.neither) decision.verdict = Verdict::kApart;
    if (nesting.certain()) decision.verdict = Verdict::kTouching;
    if (decision.verdict == Verdict::kUndecided) decision.bracket.exhausted |= work->exhausted();
  }
  return decision;
}

}  // namespace collision::narrow_phase
