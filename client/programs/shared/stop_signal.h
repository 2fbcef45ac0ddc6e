// Ending on SIGTERM and SIGINT.
#pragma once

namespace collision::client {

/// From now on SIGTERM and SIGINT only set the flag that StopRequested() returns.
void CatchStopSignals();

bool StopRequested();

}  // namespace collision::client
