// Builds shapes on threads of its own.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "server/shapes/shape_builder.h"

namespace collision::server {

/// Three workers. Simulators take turns, so that the shapes of one do not keep those of others
/// waiting. Of one simulator each worker takes first trees before those that refine them, and small
/// shapes before large ones. One builds everything, one only first trees, one only small shapes: no
/// landscape waits for its first tree while another one is refined, and no ship waits for a
/// landscape.
///
/// A worker that throws ends; what it threw reaches the daemon's thread as ShapeBuilder says.
class ThreadedShapeBuilder final : public ShapeBuilder {
 public:
  /// `on_finished` is called on a worker when has_finished() has become true. It wakes the daemon
  /// and must do nothing else.
  ThreadedShapeBuilder(BuildOptions options, std::function<void()> on_finished);

  /// Afterwards `on_finished` is not called any more. A build cannot be interrupted, and a large
  /// mesh takes minutes: a build that is not over after 0.2 s goes on, and its thread ends after it
  /// without a further effect.
  ~ThreadedShapeBuilder() override;
  ThreadedShapeBuilder(const ThreadedShapeBuilder&) = delete;
  ThreadedShapeBuilder& operator=(const ThreadedShapeBuilder&) = delete;

  void Start(const std::string& hash, std::string bytes, std::uint64_t simulator) override;
  bool has_finished() const override;
  std::vector<ReadyTree> TakeFinished() override;
  BuiltShape Await(const ReadyTree& tree) override;
  void Forget(const std::string& hash) override;
  ShapeBuilderCounters counters() const override;

 private:
  struct Shared;

  /// What a worker takes.
  struct Limits;

  static void Work(const std::shared_ptr<Shared>& shared, const Limits& limits);
  static void BuildUntilStopped(Shared* shared, const Limits& limits);

  const std::shared_ptr<Shared> shared_;  ///< Shared with the workers, which may outlive this.
  std::vector<std::thread> workers_;
};

}  // namespace collision::server
