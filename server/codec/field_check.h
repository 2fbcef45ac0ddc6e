// Checks the fields of one message and keeps the first fault.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "server/codec/refusal.h"

namespace collision::server {

/// Keeps the first fault of a message; checks after it change nothing.
class FieldCheck {
 public:
  /// `where` names topic, simulator, run, slot and generation of every refusal.
  explicit FieldCheck(Refusal where) : where_(std::move(where)) {}

  /// Finite and in [least, greatest].
  void Number(const char* field, double value, double least, double greatest);

  /// In [least, greatest]; a value outside is refused for `reason`.
  void Integer(const char* field, std::int64_t value, std::int64_t least, std::int64_t greatest,
               v1::RejectionReason reason = v1::REJECTED_OUT_OF_RANGE);

  /// Every component finite and at most `greatest` in magnitude.
  void Vector(const char* field, const v1::Vector3& value, double greatest);

  /// At most `bytes_max` bytes of UTF-8, without control characters: texts reach logs and
  /// terminals.
  void Text(const char* field, const std::string& value, std::size_t bytes_max);

  void Refuse(v1::RejectionReason reason, const char* field, std::string detail);

  bool passed() const { return !refusal_.has_value(); }
  const std::optional<Refusal>& refusal() const { return refusal_; }

 private:
  Refusal where_;
  std::optional<Refusal> refusal_;
};

/// The name of a simulator: part of a DDS partition, and of lines of logs.
void CheckSimulatorName(const std::string& name, FieldCheck* check);

/// A number as refusals show it.
std::string Show(double value);

}  // namespace collision::server
