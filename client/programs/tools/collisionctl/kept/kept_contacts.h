// The journal of contacts, as `collisionctl events --since YESTERDAY` reads it.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <ostream>
#include <string>

#include "client/programs/tools/collisionctl/events/event_printer.h"
#include "client/programs/tools/collisionctl/kept/kept_options.h"
#include "idl/recording.pb.h"

namespace collision::client {

struct WallRange {
  std::int64_t since_ns = std::numeric_limits<std::int64_t>::min();
  std::int64_t until_ns = std::numeric_limits<std::int64_t>::max();
};

/// Calls `take` for each contact of a world that was published then, in that order. What is damaged
/// in a file of which no service writes any more goes to `complain`, a line each; the rest of that
/// file is left out. Returns the number of files that are there.
std::size_t ReadContacts(const std::string& state_folder, const std::string& place,
                         const WallRange& range,
                         const std::function<void(const v1::ToldContact&)>& take,
                         const std::function<void(const std::string&)>& complain);

/// Prints them as `events` prints what a service tells, each behind the time at which it was
/// published (UTC). What another service told again when it took over is left out. Returns the exit
/// code: kExitOutputFailed where something of the journal could not be read.
int PrintKeptContacts(const KeptOptions& options, const std::string& world, std::uint32_t domain,
                      const EventFormat& format, EventFilter filter);

}  // namespace collision::client
