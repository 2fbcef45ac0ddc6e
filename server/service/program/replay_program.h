// What collisiond does with --replay.
#pragma once

#include "server/service/program/options.h"

namespace collision::server {

/// Replays each start of the service, one after the other, and prints what it told. Returns the
/// code of the first failure.
int RunReplay(const Options& options);

}  // namespace collision::server
