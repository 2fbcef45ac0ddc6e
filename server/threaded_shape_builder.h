// Shapes are built on threads of their own.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "server/shape_builder.h"

namespace collision::server {

/// First trees before those that refine them, small shapes before large ones. One worker builds
/// whatever waits; another one first trees only, and a third small shapes only: no landscape waits
/// for its first tree because another one is being refined, and no ship for either.
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
  std::vector<ReadyTree> TakeFinished() override;
  BuiltShape Await(const ReadyTree& tree) override;
  void Forget(const std::string& hash) override;
  ShapeBuilderCounters counters() const override;

 private:
  struct Shared;

  /// What a worker takes.
  struct Limits;

  static void Work(std::shared_ptr<Shared> shared, const Limits& limits);

  const std::shared_ptr<Shared> shared_;  ///< With the workers, who may outlive this.
  std::vector<std::thread> workers_;
};

}  // namespace collision::server
