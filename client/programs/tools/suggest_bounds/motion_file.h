// Files that hold motions: rows of a CSV file, or what collisiond --record wrote.
#pragma once

#include <string>
#include <vector>

#include "client/programs/tools/suggest_bounds/motion_samples.h"

namespace collision::client {

struct MotionFile {
  bool is_recording = false;
  std::vector<SampledAgent> agents;
  std::string warning;  ///< A sentence about what was left out; empty: nothing.
};

/// Reads either; a file with control characters in its first bytes is taken for a recording. Of a
/// recording that ends within an entry, or is damaged from there on, the entries before count.
/// Throws BadInput, with file and line or entry, if nothing of it can be used; std::runtime_error
/// if the file cannot be opened.
MotionFile ReadMotionFile(const std::string& path);

}  // namespace collision::client
