#include "idl/dds/network_log.h"

#include <dds/ddsrt/log.h>

#include <iostream>
#include <memory>
#include <mutex>
#include <utility>

#include "idl/dds/text.h"

namespace collision::dds {
namespace {

using Write = std::function<void(const std::string&)>;

/// Cyclone DDS orders its calls with a lock of its own; ours shows that order to tools, too.
struct Current {
  std::mutex mutex;
  std::shared_ptr<const Write> write;
};

void HandOn(void* current, const dds_log_data_t* data) {
  std::string line(data->message, data->size);
  if ((data->priority & DDS_LC_FATAL) != 0) std::cerr << line << std::flush;  // it ends the process
  while (!line.empty() && line.back() == '\n') line.pop_back();
  std::shared_ptr<const Write> write;
  {
    auto& all = *static_cast<Current*>(current);
    const std::lock_guard lock(all.mutex);
    write = all.write;
  }
  (*write)(Printable(std::move(line)));
}

}  // namespace

void SetNetworkLog(Write write) {
  static Current current;
  dds_set_log_sink(nullptr, nullptr);  // returns once no thread uses the former one
  const bool is_wanted = write != nullptr;
  {
    const std::lock_guard lock(current.mutex);
    current.write = std::make_shared<const Write>(std::move(write));
  }
  if (is_wanted) dds_set_log_sink(HandOn, &current);
}

}  // namespace collision::dds
