// What a simulator's user should know: that something stands in the way, in one sentence.
#pragma once

#include <string>

#include "collision/export.h"

namespace collision::client {

enum class NoticeKind {
  kNoService,   ///< No service of the world is heard, since 3 s.
  kWrongClock,  ///< The simulator runs in lock-step and the world in real time, or vice versa.
  kWaiting,     ///< Lock-step: a step is not granted, since 3 s; for whom time waits.
  kRefused,    ///< The service refuses what the simulator sent: the first of each reason and field.
  kNameTaken,  ///< Another living program has the simulator's name.
  kEnded,      ///< An operator has ended the run.
  kBreach,     ///< The simulator broke what it declared: its agent, or its clock.
  kCredentials,  ///< Its credentials end before long, or have ended: nobody hears it any more.
};

/// "no service", "wrong clock", ...
COLLISION_API const char* Name(NoticeKind kind);

/// What the library tells when something stands in the simulator's way, and when it no longer does.
struct Notice {
  NoticeKind kind = NoticeKind::kNoService;
  bool over = false;  ///< What was told before is the case no longer.
  std::string text;   ///< One sentence, without the simulator's name and without a newline.
};

}  // namespace collision::client
