// Judges what was heard of a flight.
#pragma once

#include <string>

#include "tests/network/testbed.h"
#include "tests/support/suite/case.h"

namespace collision::network {

/// Each contact was told to the listener and to the monitor, once: it is confirmed, then narrowed,
/// then ended, and nothing of it is repeated; the checker, which knows the motions, finds every
/// true contact announced in time and bracketed, and every clearance kept; each program ended as it
/// should. `of` begins each sentence of a failure.
void ExpectTruth(const std::string& of, const Flown& flown, suite::Outcome* outcome);

/// Each program ended as it should.
void ExpectGoodEnds(const std::string& of, const Flown& flown, suite::Outcome* outcome);

/// No clearance that was published covers a true contact, and each program ended as it should:
/// what holds also where states were lost, so that contacts could not be decided.
void ExpectClearances(const std::string& of, const Flown& flown, suite::Outcome* outcome);

/// What was heard of the agents of one simulator among themselves.
Flown Only(const std::string& simulator, Flown flown);

/// The listener was told of the same contacts as in another flight of the same swarm.
void ExpectSameContacts(const std::string& of, const Flown& flown, const Flown& undisturbed,
                        suite::Outcome* outcome);

/// What the service found has the same bits as in another flight.
void ExpectSameEventLog(const std::string& of, const Flown& flown, const Flown& undisturbed,
                        suite::Outcome* outcome);

/// How many frames were delivered and lost, how many contacts were told.
void Report(const FrameCounts& frames, const Flown& flown, suite::Outcome* outcome);

}  // namespace collision::network
