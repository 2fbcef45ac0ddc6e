#include "server/codec/field_check.h"

#include <cmath>
#include <cstdio>

#include "idl/control_character.h"
#include "idl/limits.h"

namespace collision::server {

std::string Show(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

void FieldCheck::Number(const char* field, double value, double least, double greatest) {
  if (!std::isfinite(value)) {
    Refuse(v1::REJECTED_NOT_FINITE, field, Show(value) + "; a finite number is needed");
  } else if (value < least || value > greatest) {
    Refuse(v1::REJECTED_OUT_OF_RANGE, field,
           Show(value) + "; allowed: " + Show(least) + " to " + Show(greatest));
  }
}

void FieldCheck::Integer(const char* field, std::int64_t value, std::int64_t least,
                         std::int64_t greatest, v1::RejectionReason reason) {
  if (value >= least && value <= greatest) return;
  Refuse(reason, field,
         std::to_string(value) + "; allowed: " + std::to_string(least) + " to " +
             std::to_string(greatest));
}

void FieldCheck::Vector(const char* field, const v1::Vector3& value, double greatest) {
  // NaN fails both comparisons. Names are built only for a refusal.
  const auto within = [greatest](double x) { return x >= -greatest && x <= greatest; };
  if (within(value.x()) && within(value.y()) && within(value.z())) return;
  const std::string name = field;
  Number((name + ".x").c_str(), value.x(), -greatest, greatest);
  Number((name + ".y").c_str(), value.y(), -greatest, greatest);
  Number((name + ".z").c_str(), value.z(), -greatest, greatest);
}

void FieldCheck::Text(const char* field, const std::string& value, std::size_t bytes_max) {
  if (value.size() > bytes_max) {
    Refuse(v1::REJECTED_OUT_OF_RANGE, field,
           std::to_string(value.size()) + " bytes; allowed: 0 to " + std::to_string(bytes_max));
  }
  if (const auto place = wire::FindControl(value)) {
    Refuse(v1::REJECTED_OUT_OF_RANGE, field,
           "a control character, as byte " + std::to_string(*place) +
               "; allowed: printable characters");
  }
}

void CheckSimulatorName(const std::string& name, FieldCheck* check) {
  check->Text("simulator_name", name, wire::kNameMax);
  if (wire::IsName(name)) return;
  check->Refuse(v1::REJECTED_OUT_OF_RANGE, "simulator_name",
                "\"" + name + "\"; allowed: " + wire::kNameText);
}

void FieldCheck::Refuse(v1::RejectionReason reason, const char* field, std::string detail) {
  if (refusal_) return;
  refusal_ = where_;
  refusal_->reason = reason;
  refusal_->field = field;
  refusal_->detail = std::move(detail);
}

}  // namespace collision::server
