// The participant, and the quality of service of readers and writers.
#include "bus.h"

#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

namespace example {
namespace {

const eprosima::fastrtps::Duration_t kLease(2, 0);
const eprosima::fastrtps::Duration_t kAnnouncement(0, 500'000'000);  // Well below the lease.
const eprosima::fastrtps::Duration_t kHeartbeat(0, 50'000'000);

template <typename Pointer>
Pointer Made(Pointer made, const std::string& what) {
  if (made == nullptr) throw std::runtime_error("Fast DDS made no " + what);
  return made;
}

/// What readers and writers share. Everything stands here, also what may be a default elsewhere.
template <typename Qos>
void SetQos(const Topic& topic, Qos* qos) {
  qos->reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
  qos->reliability().max_blocking_time = eprosima::fastrtps::Duration_t(0, 0);
  qos->durability().kind =
      topic.durable ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  qos->history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos->history().depth = topic.depth;
  // 0: no limit. The defaults, 10 instances and 5000 samples, lose what exceeds them without a
  // word; with LENGTH_UNLIMITED, which is -1, every write fails.
  qos->resource_limits().max_instances = 0;
  qos->resource_limits().max_samples = 0;
  qos->resource_limits().max_samples_per_instance = 0;
  qos->liveliness().kind = dds::AUTOMATIC_LIVELINESS_QOS;
  if (topic.leased) qos->liveliness().lease_duration = kLease;
  qos->ownership().kind = dds::SHARED_OWNERSHIP_QOS;
  qos->endpoint().history_memory_policy = eprosima::fastrtps::rtps::DYNAMIC_RESERVE_MEMORY_MODE;
  qos->data_sharing().off();
}

}  // namespace

Bus::Bus(std::uint32_t domain, const std::string& world, const std::string& simulator) {
  // The network is in the profile that FASTRTPS_DEFAULT_PROFILES_FILE names, not in the code.
  participant_ = Made(dds::DomainParticipantFactory::get_instance()->create_participant(
                          domain, dds::PARTICIPANT_QOS_DEFAULT),
                      "participant");
  dds::SubscriberQos reads = dds::SUBSCRIBER_QOS_DEFAULT;
  reads.partition().push_back(world.c_str());
  subscriber_ = Made(participant_->create_subscriber(reads), "subscriber");
  dds::PublisherQos writes = dds::PUBLISHER_QOS_DEFAULT;
  writes.partition().push_back((world + "." + simulator).c_str());
  publisher_ = Made(participant_->create_publisher(writes), "publisher");
}

Bus::~Bus() {
  participant_->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

dds::Topic* Bus::MakeTopic(const dds::TypeSupport& type, const Topic& topic) {
  type.register_type(participant_);
  return Made(participant_->create_topic(std::string("collision/v1/") + topic.name,
                                         type.get_type_name(), dds::TOPIC_QOS_DEFAULT),
              std::string("topic ") + topic.name);
}

dds::DataReader* Bus::MakeReader(const dds::TypeSupport& type, const Topic& topic) {
  dds::DataReaderQos qos = dds::DATAREADER_QOS_DEFAULT;
  SetQos(topic, &qos);
  dds::DataReader* reader = Made(subscriber_->create_datareader(MakeTopic(type, topic), qos),
                                 std::string("reader of ") + topic.name);
  reader->get_statuscondition().set_enabled_statuses(dds::StatusMask::data_available());
  waits_.attach_condition(reader->get_statuscondition());
  return reader;
}

dds::DataWriter* Bus::MakeWriter(const dds::TypeSupport& type, const Topic& topic) {
  dds::DataWriterQos qos = dds::DATAWRITER_QOS_DEFAULT;
  SetQos(topic, &qos);
  // With a lease and without this Fast DDS makes no writer.
  if (topic.leased) qos.liveliness().announcement_period = kAnnouncement;
  // What was lost is asked for after a heartbeat; the default is 3 s.
  qos.reliable_writer_qos().times.heartbeatPeriod = kHeartbeat;
  // A program that ends has not removed its agents: it disposes of them itself.
  qos.writer_data_lifecycle().autodispose_unregistered_instances = false;
  return Made(publisher_->create_datawriter(MakeTopic(type, topic), qos),
              std::string("writer of ") + topic.name);
}

void Bus::Wait(std::chrono::milliseconds timeout) {
  dds::ConditionSeq ready;
  const auto nanoseconds = std::chrono::nanoseconds(timeout).count();
  waits_.wait(ready, eprosima::fastrtps::Duration_t(
                         static_cast<std::int32_t>(nanoseconds / 1'000'000'000),
                         static_cast<std::uint32_t>(nanoseconds % 1'000'000'000)));
}

}  // namespace example
