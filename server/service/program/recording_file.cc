#include "server/service/program/recording_file.h"

#include <spdlog/spdlog.h>

#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace collision::server {

RecordingFile::RecordingFile(const std::string& file) : file_(file), first_(file) {
  std::error_code ignored;
  const auto type = std::filesystem::status(file, ignored).type();
  const bool is_plain =
      type == std::filesystem::file_type::not_found || type == std::filesystem::file_type::regular;
  if (!file.empty() && is_plain) first_ += ".new";
}

RecordingFile::~RecordingFile() {
  std::error_code ignored;
  if (first_ != file_) std::filesystem::remove(first_, ignored);
}

std::unique_ptr<RecordingWriter> RecordingFile::Open(const v1::Config& config,
                                                     const ClaimOptions& claim) const {
  if (file_.empty()) return nullptr;
  return std::make_unique<RecordingWriter>(first_, config, claim, file_);
}

void RecordingFile::Keep() {
  if (first_ == file_) return;
  try {
    KeepFormerRecordings(file_);
    std::filesystem::rename(first_, file_);
  } catch (const std::runtime_error& error) {
    spdlog::error("{}; the recording stays {}", error.what(), first_);
  }
  first_ = file_;
}

}  // namespace collision::server
