// results.json: put together from what the programs wrote, and read again.
#pragma once

#include <string>

#include "idl/report.pb.h"

namespace collision::report {

/// A folder of tests/report/measure: `facts` (a line each, name and value parted by a tab),
/// `reference` (a number a line), and for each experiment NAME.about (as facts) and NAME.json (what
/// its program wrote, {"figures": {}, "measurements": []}), in the order of `order` (a name a
/// line). Throws std::runtime_error that names the file.
v1::Results Assemble(const std::string& folder);

std::string ToJson(const v1::Results& results);
/// Throws std::runtime_error that names the file and says what is wrong.
v1::Results FromJson(const std::string& path);

/// The spread of the reference's times, as a share of their median: nine tenths of them lie within
/// it. 0: fewer than three.
double NoiseOf(const v1::Results& results);

/// A fixed piece of work of memory and arithmetic, and how long it took on the processor [s].
double TimeReference();

}  // namespace collision::report
