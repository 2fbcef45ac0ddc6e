// Examples in the help of collisionctl.
#pragma once

#include <string>

namespace collision::client {

/// Of all commands, and what holds for all of them: exit codes, the network.
std::string AllExamples();

/// Of one command; empty: there are none here.
std::string ExamplesOf(const std::string& command);

}  // namespace collision::client
