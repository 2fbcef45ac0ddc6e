// The DDS side of both programs: a participant, and readers and writers with the quality of service
// that the topics have (idl/README.md, Topics).
#pragma once

#include <chrono>
#include <cstdint>
#include <fastdds/dds/core/condition/WaitSet.hpp>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace example {

namespace dds = eprosima::fastdds::dds;

/// What differs from topic to topic: the rest is reliable and keep-last.
struct Topic {
  const char* name;  ///< What follows "collision/v1/".
  int depth;         ///< Of the history of each key.
  bool durable;      ///< Transient-local; else volatile.
  bool leased;       ///< The silence of a writer is noticed after 2 s.
};

// The rows of idl/README.md that these programs need.
inline constexpr Topic kServiceHello{"hello", 1, true, false};
inline constexpr Topic kSimulatorHello{"simulator_hello", 1, true, false};
inline constexpr Topic kAgentDescription{"agent_description", 1, true, false};
inline constexpr Topic kAgentStates{"agent_states", 1, true, false};
inline constexpr Topic kSimulatorClock{"simulator_clock", 1, true, true};
inline constexpr Topic kClearance{"clearance", 1, true, false};
inline constexpr Topic kContact{"contact", 32768, true, false};
inline constexpr Topic kForecast{"forecast", 2, true, false};
inline constexpr Topic kRejection{"rejection", 64, false, false};
inline constexpr Topic kSimulatorReport{"simulator_report", 1, true, false};
inline constexpr Topic kServiceStatus{"service_status", 1, true, true};

class Bus {
 public:
  /// Reads in the partition `world`; writes in "WORLD.SIMULATOR".
  Bus(std::uint32_t domain, const std::string& world, const std::string& simulator);
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;
  ~Bus();

  dds::DataReader* MakeReader(const dds::TypeSupport& type, const Topic& topic);
  dds::DataWriter* MakeWriter(const dds::TypeSupport& type, const Topic& topic);

  /// Returns when a reader has something, or after `timeout`.
  void Wait(std::chrono::milliseconds timeout);

 private:
  dds::Topic* MakeTopic(const dds::TypeSupport& type, const Topic& topic);

  dds::DomainParticipant* participant_ = nullptr;
  dds::Subscriber* subscriber_ = nullptr;
  dds::Publisher* publisher_ = nullptr;
  dds::WaitSet waits_;
};

/// `PubSubType` is what fastddsgen made of the sample's type: CollisionEventPubSubType.
template <typename PubSubType>
class Reader {
 public:
  using Sample = typename PubSubType::type;

  Reader(Bus& bus, const Topic& topic)
      : reader_(bus.MakeReader(dds::TypeSupport(new PubSubType), topic)) {}

  /// Everything that has come. Disposals are left out: the service has none.
  std::vector<Sample> Take() {
    std::vector<Sample> samples;
    Sample sample;
    dds::SampleInfo info;
    while (reader_->take_next_sample(&sample, &info) ==
           eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
      if (info.valid_data) samples.push_back(sample);
    }
    return samples;
  }

  /// How many writers live, by their leases.
  int writers_alive() {
    dds::LivelinessChangedStatus status;
    reader_->get_liveliness_changed_status(status);
    return status.alive_count;
  }

 private:
  dds::DataReader* reader_;
};

template <typename PubSubType>
class Writer {
 public:
  using Sample = typename PubSubType::type;

  Writer(Bus& bus, const Topic& topic)
      : name_(topic.name), writer_(bus.MakeWriter(dds::TypeSupport(new PubSubType), topic)) {}

  void Write(Sample sample) {
    if (!writer_->write(&sample)) throw std::runtime_error("cannot write to " + name_);
  }

  /// What goes out is the key alone.
  void Dispose(Sample sample) {
    if (writer_->dispose(&sample, dds::HANDLE_NIL) !=
        eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
      throw std::runtime_error("cannot dispose of a key of " + name_);
    }
  }

  /// Until every reader has acknowledged all of it; at most two seconds.
  void Flush() { writer_->wait_for_acknowledgments(eprosima::fastrtps::Duration_t(2, 0)); }

 private:
  std::string name_;
  dds::DataWriter* writer_;
};

}  // namespace example
