// The rules by which the checker judges a run.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "client/checker/evidence.h"

namespace collision::checker {

/// One sentence per violation, with the pair or agent, the times and the broken rule; empty: the
/// run satisfies the checker.
using Violations = std::vector<std::string>;

/// Once a rule has found this many violations it is judged no further: samples repeat them.
inline constexpr std::size_t kRepeatsMax = 20;

/// Every true contact has an event that brackets its begin, and the pair was announced by then; an
/// ended event brackets its end; no confirmed event lacks a true contact. Excused are contacts that
/// begin after evidence.judged_until_ns(), contacts withdrawn as an agent leaves, and contacts that
/// an appearance or jump causes inside time already granted.
Violations CheckEvents(const Evidence& evidence);

/// What an event says about the bodies at one instant holds there: the separation bracket contains
/// the true distance, the depth does not exceed the true one, the point is as near to both as its
/// error says, the normal is a unit vector. The closest approach of a dismissed or ended event is
/// that of the true motions. (geometry_check.cc)
Violations CheckGeometry(const Evidence& evidence);

/// The same of each configured level, whose crossings are contacts of agents grown by half of its
/// margin: all are told, those that hysteresis may hold back excepted, and announced, unless it
/// tells only what is expected; at the ends of their brackets the bodies are within the margin, or
/// not, as these say; and none is told again that hysteresis holds back. (level_check.cc)
Violations CheckLevels(const Evidence& evidence);

/// No true contact of an agent begins before a clear_until published earlier, unless the pair was
/// announced by then, or one of the two appeared or jumped since. And no promise is declared void,
/// since these simulators break no bound.
Violations CheckClearances(const Evidence& evidence);

/// No pair that is apart touches before a published earliest intersection, with the same excuse.
Violations CheckEarliest(const Evidence& evidence);

/// What the scene demands in addition.
Violations CheckExpectation(const Evidence& evidence, const v1::SceneExpectation& expectation);

/// All of the six rules above.
Violations Check(const Evidence& evidence, const v1::SceneExpectation& expectation);

/// True contacts that were required but had no event by the time they began.
std::uint64_t ContactsUnannounced(const Evidence& evidence);

/// (clear_until - now) / (true time to contact), at most 1, for every clearance with a true contact
/// of its agent ahead that no later change has caused.
std::vector<double> ClearanceTightness(const Evidence& evidence);

/// How a true contact was announced, by the first revision of the event that brackets its begin.
struct Announcement {
  double lead_s = 0;     ///< From the announcement to the true begin.
  double tightness = 0;  ///< (begin.earliest - now) / (true begin - now).
};

/// Of every certain contact that was announced before it began, and that no later change has
/// caused.
std::vector<Announcement> Announcements(const Evidence& evidence);

}  // namespace collision::checker
