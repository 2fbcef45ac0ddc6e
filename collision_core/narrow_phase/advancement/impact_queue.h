// Pairs of parts of two moving bodies, in the order of the times at which they may touch first.
#pragma once

#include <algorithm>
#include <vector>

#include "collision_core/base/check.h"
#include "collision_core/narrow_phase/pose/pair_parts.h"

namespace collision::narrow_phase {

/// Two nodes, or two elements of two leaves, that certainly do not touch before `time`.
struct ImpactCandidate {
  enum class Kind {
    kNodes,     ///< To be opened.
    kElements,  ///< To be followed by another step along their tangents.
    kResolved   ///< Its time is not refined any further.
  };

  double time;  ///< Seconds after the start of the sweep.
  Kind kind;
  NodePair nodes;  ///< With elements: the leaves in which they were found.
  ElementPair elements = {};
  int steps = 0;    ///< Along tangents, of elements; 0: nodes.
  double size = 0;  ///< Sum of the radii of two nodes [m]; 0: elements.

  bool has_elements() const { return steps > 0 || kind == Kind::kElements; }

  /// Whether x comes after y, as heaps want it. Earlier times first; at equal times the candidate
  /// that is examined farthest (resolved, elements, small nodes, large nodes), so that the search
  /// becomes certain of an overlap without opening every node; then lower numbers.
  friend bool operator<(const ImpactCandidate& x, const ImpactCandidate& y) {
    if (x.time != y.time) return x.time > y.time;
    if (x.kind != y.kind) return x.kind < y.kind;
    if (x.size != y.size) return x.size > y.size;
    return x.numbers() > y.numbers();
  }

 private:
  ElementPair numbers() const {
    if (has_elements()) return elements;
    return {ElementIndex(nodes.a.value()), ElementIndex(nodes.b.value())};
  }
};

/// The candidates of one sweep. Drops those that cannot be the first: later than the duration, or
/// than a candidate that is resolved.
class ImpactQueue {
 public:
  explicit ImpactQueue(double duration) : until_(duration) {}

  bool empty() const { return heap_.empty(); }
  /// Later candidates are dropped [s].
  double until() const { return until_; }
  /// The candidate that comes first. Requires a candidate.
  const ImpactCandidate& front() const {
    CORE_CHECK(!empty(), "the queue has a candidate");
    return heap_.front();
  }

  void Push(const ImpactCandidate& candidate) {
    if (candidate.time > until_) return;
    if (candidate.kind == ImpactCandidate::Kind::kResolved) until_ = candidate.time;
    heap_.push_back(candidate);
    std::push_heap(heap_.begin(), heap_.end());
  }

  /// Removes front() and returns it. Requires a candidate.
  ImpactCandidate Pop() {
    CORE_CHECK(!empty(), "the queue has a candidate");
    std::pop_heap(heap_.begin(), heap_.end());
    const ImpactCandidate first = heap_.back();
    heap_.pop_back();
    return first;
  }

 private:
  double until_;
  std::vector<ImpactCandidate> heap_;
};

}  // namespace collision::narrow_phase
