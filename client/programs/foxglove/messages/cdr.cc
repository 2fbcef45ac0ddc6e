#include "client/programs/foxglove/messages/cdr.h"

#include <bit>

namespace collision::client {
namespace {

constexpr std::size_t kHeaderBytes = 4;
constexpr std::int64_t kNanosecondsOfSecond = 1'000'000'000;

}  // namespace

CdrWriter& CdrWriter::Number(std::uint64_t value, std::size_t size) {
  while ((bytes_.size() - kHeaderBytes) % size != 0) bytes_ += '\0';
  for (std::size_t i = 0; i < size; ++i) bytes_ += static_cast<char>(value >> (8 * i));
  return *this;
}

CdrWriter& CdrWriter::Float64(double value) {
  return Number(std::bit_cast<std::uint64_t>(value), 8);
}

CdrWriter& CdrWriter::String(const std::string& value) {
  const std::string text = value.substr(0, value.find('\0'));
  Number(text.size() + 1, 4);
  bytes_ += text;
  bytes_ += '\0';
  return *this;
}

CdrWriter& CdrWriter::Time(std::int64_t instant_ns) {
  Int32(static_cast<std::int32_t>(instant_ns / kNanosecondsOfSecond));
  return Uint32(static_cast<std::uint32_t>(instant_ns % kNanosecondsOfSecond));
}

}  // namespace collision::client
