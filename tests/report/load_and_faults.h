// What the service promises under load and beside faults.
#pragma once

#include "idl/report.pb.h"
#include "tests/report/section.h"

namespace collision::report {

/// Load, bad clients, faulty networks, programs that fail, a week: what is promised, what was
/// measured, and by which command. A figure that is not reached says so.
Section LoadAndFaults(const v1::Results& results);

}  // namespace collision::report
