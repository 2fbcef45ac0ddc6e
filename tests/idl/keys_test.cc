// Goal:   collision.idl is one that every vendor's DDS can use: no key is longer than the 16 bytes
//         that travel as they are (of a longer one some vendors send a hash only, and its disposal
//         is lost), and no identifier differs from another one of its scope in case alone, which
//         IDL forbids.
// Method: the IDL file, read as text.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "tests/idl/idl_file.h"

namespace collision {
namespace {

constexpr std::size_t kKeyBytesMax = 16;

/// The bytes of a field in a key; more than a key may have for what has no fixed length.
std::size_t KeyBytesOf(const IdlField& field) {
  if (field.sequence || field.type == "string") return kKeyBytesMax + 1;
  if (field.type == "octet[]") return field.bound;
  if (field.type == "unsigned long") return 4;
  if (field.type == "unsigned long long") return 8;
  return kKeyBytesMax + 1;
}

std::string LowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), ::tolower);
  return text;
}

/// The first of the names that equals an earlier one but for its case.
std::string FirstClash(const std::vector<std::string>& names) {
  std::set<std::string> seen;
  for (const std::string& name : names) {
    if (!seen.insert(LowerCase(name)).second) return name;
  }
  return "";
}

TEST(Keys, AreNoLongerThan16Bytes) {
  std::size_t keyed = 0;
  for (const auto& [name, fields] : Idl().structs) {
    std::size_t bytes = 0;
    for (const IdlField& field : fields) bytes += field.key ? KeyBytesOf(field) : 0;
    EXPECT_LE(bytes, kKeyBytesMax) << name;
    keyed += bytes > 0;
  }
  EXPECT_EQ(keyed, 16u) << "one for each topic";
}

TEST(Identifiers, OfAStructAndTheTypesItUsesDifferInMoreThanCase) {
  for (const auto& [name, fields] : Idl().structs) {
    std::set<std::string> types;
    for (const IdlField& field : fields) types.insert(field.type);
    std::vector<std::string> names(types.begin(), types.end());
    for (const IdlField& field : fields) names.push_back(field.name);
    EXPECT_EQ(FirstClash(names), "") << name;
  }
}

TEST(Identifiers, OfTheModuleDifferInMoreThanCase) {
  std::vector<std::string> names;
  for (const auto& [name, fields] : Idl().structs) names.push_back(name);
  for (const auto& [name, enumerators] : Idl().enums) {
    names.push_back(name);
    names.insert(names.end(), enumerators.begin(), enumerators.end());
  }
  EXPECT_EQ(FirstClash(names), "");
  EXPECT_EQ(FirstClash({"topic", "Slot", "Topic"}), "Topic");
}

}  // namespace
}  // namespace collision
