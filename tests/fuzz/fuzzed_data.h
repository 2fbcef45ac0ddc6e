// Numbers, choices and texts out of a fuzzer's bytes.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace collision::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// Takes bytes from the front, so that a mutation near the end of an input changes only what comes
/// late. At the end everything is 0: an input that is cut off is a shorter one.
class FuzzedData {
 public:
  explicit FuzzedData(Bytes bytes) : bytes_(bytes) {}

  bool empty() const { return bytes_.empty(); }

  std::uint8_t Byte() { return static_cast<std::uint8_t>(Bits(1)); }

  /// `count` bytes, 0 to 8, the least first.
  std::uint64_t Bits(std::size_t count) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < count && !bytes_.empty(); ++i, bytes_ = bytes_.subspan(1)) {
      bits |= std::uint64_t{bytes_.front()} << (8 * i);
    }
    return bits;
  }

  bool Flag() { return (Byte() & 1) != 0; }

  /// 0 to n − 1, n <= 256.
  std::size_t Below(std::size_t n) { return Byte() % n; }

  template <typename Value, std::size_t n>
  const Value& OneOf(const Value (&values)[n]) {
    return values[Below(n)];
  }

  /// Any bits as a number: infinities, NaN and denormals among them.
  double AnyNumber() { return std::bit_cast<double>(Bits(8)); }

  /// In [-greatest, greatest]: small and simple, of any magnitude, an end of the range, or any bits
  /// that are in it.
  double Within(double greatest) {
    const std::uint8_t kind = Byte();
    if (kind < 128) return Held((kind - 64) / 4.0, greatest);
    if (kind < 192) return Held(OfAnyMagnitude(), greatest);
    if (kind < 200) return kind % 2 == 0 ? greatest : -greatest;
    if (kind < 208) return std::nextafter(kind % 2 == 0 ? 1.0 : -1.0, 0.0);
    return Held(AnyNumber(), greatest);
  }

  /// In [0, greatest].
  double UpTo(double greatest) { return std::abs(Within(greatest)); }

  /// As above, but now and then any bits at all, for what is to be refused.
  double Wild(double greatest) { return Byte() == 255 ? AnyNumber() : Within(greatest); }

  /// At most so many of the bytes that are left.
  std::string Text(std::size_t length_max) {
    const std::size_t wanted = Bits(2);
    return Taken(std::min({length_max, wanted, bytes_.size()}));
  }

 private:
  static double Held(double value, double greatest) {
    if (std::isnan(value)) return 0;
    return std::min(std::max(value, -greatest), greatest);
  }

  double OfAnyMagnitude() {
    const double mantissa = 1 + static_cast<double>(Byte()) / 256;
    const int exponent = static_cast<int>(Bits(2) % 2100) - 1080;
    return std::ldexp(Flag() ? mantissa : -mantissa, exponent);
  }

  std::string Taken(std::size_t length) {
    const Bytes text = bytes_.first(length);
    bytes_ = bytes_.subspan(length);
    return {text.begin(), text.end()};
  }

  Bytes bytes_;
};

}  // namespace collision::fuzz
