// Measures how fast the narrow phase is on this machine.
#pragma once

namespace collision::server {

/// Work units per microsecond of processor time: the median of many short measurements on two fixed
/// meshes at fixed poses, apart, near and overlapping, each within a budget as the service gives
/// it. Takes about a second.
double MeasureWorkUnitsPerUs();

}  // namespace collision::server
