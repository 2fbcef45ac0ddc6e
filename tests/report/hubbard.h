// The section of the paper's own experiments.
#pragma once

#include "idl/report.pb.h"
#include "tests/report/section.h"

namespace collision::report {

Section Hubbard(const v1::Results& results);

}  // namespace collision::report
