// One pair's contacts, put together from what was found piece by piece.
#pragma once

#include <vector>

#include "client/simulators/checker/advancement.h"
#include "client/simulators/checker/true_contacts.h"

namespace collision::checker {

/// What is found is added in order of time, in nanoseconds.
class ContactAssembly {
 public:
  void AddBalls(long double begin_ns, long double end_ns);
  void Add(Stretch::Kind kind, bool deep, long double begin_ns, long double end_ns);

  /// Of the pair a < b, both of which exist during [start_ns, end_ns]. In order.
  std::vector<TrueContact> Contacts(std::size_t a, std::size_t b, long double start_ns,
                                    long double end_ns) const;

 private:
  std::vector<Span> balls_;
  std::vector<Stretch> stretches_;
};

}  // namespace collision::checker
