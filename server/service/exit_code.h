// How the program ends.
#pragma once

namespace collision::server {

/// As sysexits.h has them, where it has one.
enum ExitCode {
  kExitOk = 0,              ///< Ended as asked.
  kExitUsage = 2,           ///< The command line is wrong.
  kExitUnavailable = 69,    ///< DDS is not available.
  kExitSoftware = 70,       ///< A fault of this program: a check has failed.
  kExitSystem = 71,         ///< Memory, or another resource of the system, is exhausted.
  kExitFile = 74,           ///< A file or folder that it needs cannot be written or read, or is
                            ///< damaged: recording, journal, log, tree cache.
  kExitOccupied = 75,       ///< Another service has the world.
  kExitConfiguration = 78,  ///< The configuration is wrong, or its file cannot be read.
};

}  // namespace collision::server
