// Our methods: the one list of them.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "collision_core/broad_phase/sweeping_index.h"

namespace collision::bench {

/// A method of ours: one line each.
struct Method {
  std::string name;
  std::function<std::unique_ptr<broad_phase::EarliestSweep>()> make_sweep;
  /// Null for a method that is a sweep alone.
  std::function<std::unique_ptr<broad_phase::SweepingIndex>()> make;
};
const std::vector<Method>& OurMethods();

/// What the service uses: it picks among them by itself.
const Method& OurChoice();

bool IsOurs(const std::string& contestant);

}  // namespace collision::bench
