#include "collision/types.h"

namespace collision::client {

const char* Name(EventStatus status) {
  switch (status) {
    case EventStatus::kPossible:
      return "possible";
    case EventStatus::kConfirmed:
      return "confirmed";
    case EventStatus::kDismissed:
      return "dismissed";
    case EventStatus::kUndecided:
      return "undecided";
    case EventStatus::kWithdrawn:
      return "withdrawn";
    case EventStatus::kEnded:
      return "ended";
  }
  return "unknown";
}

const char* Name(ExpectedOutcome outcome) {
  switch (outcome) {
    case ExpectedOutcome::kTouch:
      return "touch";
    case ExpectedOutcome::kPass:
      return "pass";
    case ExpectedOutcome::kUndecided:
      return "undecided";
  }
  return "unknown";
}

const char* Name(EventLimit limit) {
  switch (limit) {
    case EventLimit::kNone:
      return "none";
    case EventLimit::kBudget:
      return "budget";
    case EventLimit::kMotion:
      return "motion";
    case EventLimit::kGeometry:
      return "geometry";
  }
  return "unknown";
}

}  // namespace collision::client
