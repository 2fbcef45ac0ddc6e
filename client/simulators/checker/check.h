// The verdict on a run: was anything late, missing, wrong or false?
#pragma once

#include <string>
#include <vector>

#include "client/simulators/checker/evidence.h"

namespace collision::checker {

/// Every sentence names the pair or agent, the times and the rule that was broken; empty:
/// satisfied.
using Violations = std::vector<std::string>;

/// Every true contact has an event that brackets its begin, the pair announced by then; ended
/// events bracket its end; no confirmed event is without a true contact. Excused: what begins after
/// evidence.judged_until_ns(), what is withdrawn as an agent leaves, what an appearance or jump
/// brought about inside time already granted.
Violations CheckEvents(const Evidence& evidence);

/// What events say of the bodies at one instant holds there: the separation bracket contains the
/// true distance, the depth is not more than it can be, the point is as near to both as it says, the
/// normal is a direction. (geometry_check.cc)
Violations CheckGeometry(const Evidence& evidence);

/// No true contact of an agent begins before a clear_until published earlier, unless the pair was
/// announced by then, or one of the two appeared or jumped since. No promise is void: these
/// simulators break no bound.
Violations CheckClearances(const Evidence& evidence);

/// No pair that was not in contact touches before a published earliest intersection, with the same
/// excuse.
Violations CheckEarliest(const Evidence& evidence);

/// What the scene demands beyond.
Violations CheckExpectation(const Evidence& evidence, const v1::SceneExpectation& expectation);

/// All five.
Violations Check(const Evidence& evidence, const v1::SceneExpectation& expectation);

/// True contacts that were required but had no event by the time they began.
std::uint64_t ContactsUnannounced(const Evidence& evidence);

/// For every clearance with a true contact of its agent ahead, not brought about by a later change:
/// (clear_until - now) / (true time to contact), at most 1.
std::vector<double> ClearanceTightness(const Evidence& evidence);

}  // namespace collision::checker
