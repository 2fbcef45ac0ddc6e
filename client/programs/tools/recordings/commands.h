// The commands of collisionctl about recorded worlds.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>

#include "client/programs/tools/recordings/convert.h"
#include "client/programs/tools/recordings/export.h"
#include "client/programs/tools/recordings/plot.h"
#include "collision/monitor.h"

namespace collision::client {

/// convert, record, export and plot. It outlives the app.
class RecordingCommands {
 public:
  explicit RecordingCommands(CLI::App* app)
      : convert_(AddConvertCommand(app, &mcap_)),
        record_(AddRecordCommand(app, &mcap_)),
        export_(AddExportCommand(app, &page_)),
        plot_(AddPlotCommand(app, &chart_)) {}
  RecordingCommands(const RecordingCommands&) = delete;
  RecordingCommands& operator=(const RecordingCommands&) = delete;

  /// Runs the one that was parsed, and returns its exit code; nullopt: none was. `place` and
  /// `timeout_s` are of a world that is recorded.
  std::optional<int> Run(const MonitorOptions& place, double timeout_s) const {
    if (convert_->parsed()) return RunConvert(mcap_);
    if (record_->parsed()) return RunRecord(mcap_, place, timeout_s);
    if (export_->parsed()) return RunExport(page_);
    if (plot_->parsed()) return RunPlot(chart_);
    return std::nullopt;
  }

 private:
  ConvertOptions mcap_;
  ExportOptions page_;
  PlotOptions chart_;
  const CLI::App *convert_, *record_, *export_, *plot_;
};

}  // namespace collision::client
