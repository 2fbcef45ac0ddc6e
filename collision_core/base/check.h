// Checks of preconditions and invariants that stay on in every build.
#pragma once

#include <span>
#include <stdexcept>

namespace collision {

/// A broken precondition or invariant: a bug in this program, never bad input (input is refused at
/// the edge, by the codec). The message names what must hold, the condition, file, line and values.
///
/// CORE_CHECK throws it, so that every owner of a file or socket on the stack can close it. The
/// state of the object that threw is unspecified: destroy it and do nothing else with it.
/// `collisiond` logs the message, closes its recording and ends with status 70 (EX_SOFTWARE).
class CheckFailure : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// Throws a CheckFailure that says where, what and with which values. The cold path of CORE_CHECK.
[[noreturn]] void ThrowCheckFailure(const char* condition, const char* file, int line,
                                    const char* message, std::span<const double> values);

/// Converts the values of a failed check; kept out of line so that a check costs one branch.
template <typename... Numbers>
[[noreturn, gnu::noinline, gnu::cold]] void FailCheck(const char* condition, const char* file,
                                                      int line, const char* message,
                                                      Numbers... numbers) {
  const double values[sizeof...(numbers) + 1] = {static_cast<double>(numbers)...};
  ThrowCheckFailure(condition, file, line, message, {values, sizeof...(numbers)});
}

}  // namespace collision

/// Throws CheckFailure unless `condition` holds, in every build type. `message` says in words what
/// must hold; numbers after it are printed with it:
///   CORE_CHECK(node < size, "a node index lies within its tree", node, size);
/// Costs one predictable branch. Not for the inner loops of SIMD kernels: check before them.
///
/// In the headers of the core "Requires" names a precondition that is checked in every build, and
/// "Unchecked" one that is the caller's duty, because a check would cost more than the work or the
/// function cannot know.
#define CORE_CHECK(condition, message, ...)                     \
  (__builtin_expect(static_cast<bool>(condition), 1)            \
       ? static_cast<void>(0)                                   \
       : ::collision::FailCheck(#condition, __FILE__, __LINE__, \
                                message __VA_OPT__(, ) __VA_ARGS__))
