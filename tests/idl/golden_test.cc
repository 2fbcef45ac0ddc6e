// Goal:   the types of hello never change, and no other type changes without another WIRE_REVISION.
// Method: a golden copy of the former, and a hash of all types as the IDL file has them, without
//         comments and blanks.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>

#include "idl/sha256.h"

namespace collision {
namespace {

/// The file without comments, and each run of blanks as one.
std::string Normalized() {
  std::ifstream file(COLLISION_IDL_FILE);
  std::string text((std::istreambuf_iterator<char>(file)), {});
  text = std::regex_replace(text, std::regex("//[^\n]*"), "");
  return std::regex_replace(text, std::regex("\\s+"), " ");
}

std::string Hex(const std::string& bytes) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const char byte : bytes) {
    text += kDigits[static_cast<unsigned char>(byte) >> 4];
    text += kDigits[static_cast<unsigned char>(byte) & 15];
  }
  return text;
}

TEST(Golden, TheTypesOfHelloNeverChange) {
  const std::string idl = Normalized();
  for (const char* type :
       {"@final struct KeyValue { string<64> key; string<256> value; };",
        "enum ClockKind { CLOCK_LOCK_STEP, CLOCK_REAL_TIME };",
        "@final struct ServiceHello { @key unsigned long long service_id; @key unsigned long "
        "region; unsigned long wire_revision; unsigned long term; unsigned long epoch; ClockKind "
        "clock_kind; long long skew_max_ns; string<64> world; string<64> frame; string<64> "
        "epoch_utc; string<64> version; sequence<unsigned long, 64> regions; sequence<KeyValue, "
        "16> extensions; };",
        "@final struct SimulatorHello { @key unsigned long long simulator_id; @key unsigned long "
        "incarnation; unsigned long wire_revision; ClockKind clock_kind; string<64> "
        "simulator_name; string<64> frame; string<64> version; sequence<KeyValue, 16> extensions; "
        "};"}) {
    EXPECT_NE(idl.find(type), std::string::npos) << type;
  }
}

TEST(Golden, AnotherTypeIsAnotherRevision) {
  EXPECT_EQ(Hex(Sha256(Normalized())),
            "8901e6904b267f2c0a4c9e126329de3250e733fe24a2f2640d1b8e3572a7fde0")
      << "raise WIRE_REVISION (here and in limits.h) for what programs of before cannot read";
}

}  // namespace
}  // namespace collision
