#include "idl/dds/network_log.h"

#include <dds/ddsrt/log.h>

#include <iostream>
#include <utility>

#include "idl/dds/text.h"

namespace collision::dds {
namespace {

using Write = std::function<void(const std::string&)>;

void HandOn(void* write, const dds_log_data_t* data) {
  std::string line(data->message, data->size);
  if ((data->priority & DDS_LC_FATAL) != 0) std::cerr << line << std::flush;  // it ends the process
  while (!line.empty() && line.back() == '\n') line.pop_back();
  (*static_cast<const Write*>(write))(Printable(std::move(line)));
}

}  // namespace

void SetNetworkLog(Write write) {
  static Write current;
  dds_set_log_sink(nullptr, nullptr);  // returns once no thread uses the former one
  current = std::move(write);
  if (current) dds_set_log_sink(HandOn, &current);
}

}  // namespace collision::dds
