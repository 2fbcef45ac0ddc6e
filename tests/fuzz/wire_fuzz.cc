#include <array>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "dds/dds.h"
#include "dds/ddsi/ddsi_serdata.h"
#include "idl/dds/conversion.h"
#include "idl/dds/entity.h"
#include "idl/dds/topics.h"
#include "tests/fuzz/fuzzed_messages.h"
#include "tests/fuzz/targets.h"

namespace collision::fuzz {
namespace {

using dds::Check;

constexpr std::uint32_t kDomain = 229;
constexpr const char* kNoNetwork =
    "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface name=\"lo\"/>"
    "</Interfaces><AllowMulticast>false</AllowMulticast></General></Domain></CycloneDDS>";

void* EmptySample(const dds::TopicRow& row) {
  return std::memset(dds_alloc(row.type->m_size), 0, row.type->m_size);
}

/// Cyclone DDS's own types of all topics, with which it reads what arrives. They are made with the
/// topic's first writer, and found at its first sample.
class ArrivingTypes {
 public:
  ArrivingTypes()
      : domain_(Check(dds_create_domain(kDomain, kNoNetwork), "domain")),
        participant_(Check(dds_create_participant(kDomain, nullptr, nullptr), "participant")) {
    for (const dds::TopicRow& row : dds::Topics()) {
      const dds_entity_t topic = Check(
          dds_create_topic(participant_.get(), row.type, row.name, nullptr, nullptr), row.name);
      const dds_entity_t reader =
          Check(dds_create_reader(participant_.get(), topic, nullptr, nullptr), row.name);
      const dds_entity_t writer =
          Check(dds_create_writer(participant_.get(), topic, nullptr, nullptr), row.name);
      void* const sample = EmptySample(row);
      Check(dds_write(writer, sample), row.name);
      dds_sample_free(sample, row.type, DDS_FREE_ALL);
      ddsi_serdata* taken = nullptr;
      dds_sample_info_t info;
      Check(dds_takecdr(reader, &taken, 1, &info, DDS_ANY_STATE), row.name);
      types_[static_cast<std::size_t>(row.id)] = taken->type;
      ddsi_serdata_unref(taken);
    }
  }

  const ddsi_sertype* Of(dds::TopicId topic) const {
    return types_[static_cast<std::size_t>(topic)];
  }

 private:
  const dds::Entity domain_, participant_;
  std::array<const ddsi_sertype*, dds::kTopics> types_{};
};

/// What is handed on is whole: it is protobuf, and has a form on the network again.
template <class Message>
void CheckHandedOn(const Message& message) {
  const std::string bytes = message.SerializeAsString();
  Message again;
  Require(again.ParseFromString(bytes), "a message that cannot be read again");
  Require(again.SerializeAsString() == bytes, "a message that is read otherwise");
}

/// As idl/dds/intake.cc does it.
void Receive(const dds::TopicRow& row, const ddsi_serdata* data) {
  void* const sample = EmptySample(row);
  if (ddsi_serdata_to_sample(data, sample, nullptr, nullptr)) {
    if (row.source == dds::Source::kService) {
      v1::Output output;
      dds::FromWire(row.id, sample, &output);
      CheckHandedOn(output);
    } else {
      v1::Input input;
      dds::FromWire(row.id, sample, &input);
      CheckHandedOn(input);
      Require(ThroughNetwork(&input), "a message without a form on the network");
    }
  }
  dds_sample_free(sample, row.type, DDS_FREE_ALL);
}

}  // namespace

// The first byte says of which topic, the second in which encoding; the rest is what arrives.
void FuzzWire(Bytes bytes) {
  static const ArrivingTypes types;
  if (bytes.size() < 2) return;
  const dds::TopicRow& row = dds::Topics()[bytes[0] % dds::kTopics];
  std::vector<unsigned char> arriving = {0, bytes[1], 0, 0};
  arriving.insert(arriving.end(), bytes.begin() + 2, bytes.end());
  // As the network hands it on, padded to four bytes.
  while (arriving.size() % 4 != 0) {
    arriving.push_back(0);
    ++arriving[3];
  }
  const ddsrt_iovec_t piece{arriving.data(), arriving.size()};
  ddsi_serdata* const data =
      ddsi_serdata_from_ser_iov(types.Of(row.id), SDK_DATA, 1, &piece, arriving.size());
  if (data == nullptr) return;
  Receive(row, data);
  ddsi_serdata_unref(data);
}

}  // namespace collision::fuzz
