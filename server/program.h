// The daemon as a program.
#pragma once

#include "server/options.h"

namespace collision::server {

/// Does what the command line asks for, to its end. Returns the exit code. To be called once, from
/// main, before any thread is made.
int RunProgram(const Options& options);

}  // namespace collision::server
