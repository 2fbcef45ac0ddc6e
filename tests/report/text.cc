#include "tests/report/text.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace collision::report {
namespace {

constexpr int kDigits = 4;
/// Whole numbers up to here are written out.
constexpr double kWholeMax = 1e7;

std::string Print(const char* format, double value) {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

std::string Short(double value) {
  if (value == std::floor(value) && std::abs(value) < kWholeMax) return Print("%.0f", value);
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", kDigits, value);
  return text;
}

std::string Rounded(double value, int digits) {
  const double size = std::abs(value);
  if (size >= std::pow(10, digits) && size < kWholeMax) {
    const double step = std::pow(10, std::floor(std::log10(size)) + 1 - digits);
    return Grouped(std::round(value / step) * step);
  }
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

std::string Grouped(double value) {
  std::string text = Print("%.0f", value);
  for (std::size_t at = text.size(); at > 3 + (value < 0 ? 1 : 0);) text.insert(at -= 3, ",");
  return text;
}

std::string Duration(double seconds) {
  if (seconds >= 60) {
    const auto whole = static_cast<long long>(std::llround(seconds));
    return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
  }
  if (seconds >= 1) return Print("%.3g s", seconds);
  if (seconds >= 1e-3) return Print("%.3g ms", seconds * 1e3);
  if (seconds >= 1e-6) return Print("%.3g µs", seconds * 1e6);
  return Print("%.3g ns", seconds * 1e9);
}

std::string ReadFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path + ": cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

void WriteFile(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace collision::report
