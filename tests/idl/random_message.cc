#include "tests/idl/random_message.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <stdexcept>

#include "tests/idl/idl_file.h"

namespace collision {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

double RandomDouble(Random& random) {
  static constexpr double kExtremes[] = {0.0,
                                         -0.0,
                                         std::numeric_limits<double>::denorm_min(),
                                         std::numeric_limits<double>::max(),
                                         -std::numeric_limits<double>::infinity(),
                                         std::numeric_limits<double>::quiet_NaN()};
  if (random.Chance(0.25)) return kExtremes[random.Below(std::size(kExtremes))];
  return random.Uniform(-1e12, 1e12);
}

std::string RandomText(Random& random, std::size_t length) {
  std::string text;
  while (text.size() + 2 <= length) {
    if (random.Chance(0.1)) {
      text += "\u00e9";
    } else {
      text += static_cast<char>(' ' + random.Below(95));
    }
  }
  return text + std::string(length - text.size(), 'x');
}

std::string RandomBytes(Random& random, std::size_t length) {
  std::string bytes;
  for (std::size_t i = 0; i < length; ++i) bytes += static_cast<char>(random.Next());
  return bytes;
}

class Filler {
 public:
  Filler(Random& random, const Lengths& lengths) : random_(random), lengths_(lengths) {}

  void Fill(Message* message) {
    const auto* descriptor = message->GetDescriptor();
    for (int i = 0; i < descriptor->field_count(); ++i) FillField(descriptor->field(i), message);
  }

  bool met() const { return met_; }

 private:
  static const IdlField& InIdl(const FieldDescriptor* field) {
    for (const IdlField& candidate : Idl().structs.at(field->containing_type()->name())) {
      if (candidate.name == field->name()) return candidate;
    }
    throw std::runtime_error(field->full_name() + " is not in the IDL");
  }

  std::size_t Length(const FieldDescriptor* field, std::size_t bound) {
    if (field->containing_type()->name() + "." + field->name() == lengths_.over) {
      met_ = true;
      return bound + 1;
    }
    return lengths_.at_bound ? bound : random_.Below(std::min<std::size_t>(bound, 20) + 1);
  }

  void FillField(const FieldDescriptor* field, Message* message) {
    const IdlField& idl = InIdl(field);
    const bool optional = idl.sequence && idl.bound == 1;
    if (optional && !lengths_.at_bound && random_.Chance(0.5)) return;
    if (!field->is_repeated()) return FillOne(field, idl, message);
    for (std::size_t n = Length(field, idl.bound); n > 0; --n) AddOne(field, message);
  }

  void AddOne(const FieldDescriptor* field, Message* message) {
    const auto* reflection = message->GetReflection();
    if (field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
      Fill(reflection->AddMessage(message, field));
    } else if (field->cpp_type() == FieldDescriptor::CPPTYPE_UINT32) {
      reflection->AddUInt32(message, field, static_cast<std::uint32_t>(random_.Next()));
    } else if (field->cpp_type() == FieldDescriptor::CPPTYPE_UINT64) {
      reflection->AddUInt64(message, field, random_.Next());
    } else {
      reflection->AddString(message, field, RandomText(random_, random_.Below(20)));
    }
  }

  void FillOne(const FieldDescriptor* field, const IdlField& idl, Message* message) {
    const auto* reflection = message->GetReflection();
    switch (field->cpp_type()) {
      case FieldDescriptor::CPPTYPE_MESSAGE:
        return Fill(reflection->MutableMessage(message, field));
      case FieldDescriptor::CPPTYPE_DOUBLE:
        return reflection->SetDouble(message, field, RandomDouble(random_));
      case FieldDescriptor::CPPTYPE_UINT32:
        return reflection->SetUInt32(message, field, static_cast<std::uint32_t>(random_.Next()));
      case FieldDescriptor::CPPTYPE_UINT64:
        return reflection->SetUInt64(message, field, random_.Next());
      case FieldDescriptor::CPPTYPE_INT64:
        return reflection->SetInt64(message, field, std::bit_cast<std::int64_t>(random_.Next()));
      case FieldDescriptor::CPPTYPE_BOOL:
        return reflection->SetBool(message, field, random_.Chance(0.5));
      case FieldDescriptor::CPPTYPE_ENUM: {
        const int count = field->enum_type()->value_count();
        return reflection->SetEnumValue(message, field, static_cast<int>(random_.Below(count)));
      }
      case FieldDescriptor::CPPTYPE_STRING:
        return reflection->SetString(message, field, String(field, idl));
      default:
        throw std::runtime_error(field->full_name() + ": no such type on the wire");
    }
  }

  std::string String(const FieldDescriptor* field, const IdlField& idl) {
    if (idl.type == "string") return RandomText(random_, Length(field, idl.bound));
    if (idl.sequence) return RandomBytes(random_, Length(field, idl.bound));
    const bool over = Length(field, idl.bound) > idl.bound;
    return RandomBytes(random_, idl.bound + (over ? 1 : 0));
  }

  Random& random_;
  const Lengths& lengths_;
  bool met_ = false;
};

}  // namespace

bool FillRandomly(Random& random, const Lengths& lengths, Message* message) {
  Filler filler(random, lengths);
  filler.Fill(message);
  return filler.met();
}

}  // namespace collision
