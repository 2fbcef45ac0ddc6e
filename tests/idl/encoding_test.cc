// Goal:   one encoded sample of every topic's type stays the same, byte by byte: whatever changes
//         an encoding is noticed, and goes with another WIRE_REVISION.
// Method: each message filled from a fixed seed with every list and text at its bound, so that no
//         field is left out, written to a reader on loopback, which hands out the bytes of the
//         wire (CDR); golden_samples.txt holds their number and SHA-256.
#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <memory>
#include <sstream>

#include "idl/dds/conversion.h"
#include "idl/dds/topics.h"
#include "idl/sha256.h"
#include "tests/idl/idl_file.h"
#include "tests/idl/random_message.h"

namespace collision {
namespace {

constexpr dds_domainid_t kDomain = 97;

/// Writes samples to itself.
class Loopback {
 public:
  Loopback()
      : domain_(dds_create_domain(kDomain, COLLISION_DDS_LOOPBACK)),
        participant_(dds_create_participant(kDomain, nullptr, nullptr)) {}
  ~Loopback() { dds_delete(domain_); }

  std::string Encode(const char* name, const dds_topic_descriptor_t* type, const void* sample) {
    const std::unique_ptr<dds_qos_t, void (*)(dds_qos_t*)> qos(dds_create_qos(), dds_delete_qos);
    dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
    const dds_entity_t topic = dds_create_topic(participant_, type, name, nullptr, nullptr);
    const dds_entity_t reader = dds_create_reader(participant_, topic, qos.get(), nullptr);
    const dds_entity_t writer = dds_create_writer(participant_, topic, qos.get(), nullptr);
    EXPECT_EQ(dds_write(writer, sample), DDS_RETCODE_OK) << name;
    ddsi_serdata* data = nullptr;
    dds_sample_info_t info;
    if (dds_takecdr(reader, &data, 1, &info, DDS_ANY_STATE) != 1) return "";
    std::string bytes(ddsi_serdata_size(data), '\0');
    ddsi_serdata_to_ser(data, 0, bytes.size(), bytes.data());
    ddsi_serdata_unref(data);
    return bytes;
  }

 private:
  const dds_entity_t domain_, participant_;
};

std::string Hex(const std::string& bytes) {
  std::ostringstream text;
  for (const unsigned char byte : bytes) {
    text << "0123456789abcdef"[byte >> 4] << "0123456789abcdef"[byte & 15];
  }
  return text.str();
}

template <class Message>
void Add(Loopback* loopback, std::map<std::string, std::string>* samples) {
  Random random(1);
  Message message;
  FillRandomly(random, {.at_bound = true, .over = {}}, &message);
  const auto& row = dds::Row(dds::Carrier<Message>::kTopic);
  const std::string bytes = loopback->Encode(row.name, row.type, dds::ToWire(message).get());
  (*samples)[Message::descriptor()->name()] =
      std::to_string(bytes.size()) + " " + Hex(Sha256(bytes));
}

template <class... Messages>
std::map<std::string, std::string> Encoded() {
  Loopback loopback;
  std::map<std::string, std::string> samples;
  (Add<Messages>(&loopback, &samples), ...);
  return samples;
}

std::map<std::string, std::string> Golden() {
  std::ifstream file(COLLISION_GOLDEN_SAMPLES);
  std::map<std::string, std::string> samples;
  for (std::string name, bytes, hash; file >> name >> bytes >> hash;) {
    samples[name] = bytes + " " + hash;
  }
  return samples;
}

TEST(Encoding, OfEveryTypeIsThatOfTheGoldenSample) {
  const auto found =
      Encoded<v1::AgentDescription, v1::ShapePart, v1::AgentStates, v1::SimulatorClock,
              v1::Clearance, v1::EarliestIntersection, v1::CollisionEvent, v1::Rejection,
              v1::ServiceStatus, v1::SimulatorReport, v1::OperatorCommand, v1::ServiceHello,
              v1::SimulatorHello, v1::Watch, v1::AgentBreach, v1::ScreeningEvent>();
  std::string text;
  for (const auto& [name, sample] : found) text += name + " " + sample + "\n";
  EXPECT_EQ(found, Golden()) << "if the change is meant, raise WIRE_REVISION (collision.idl, "
                                "limits.h), and tests/idl/golden_samples.txt is:\n"
                             << text;
}

// The types of topics are those that have a key.
TEST(Encoding, GoldenSamplesAreThereForEveryTypeWithAKey) {
  const auto golden = Golden();
  for (const auto& [name, fields] : Idl().structs) {
    bool keyed = false;
    for (const IdlField& field : fields) keyed = keyed || field.key;
    EXPECT_EQ(golden.contains(name), keyed) << name;
  }
}

}  // namespace
}  // namespace collision
