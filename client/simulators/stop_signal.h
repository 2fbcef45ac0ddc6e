// Ending on SIGTERM and SIGINT.
#pragma once

namespace collision::client {

/// From now on SIGTERM and SIGINT only set a flag.
void CatchStopSignals();

bool StopRequested();

}  // namespace collision::client
