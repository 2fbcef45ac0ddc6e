// Plain messages as ROS 2 puts them on the wire.
#pragma once

#include <cstdint>
#include <string>

namespace collision::client {

/// Writes fields in their order as CDR, little-endian: 4 bytes that say so, then each number at a
/// multiple of its size, counted from behind those 4.
/// Source: OMG, "DDS Interoperability Wire Protocol" 2.5, clause 10 (PLAIN_CDR).
class CdrWriter {
 public:
  CdrWriter& Int32(std::int32_t value) { return Number(static_cast<std::uint32_t>(value), 4); }
  CdrWriter& Uint32(std::uint32_t value) { return Number(value, 4); }
  CdrWriter& Uint64(std::uint64_t value) { return Number(value, 8); }
  CdrWriter& Float64(double value);

  /// Its length with the final 0, the bytes, the 0. What stands behind a 0 within is left out.
  CdrWriter& String(const std::string& value);

  /// builtin_interfaces/Time; `instant_ns` >= 0.
  CdrWriter& Time(std::int64_t instant_ns);

  const std::string& bytes() const { return bytes_; }

 private:
  CdrWriter& Number(std::uint64_t value, std::size_t size);

  std::string bytes_{"\x00\x01\x00\x00", 4};
};

}  // namespace collision::client
