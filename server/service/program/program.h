// What the program collisiond does with its command line.
#pragma once

#include "server/service/program/options.h"

namespace collision::server {

/// Does what the command line asks for, to its end. Returns the exit code, also after a failure
/// (EndOnFailure()). To be called once, from main, before any thread is made.
int RunProgram(const Options& options);

}  // namespace collision::server
