// Shapes are built on threads of their own.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "server/shape_builder.h"

namespace collision::server {

/// One worker builds whatever waits, the smallest shape first; another one small shapes only, so that
/// no ship waits for minutes because somebody's landscape is being built.
class ThreadedShapeBuilder final : public ShapeBuilder {
 public:
  /// `on_finished` is called from a worker, after has_finished() has become true: it wakes whoever
  /// waits, and does nothing else.
  ThreadedShapeBuilder(BuildOptions options, std::function<void()> on_finished);

  /// `on_finished` is not called any more. A build cannot be interrupted, and a large mesh takes
  /// minutes: one that is not over soon is left to itself, and its thread ends after it.
  ~ThreadedShapeBuilder() override;
  ThreadedShapeBuilder(const ThreadedShapeBuilder&) = delete;
  ThreadedShapeBuilder& operator=(const ThreadedShapeBuilder&) = delete;

  void Start(const std::string& hash, std::string bytes) override;
  bool has_finished() const override;
  std::vector<std::string> TakeFinished() override;
  BuiltShape Await(const std::string& hash) override;
  void Forget(const std::string& hash) override;
  ShapeBuilderCounters counters() const override;

 private:
  struct Shared;

  static void Work(std::shared_ptr<Shared> shared, std::size_t bytes_max);

  const std::shared_ptr<Shared> shared_;  ///< With the workers, who may outlive this.
  std::vector<std::thread> workers_;
};

}  // namespace collision::server
