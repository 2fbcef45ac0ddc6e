// The contestants that find the first meeting of a scene: our methods and the libraries.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tests/baselines/ball_scene.h"
#include "tests/bench/broad_phase/answer.h"

namespace collision::bench {

/// A query from scratch, in its two parts [s].
struct Timed {
  Answer answer;
  double fill = 0;  ///< Until the contestant has the caller's data; libraries read them in place.
  double answer_in = 0;  ///< Building and asking.

  double total() const { return fill + answer_in; }
};

class Contestant {
 public:
  virtual ~Contestant() = default;

  /// From the caller's small records to the answer. Nothing known from an earlier query may be
  /// used, memory may.
  virtual Timed Ask(const baselines::BallScene& scene, double horizon) = 0;
};

struct Entrant {
  std::string name;
  bool ours = false;
  std::function<std::unique_ptr<Contestant>()> make;
  std::string instead_of = {};  ///< The entrant of which this is another use.
};

/// Our methods, then the libraries that were found when this was built.
std::vector<Entrant> Entrants();

}  // namespace collision::bench
