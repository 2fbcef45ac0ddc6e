#include "idl/dds/network_log.h"

#include <dds/ddsrt/log.h>

#include <mutex>
#include <utility>

#include "idl/dds/text.h"

namespace collision::dds {
namespace {

struct Sink {
  std::mutex mutex;
  std::function<void(bool, const std::string&)> write;
};

void Take(void* sink, const dds_log_data_t* data) {
  std::string line(data->message, data->size);
  while (!line.empty() && line.back() == '\n') line.pop_back();
  const bool is_error = (data->priority & (DDS_LC_FATAL | DDS_LC_ERROR)) != 0;
  auto& to = *static_cast<Sink*>(sink);
  const std::lock_guard lock(to.mutex);
  to.write(is_error, Printable(std::move(line)));
}

}  // namespace

void SetNetworkLog(std::function<void(bool is_error, const std::string& line)> write) {
  // Threads of Cyclone DDS may outlive whatever could own it.
  static Sink& sink = *new Sink;
  {
    const std::lock_guard lock(sink.mutex);
    sink.write = std::move(write);
  }
  dds_set_log_sink(Take, &sink);
}

}  // namespace collision::dds
