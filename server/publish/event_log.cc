#include "server/publish/event_log.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/util/delimited_message_util.h>

#include <string>

namespace collision::server {

void EventLog::Add(v1::CollisionEvent event) {
  if (event.has_lower()) event.mutable_lower()->clear_run();
  if (event.has_higher()) event.mutable_higher()->clear_run();
  constexpr std::uint64_t kPrime = 0x100000001b3;
  std::string bytes;
  {
    google::protobuf::io::StringOutputStream stream(&bytes);
    google::protobuf::io::CodedOutputStream coded(&stream);
    coded.SetSerializationDeterministic(true);
    google::protobuf::util::SerializeDelimitedToCodedStream(event, &coded);
  }
  for (const char c : bytes) hash_ = (hash_ ^ static_cast<unsigned char>(c)) * kPrime;
  ++count_;
}

}  // namespace collision::server
