// Texts, hashes and sequences between protobuf and idlc's C types.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

#include "dds/dds.h"
#include "idl/dds/text.h"

namespace collision::dds {

inline void CheckBound(const char* field, std::size_t size, std::size_t bound) {
  if (size <= bound) return;
  throw std::length_error(std::string(field) + ": length " + std::to_string(size) +
                          ", allowed 0 to " + std::to_string(bound));
}

template <std::size_t n>
void SetText(const char* field, const std::string& text, char (&to)[n]) {
  CheckBound(field, text.size(), n - 1);
  std::memcpy(to, text.data(), text.size());
  to[text.size()] = '\0';
}

template <std::size_t n>
std::string GetText(const char (&from)[n]) {
  return Utf8({from, strnlen(from, n)});
}

/// A hash is n octets; none at all stands for all zero.
template <std::size_t n>
void SetHash(const char* field, const std::string& bytes, std::uint8_t (&to)[n]) {
  if (!bytes.empty() && bytes.size() != n) {
    throw std::length_error(std::string(field) + ": length " + std::to_string(bytes.size()) +
                            ", allowed 0 or " + std::to_string(n));
  }
  std::memset(to, 0, n);
  std::memcpy(to, bytes.data(), bytes.size());
}

template <std::size_t n>
std::string GetHash(const std::uint8_t (&from)[n]) {
  const bool none = std::all_of(from, from + n, [](std::uint8_t octet) { return octet == 0; });
  return none ? std::string() : std::string(reinterpret_cast<const char*>(from), n);
}

/// Room for `size` elements, all zero. DDS frees it together with the sample.
template <class Sequence>
void Allocate(const char* field, std::size_t size, std::size_t bound, Sequence& to) {
  CheckBound(field, size, bound);
  if (size == 0) return;
  const std::size_t bytes = size * sizeof(*to._buffer);
  to._buffer = static_cast<decltype(to._buffer)>(dds_alloc(bytes));
  std::memset(static_cast<void*>(to._buffer), 0, bytes);
  to._maximum = to._length = static_cast<std::uint32_t>(size);
  to._release = true;
}

}  // namespace collision::dds
