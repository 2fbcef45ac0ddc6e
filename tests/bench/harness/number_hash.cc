#include "tests/bench/harness/number_hash.h"

#include <cstdio>

namespace collision::bench {

void NumberHash::AddBits(std::uint64_t bits) {
  for (int byte = 0; byte < 8; ++byte) {
    hash_ = (hash_ ^ (bits >> 8 * byte & 0xff)) * 0x100000001b3;
  }
}

std::string NumberHash::text() const {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash_));
  return text;
}

}  // namespace collision::bench
