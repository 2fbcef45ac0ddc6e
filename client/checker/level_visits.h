// Which crossings of a level with hysteresis belong together.
//
// Two agents that hover about a margin cross it again and again. A visit lasts as long as the pair
// stays within margin + hysteresis: of its crossings the first is told, and the others are held
// back.
#pragma once

#include <vector>

#include "client/checker/motion/true_contact.h"

namespace collision::checker {

/// Numbers the visits of each pair, from 1, in its crossings of the margin. `wide`: the spans in
/// which pairs are within margin + hysteresis. Both in order of begin.
///  - `visit` counts every time that a pair was beyond, however short. A visit in which that may
///    have stayed unseen (TrueContact::blind) has no two crossings of one number.
///  - `long_visit` counts the times that were longer than `apart_min_ns`: the service need not
///    notice the others.
void NumberVisits(const std::vector<TrueContact>& wide, long double apart_min_ns,
                  std::vector<TrueContact>* crossings);

}  // namespace collision::checker
