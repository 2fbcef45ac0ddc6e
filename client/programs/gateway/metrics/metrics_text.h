// Metrics as text, in the format that Prometheus reads (version 0.0.4).
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace collision::gateway {

/// Names and values of labels.
using Labels = std::vector<std::pair<std::string, std::string>>;

/// Families one after the other, each with its samples behind it.
class MetricsText {
 public:
  enum class Type { kCounter, kGauge, kHistogram };

  /// `name` ends in the unit, and that of a counter in _total. `help` is one sentence.
  void Begin(const std::string& name, Type type, const std::string& help);

  /// A sample of the family that was begun last.
  void Add(double value, const Labels& labels = {});

  /// One class of a histogram: so many values up to `end`, and all before it; infinity: all.
  void AddBucket(double end, std::uint64_t count_up_to, const Labels& labels = {});
  void AddCount(std::uint64_t count, const Labels& labels = {});

  const std::string& text() const { return text_; }

 private:
  void AddLine(const std::string& name, const Labels& labels, const std::string& value);

  std::string text_, name_;
};

}  // namespace collision::gateway
