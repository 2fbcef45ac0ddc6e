// One case of a suite (./run stress, ./run faults): what is promised, and what was measured.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace collision::suite {

/// How much a case does. The quick part runs with all tests.
struct Setting {
  bool quick = true;
  int times = 1;  ///< So many times as much of everything.

  /// So many of something: fewer in the quick part.
  int Many(int in_quick, int in_full) const { return times * (quick ? in_quick : in_full); }
};

/// What came out of a case: checks that hold or do not, and numbers.
class Outcome {
 public:
  /// Counts a check; the first one that fails is reported. Returns `holds`.
  bool Expect(bool holds, const std::string& what);

  /// A number for the report, finite.
  void Set(const std::string& name, double value);
  /// The greatest of all that were given under this name.
  void Greatest(const std::string& name, double value);
  void Add(const std::string& name, double value);
  double Get(const std::string& name) const;  ///< 0 where there is none.
  /// Single values, all finite, for the report's JSON alone.
  void SetList(const std::string& name, const std::vector<double>& values);

  /// What was measured, as a sentence.
  void Say(const std::string& sentence) { said_ = sentence; }

  bool passed() const { return failures_ == 0 && checks_ > 0; }
  std::uint64_t checks() const { return checks_; }
  /// The sentence; where a check failed that one first.
  std::string Measured() const;
  const std::vector<std::pair<std::string, double>>& numbers() const { return numbers_; }
  const std::vector<std::pair<std::string, std::vector<double>>>& lists() const { return lists_; }

 private:
  double& Slot(const std::string& name, double initial);

  std::uint64_t checks_ = 0, failures_ = 0;
  std::string first_failure_, said_;
  std::vector<std::pair<std::string, double>> numbers_;
  std::vector<std::pair<std::string, std::vector<double>>> lists_;
};

struct Case {
  std::string group;
  std::string name;
  std::string promise;
  void (*run)(const Setting& setting, Outcome* outcome);
  std::string fault = {};  ///< What is done to the program, where the promise does not say it.

  std::string full_name() const { return group + "/" + name; }
};

/// A number in a sentence.
std::string Show(double value);

}  // namespace collision::suite
