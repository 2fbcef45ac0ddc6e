// Time, medians, and a process of its own for each measurement.
#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace collision::bench {

/// The clock on the wall [s].
double WallNow();
/// The processor's time of this process [s]: other processes of a shared machine do not count, a
/// second thread would. It takes longer to ask.
double CpuNow();

class Stopwatch {
 public:
  double seconds() const { return WallNow() - start_; }

 private:
  double start_ = WallNow();
};

class CpuStopwatch {
 public:
  double seconds() const { return CpuNow() - start_; }

 private:
  double start_ = CpuNow();
};

/// The part `fraction` of the values is not above it; `values` not empty.
double Quantile(std::vector<double> values, double fraction);
inline double Median(const std::vector<double>& values) { return Quantile(values, 0.5); }

/// nullopt: there are no values.
std::optional<double> QuantileOf(const std::vector<double>& values, double fraction);

/// The shortest of several runs of `work`, by the clock on the wall or in processor time [s].
double LeastSeconds(int runs, const std::function<void()>& work);
double LeastCpuSeconds(int runs, const std::function<void()>& work);

enum class ApartStatus { kDone, kCutOff, kFailed };

struct ApartResult {
  ApartStatus status = ApartStatus::kFailed;
  std::vector<double> values;
};

/// Runs `work` in a child process, which sees everything of this one and changes nothing of it, and
/// ends it when it has used the processor for `cut_off` seconds. So one cell's memory, threads or
/// crash never disturb another.
ApartResult RunApart(double cut_off, const std::function<std::vector<double>()>& work);

/// Keeps freed memory in the process, so that no contestant pays the kernel again and again for
/// the same pages.
void KeepMemory();

}  // namespace collision::bench
