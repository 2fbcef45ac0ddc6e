// The flight recorder without its thread: what a step hands over is on file when it goes on.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "server/recording/flight_recorder.h"

namespace collision::server {

class WrittenAtOnce final : public FlightSink {
 public:
  explicit WrittenAtOnce(Segments* segments) : segments_(*segments) {}

  void Take(std::shared_ptr<const v1::RecordedBatch> batch,
            std::optional<Opening> opening) override {
    openings_ += opening.has_value();
    segments_.Take(*batch, opening);
    segments_.Flush();
  }
  bool wants_opening() const override { return segments_.wants_opening(); }
  bool wants_census() const override { return segments_.wants_census(); }
  std::string failure() const override { return segments_.failure(); }

  int openings() const { return openings_; }

 private:
  Segments& segments_;
  int openings_ = 0;
};

}  // namespace collision::server
