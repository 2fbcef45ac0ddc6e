// What the operating system still lets this process have.
#pragma once

#include <cstddef>

namespace collision::dds {

/// So many threads and files a program of the project may take beside those that it has: its own
/// and those of Cyclone DDS.
inline constexpr std::size_t kThreadsNeeded = 16, kFilesNeeded = 48;

/// How many of so many further threads can be started at once. Starts and ends them.
std::size_t ThreadsToBeHad(std::size_t wanted);

/// Cyclone DDS ends the process where it cannot start a thread or open a socket. Throws
/// std::runtime_error before that, with what is short and where it is set.
void RequireHeadroom();

}  // namespace collision::dds
