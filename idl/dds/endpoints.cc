#include "idl/dds/endpoints.h"

#include <algorithm>
#include <vector>

namespace collision::dds {
namespace {

/// The QoS of both ends of a topic. Readers ask for reliability, too: their default is best effort.
Qos TopicQos(const TopicRow& row, int depth) {
  Qos qos = MakeQos();
  // A keep-last writer overwrites instead of waiting for a slow reader, so there is nothing to wait
  // for: 0.
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, 0);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, depth);
  dds_qset_durability(qos.get(), row.late_joiners_depth > 0 ? DDS_DURABILITY_TRANSIENT_LOCAL
                                                            : DDS_DURABILITY_VOLATILE);
  return qos;
}

Qos WriterQos(const TopicRow& row, dds_duration_t lease) {
  Qos qos = TopicQos(row, row.writer_depth);
  // A program that ends, however it ends, has not removed anything: only a dispose does.
  dds_qset_writer_data_lifecycle(qos.get(), false);
  if (row.late_joiners_depth > 1) {
    // What a late joiner gets is the history of the durability service, by default 1 sample.
    dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, row.late_joiners_depth,
                                DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  }
  if (row.source == Source::kOperators) dds_qset_lifespan(qos.get(), kCommandLifespan);
  if (row.leased) dds_qset_liveliness(qos.get(), DDS_LIVELINESS_AUTOMATIC, lease);
  return qos;
}

/// Some vendors watch a writer's lease only for readers that ask for one: so the reader of the
/// status does, and the service's lease must not be longer. Simulators have leases of any length.
Qos ReaderQos(const TopicRow& row) {
  Qos qos = TopicQos(row, row.reader_depth);
  if (row.id == TopicId::kServiceStatus) {
    dds_qset_liveliness(qos.get(), DDS_LIVELINESS_AUTOMATIC, kServiceLeaseMax.count());
  }
  return qos;
}

class Builder {
 public:
  Builder(dds_entity_t participant, dds_duration_t lease)
      : participant_(participant), lease_(lease) {}

  /// `inbox`: null, the readers keep their samples themselves.
  void Read(Source source, const std::string& partition, const dds_listener_t* listener,
            Inbox* inbox, const std::vector<TopicId>& left_out = {}) {
    Qos qos = MakeQos();
    dds_qset_partition1(qos.get(), partition.c_str());
    const dds_entity_t subscriber =
        Check(dds_create_subscriber(participant_, qos.get(), nullptr), "DDS subscriber");
    for (const TopicRow& row : Topics()) {
      if (row.source != source || std::ranges::count(left_out, row.id) > 0) continue;
      // Of a service its status tells.
      const bool listens = source != Source::kService || row.id == TopicId::kServiceStatus;
      Read(row, subscriber, ReaderQos(row), listens ? listener : nullptr, inbox);
    }
  }

  /// What other services of the world say of themselves, and of contacts.
  void ReadOtherServices(const std::string& partition, bool with_events,
                         const dds_listener_t* listener) {
    Qos qos = MakeQos();
    dds_qset_partition1(qos.get(), partition.c_str());
    const dds_entity_t subscriber =
        Check(dds_create_subscriber(participant_, qos.get(), nullptr), "DDS subscriber");
    for (const TopicId topic : {TopicId::kServiceStatus, TopicId::kContact, TopicId::kForecast}) {
      const bool is_status = topic == TopicId::kServiceStatus;
      if (!is_status && !with_events) continue;
      Qos others = ReaderQos(Row(topic));
      dds_qset_ignorelocal(others.get(), DDS_IGNORELOCAL_PARTICIPANT);
      Read(Row(topic), subscriber, std::move(others), is_status ? listener : nullptr, nullptr);
    }
  }

  void Write(Source source, const std::string& partition) {
    Qos qos = MakeQos();
    dds_qset_partition1(qos.get(), partition.c_str());
    const dds_entity_t publisher =
        Check(dds_create_publisher(participant_, qos.get(), nullptr), "DDS publisher");
    for (const TopicRow& row : Topics()) {
      if (row.source != source) continue;
      endpoints_.writers[Index(row)] =
          Check(dds_create_writer(publisher, Topic(row), WriterQos(row, lease_).get(), nullptr),
                std::string("DDS writer of ") + row.name);
    }
  }

  Endpoints endpoints() const { return endpoints_; }

 private:
  void Read(const TopicRow& row, dds_entity_t subscriber, Qos qos, const dds_listener_t* listener,
            Inbox* inbox) {
    const dds_entity_t topic = Topic(row);
    const bool keeps_place = row.id == TopicId::kSimulatorClock;  // they are written all the time
    const dds_entity_t reader =
        inbox == nullptr
            ? dds_create_reader(subscriber, topic, qos.get(), listener)
            : dds_create_reader_rhc(subscriber, topic, qos.get(), listener,
                                    inbox->MakeHistory(Index(row), Depth(row), keeps_place));
    endpoints_.readers[Index(row)] = Check(reader, std::string("DDS reader of ") + row.name);
  }

  static std::size_t Depth(const TopicRow& row) {
    return static_cast<std::size_t>(row.reader_depth);
  }

  static std::size_t Index(const TopicRow& row) { return static_cast<std::size_t>(row.id); }

  dds_entity_t Topic(const TopicRow& row) {
    return Check(dds_create_topic(participant_, row.type, row.name, nullptr, nullptr),
                 std::string("DDS topic ") + row.name);
  }

  const dds_entity_t participant_;
  const dds_duration_t lease_;
  Endpoints endpoints_;
};

}  // namespace

Endpoints MakeEndpoints(dds_entity_t participant, const Partitions& partitions,
                        dds_duration_t lease, const dds_listener_t* listener, Inbox* inbox) {
  Builder builder(participant, lease);
  const Partitions& p = partitions;
  if (p.read_of_simulators)
    builder.Read(Source::kSimulators, *p.read_of_simulators, listener, inbox);
  if (p.read_of_service) {
    std::vector<TopicId> left_out;
    if (!p.read_earliest) left_out.push_back(TopicId::kEarliestIntersection);
    if (!p.read_screening) left_out.push_back(TopicId::kScreening);
    for (const TopicRow& row : Topics()) {
      const bool is_status = row.id == TopicId::kServiceStatus || row.id == TopicId::kServiceHello;
      if (p.read_status_alone && !is_status) left_out.push_back(row.id);
    }
    builder.Read(Source::kService, *p.read_of_service, listener, nullptr, left_out);
  }
  if (p.read_of_other_services) {
    builder.ReadOtherServices(*p.read_of_other_services, p.read_events_of_other_services, listener);
  }
  if (p.write_as_service) builder.Write(Source::kService, *p.write_as_service);
  if (p.write_as_simulator) builder.Write(Source::kSimulators, *p.write_as_simulator);
  if (p.read_of_operators) builder.Read(Source::kOperators, *p.read_of_operators, nullptr, nullptr);
  if (p.write_as_operator) builder.Write(Source::kOperators, *p.write_as_operator);
  if (p.read_of_watchers) builder.Read(Source::kWatchers, *p.read_of_watchers, nullptr, nullptr);
  if (p.write_as_watcher) builder.Write(Source::kWatchers, *p.write_as_watcher);
  return builder.endpoints();
}

}  // namespace collision::dds
