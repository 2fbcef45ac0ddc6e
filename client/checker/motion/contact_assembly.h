// Joins the findings about a pair, piece by piece, into its contacts.
#pragma once

#include <vector>

#include "client/checker/motion/advancement.h"
#include "client/checker/motion/true_contact.h"

namespace collision::checker {

/// Findings are added in order of time, in nanoseconds.
class ContactAssembly {
 public:
  void AddBalls(long double begin_ns, long double end_ns);
  void Add(Stretch::Kind kind, bool deep, long double begin_ns, long double end_ns);

  /// The contacts, in order, of the pair a < b, both of which exist during [start_ns, end_ns].
  std::vector<TrueContact> Contacts(std::size_t a, std::size_t b, long double start_ns,
                                    long double end_ns) const;

 private:
  std::vector<Span> balls_;
  std::vector<Stretch> stretches_;
};

}  // namespace collision::checker
