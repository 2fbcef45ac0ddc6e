// Messages with a random value in every field.
#pragma once

#include <google/protobuf/message.h>

#include <string>

#include "tests/support/random.h"

namespace collision {

/// How long texts, lists and byte fields become.
struct Lengths {
  bool at_bound = false;  ///< As long as the IDL allows; else random and short.
  std::string over;       ///< "Struct.field" that becomes one longer than the IDL allows.
};

/// Fills every field, the nested ones too, as the network could carry it: hashes have their 32
/// bytes, texts are UTF-8. Returns whether it met `lengths.over`.
bool FillRandomly(Random& random, const Lengths& lengths, google::protobuf::Message* message);

}  // namespace collision
