#include "tests/faults/network.h"

#include <algorithm>

#include "idl/service_heard.h"

namespace collision::faults {
namespace {

/// How long a program that ends waits for what it wrote to arrive.
constexpr std::int64_t kLinger = kSecond;

bool OfSimulators(Topic topic) {
  return topic == Topic::kClock || topic == Topic::kDescription || topic == Topic::kShape ||
         topic == Topic::kStates || topic == Topic::kCommand;
}

/// What one service hears of another one.
v1::Input HeardOf(const v1::Output& output) {
  v1::Input input;
  if (output.has_collision_event()) {
    *input.mutable_event_heard() = output.collision_event();
    return input;
  }
  *input.mutable_service_heard() = collision::HeardOf(output.service_status());
  return input;
}

/// As it arrives: a description that was written with the removal comes before it.
void AddInput(const v1::Input& written, std::vector<v1::Input>* inputs) {
  if (!written.agent_removal().has_description()) return inputs->push_back(written);
  v1::Input description = written, removal = written;
  *description.mutable_agent_description() = written.agent_removal().description();
  removal.mutable_agent_removal()->clear_description();
  inputs->push_back(description);
  inputs->push_back(removal);
}

}  // namespace

void Network::At(std::int64_t time_ns, std::function<void()> action) {
  occurrences_.push({std::max(time_ns, now_ns_), ++order_, std::move(action)});
}

void Network::Run(std::int64_t until_ns) {
  while (!occurrences_.empty() && occurrences_.top().time_ns <= until_ns) {
    const Occurrence next = occurrences_.top();
    occurrences_.pop();
    now_ns_ = next.time_ns;
    next.action();
  }
  now_ns_ = std::max(now_ns_, until_ns);
}

std::int64_t Network::Delay() {
  const std::int64_t range = options_.delay_max_ns - options_.delay_min_ns + 1;
  std::int64_t delay =
      options_.delay_min_ns + static_cast<std::int64_t>(random_.Below(std::uint64_t(range)));
  while (options_.loss > 0 && random_.Chance(options_.loss)) {
    ++counters_.lost;
    delay += options_.resend_ns;
  }
  return delay;
}

Network::Id Network::Join(Role role, std::uint64_t simulator, std::function<void()> arrived) {
  const Id id = programs_.size() + 1;
  Program& program = programs_[id];
  program.role = role;
  program.simulator = simulator;
  program.arrived = std::move(arrived);
  for (const Id other : isolated_) {
    blocked_.insert({id, other});
    blocked_.insert({other, id});
  }
  for (const auto& [other, unused] : programs_) {
    if (other == id || unused.gone) continue;
    After(Delay(), [this, id, other = other] { Hear(id, other); });
    After(Delay(), [this, id, other = other] { Hear(other, id); });
  }
  return id;
}

void Network::Leave(Id id) {
  const std::int64_t linger =
      std::min(kLinger, 20 * options_.resend_ns + 2 * options_.delay_max_ns);
  After(linger, [this, id] {
    programs_[id].gone = true;
    for (const auto& [other, unused] : programs_) {
      if (unused.gone || blocked_.contains({id, other})) continue;
      After(options_.delay_max_ns, [this, id, other = other] {
        SetAlive(other, id, false);
        Forget(other, id);
      });
    }
    Kill(id);
  });
  programs_[id].arrived = nullptr;
}

void Network::Kill(Id id) {
  Program& program = programs_[id];
  program.gone = true;
  program.arrived = nullptr;
  program.writers.clear();
  program.waiting.clear();
  program.waits = 0;
  for (const auto& [other, unused] : programs_) {
    if (other != id && !unused.gone) FallSilent(other, id);
  }
}

void Network::Write(Id id, const v1::Input& message) {
  auto input = std::make_shared<v1::Input>(message);
  input->set_sender(id);
  if (message.has_simulator_clock()) {
    programs_[id].speaks_for.insert(message.simulator_clock().simulator_id());
  } else if (message.has_agent_description()) {
    programs_[id].speaks_for.insert(message.agent_description().simulator_id());
  }
  Write(id, {.address = AddressOf(message), .input = std::move(input), .output = nullptr},
        message.has_agent_removal() || message.has_shape_removal());
}

void Network::Write(Id id, const v1::Output& message) {
  if (message.has_service_status()) programs_[id].service = HeardOf(message);
  Write(id,
        {.address = AddressOf(message),
         .input = nullptr,
         .output = std::make_shared<v1::Output>(message)},
        false);
}

void Network::Write(Id id, Sample sample, bool disposes) {
  Program& program = programs_[id];
  if (program.gone) return;
  ++counters_.written;
  const auto topic = sample.address.topic;
  Writer& writer = program.writers[topic];
  sample.number = ++writer.written;
  std::deque<Sample>& history = writer.history[sample.address.instance];
  history.push_back(sample);
  if (history.size() > options_.depths[static_cast<std::size_t>(topic)].writer) history.pop_front();
  for (auto& [other, reader] : programs_) {
    if (other == id || reader.gone || !Reads(reader, topic)) continue;
    if (links_[{id, other}].matched) Transmit(id, other, sample);
  }
  // Who joins later hears of no removal.
  if (disposes && topic == Topic::kShape) writer.history.erase(sample.address.instance);
}

bool Network::Reads(const Program& reader, Topic topic) const {
  if (reader.role == Role::kService) {
    const bool is_event = topic == Topic::kContact || topic == Topic::kForecast;
    return OfSimulators(topic) || topic == Topic::kStatus || (is_event && reader.reads_events);
  }
  return !OfSimulators(topic);
}

bool Network::IsFor(const Program& reader, const Sample& sample) const {
  if (reader.role != Role::kSimulator || !sample.output) return true;
  const v1::Output& output = *sample.output;
  if (output.has_clearance()) return output.clearance().simulator_id() == reader.simulator;
  if (output.has_rejection()) return output.rejection().simulator_id() == reader.simulator;
  if (output.has_screening_event())
    return output.screening_event().simulator_id() == reader.simulator;
  return true;
}

bool Network::Stands(Id writer, const Sample& sample) const {
  const auto& writers = programs_.at(writer).writers;
  const auto topic = writers.find(sample.address.topic);
  if (topic == writers.end()) return false;
  const auto history = topic->second.history.find(sample.address.instance);
  return history != topic->second.history.end() && history->second.front().number <= sample.number;
}

void Network::Transmit(Id writer, Id reader, const Sample& sample) {
  Link& link = links_[{writer, reader}];
  Line& line = link.lines[sample.address.topic];
  const std::uint64_t lost_before = counters_.lost;
  const std::int64_t delay = Delay();
  line.last_arrival_ns = std::max(line.last_arrival_ns, now_ns_ + delay);
  const bool lost = counters_.lost > lost_before;
  At(line.last_arrival_ns, [this, writer, reader, sample, generation = link.generation, lost] {
    Arrive(writer, reader, sample, generation, lost);
  });
}

void Network::Arrive(Id writer, Id reader, const Sample& sample, std::uint64_t generation,
                     bool lost) {
  Link& link = links_[{writer, reader}];
  if (!link.matched || link.generation != generation || programs_[reader].gone) return;
  Line& line = link.lines[sample.address.topic];
  // What was lost is only sent again to a reader that can ask for it.
  const bool stuck = blocked_.contains({writer, reader}) ||
                     (lost && blocked_.contains({reader, writer})) || !line.held.empty();
  if (stuck) return line.held.push_back(sample);
  line.cut |= lost && programs_[writer].gone;
  if (line.cut) return;
  if (lost && !Stands(writer, sample)) {
    ++counters_.overwritten;
    return;
  }
  if (sample.number <= line.delivered) return;
  line.delivered = sample.number;
  if (!IsFor(programs_[reader], sample)) return;
  Deliver(reader, sample);
  if (!sample.input || !random_.Chance(options_.duplicate)) return;
  ++counters_.doubled;
  After(options_.resend_ns, [this, reader, sample] {
    if (!programs_[reader].gone) Deliver(reader, sample);
  });
}

void Network::Deliver(Id id, const Sample& sample) {
  Program& reader = programs_[id];
  std::deque<Sample>& waiting = reader.waiting[{sample.address.topic, sample.address.instance}];
  waiting.push_back(sample);
  ++reader.waits;
  ++counters_.delivered;
  // A removal and a sample are told apart also where they wait together.
  std::size_t depth = options_.depths[static_cast<std::size_t>(sample.address.topic)].reader;
  if (sample.address.topic == Topic::kDescription) depth = 2;
  if (waiting.size() > depth) {
    waiting.pop_front();
    --reader.waits;
    ++counters_.overwritten;
  }
  counters_.waiting_max = std::max(counters_.waiting_max, reader.waits);
  if (reader.arrived) reader.arrived();
}

bool Network::HasArrivals(Id id) const {
  const Program& program = programs_.at(id);
  return program.waits > 0 || !program.changes.empty();
}

void Network::Take(Id id, std::size_t limit, std::vector<v1::Input>* inputs,
                   std::vector<v1::Output>* outputs) {
  Program& program = programs_[id];
  std::size_t taken = 0;
  auto& waiting = program.waiting;
  for (auto place = waiting.begin(); place != waiting.end() && taken < limit;) {
    std::deque<Sample>& samples = place->second;
    for (; !samples.empty() && taken < limit; samples.pop_front(), ++taken) {
      const Sample& sample = samples.front();
      if (sample.input) {
        if (inputs != nullptr) AddInput(*sample.input, inputs);
      } else if (program.role == Role::kService) {
        inputs->push_back(HeardOf(*sample.output));
      } else if (outputs != nullptr) {
        outputs->push_back(*sample.output);
      }
    }
    place = samples.empty() ? waiting.erase(place) : std::next(place);
  }
  program.waits -= taken;
  // The end of a program is told after all that it wrote.
  if (inputs == nullptr || program.waits > 0) return;
  for (v1::Input& change : std::exchange(program.changes, {})) inputs->push_back(std::move(change));
}

bool Network::service_alive(Id id) const {
  for (const auto& [other, peer] : programs_.at(id).peers) {
    if (programs_.at(other).role == Role::kService && peer.known && peer.alive) return true;
  }
  return false;
}

void Network::Block(Id from, Id to) {
  if (blocked_.insert({from, to}).second) FallSilent(to, from);
}

void Network::Unblock(Id from, Id to) {
  if (blocked_.erase({from, to}) == 0) return;
  if (programs_[from].gone) return;
  ++programs_[to].peers[from].silence;
  After(Delay(), [this, from, to] { Hear(to, from); });
  // What was lost or held up on the way may be sent again now: there, and on the way back.
  for (const auto& [writer, reader] : {std::pair(from, to), std::pair(to, from)}) {
    for (auto& [topic, line] : links_[{writer, reader}].lines) {
      if (line.held.empty()) continue;
      After(Delay(), [this, writer = writer, reader = reader, topic = topic] {
        Release(writer, reader, topic);
      });
    }
  }
}

/// What is held arrives, in its order; until then whatever else arrives is held behind it.
void Network::Release(Id writer, Id reader, Topic topic) {
  if (blocked_.contains({writer, reader}) || blocked_.contains({reader, writer})) return;
  Link& link = links_[{writer, reader}];
  for (const Sample& sample : std::exchange(link.lines[topic].held, {})) {
    Arrive(writer, reader, sample, link.generation, true);
  }
}

void Network::Isolate(Id id) {
  isolated_.insert(id);
  for (const auto& [other, unused] : programs_) {
    if (other == id || unused.gone) continue;
    Block(id, other);
    Block(other, id);
  }
}

void Network::Rejoin(Id id) {
  isolated_.erase(id);
  for (const auto& [other, unused] : programs_) {
    Unblock(id, other);
    Unblock(other, id);
  }
}

void Network::Hear(Id listener, Id other) {
  if (programs_[listener].gone || programs_[other].gone) return;
  if (blocked_.contains({other, listener})) return;
  Peer& peer = programs_[listener].peers[other];
  if (!peer.known) {
    peer.known = true;
    const bool mutual = programs_[other].peers[listener].known;
    if (mutual) {
      Match(other, listener);
      Match(listener, other);
    }
  }
  SetAlive(listener, other, true);
}

void Network::FallSilent(Id listener, Id other) {
  const std::uint64_t silence = ++programs_[listener].peers[other].silence;
  After(options_.liveliness_lease_ns, [this, listener, other, silence] {
    if (programs_[listener].peers[other].silence == silence) SetAlive(listener, other, false);
  });
  After(options_.participant_lease_ns, [this, listener, other, silence] {
    if (programs_[listener].peers[other].silence == silence) Forget(listener, other);
  });
}

void Network::SetAlive(Id id, Id other, bool alive) {
  Program& listener = programs_[id];
  Peer& peer = listener.peers[other];
  if (listener.gone || peer.alive == alive) return;
  peer.alive = alive;
  const bool tells = !alive || std::exchange(peer.was_alive, true);
  if (listener.role == Role::kService && tells) {
    for (const std::uint64_t simulator : programs_[other].speaks_for) {
      v1::Input input;
      input.set_sender(other);
      input.mutable_liveliness()->set_simulator_id(simulator);
      input.mutable_liveliness()->set_alive(alive);
      listener.changes.push_back(input);
    }
  }
  if (tells && programs_[other].service) {
    listener.changes.push_back(*programs_[other].service);
    if (!alive) listener.changes.back().mutable_service_heard()->set_ended(true);
  }
  if (listener.arrived) listener.arrived();
}

void Network::Forget(Id listener, Id other) {
  programs_[listener].peers[other].known = false;
  Link& to_listener = links_[{other, listener}];
  to_listener.matched = false;
  to_listener.lines.clear();
  Link& from_listener = links_[{listener, other}];
  from_listener.matched = false;
  for (auto& [topic, line] : from_listener.lines) line.held.clear();
}

void Network::Match(Id writer, Id reader) {
  Link& link = links_[{writer, reader}];
  if (link.generation > 0) ++counters_.rematches;
  link.matched = true;
  ++link.generation;
  for (const auto& [topic, written] : programs_[writer].writers) {
    if (!Reads(programs_[reader], topic)) continue;
    std::vector<Sample> samples;
    const std::size_t depth = options_.depths[static_cast<std::size_t>(topic)].late_joiners;
    for (const auto& [instance, history] : written.history) {
      // What was disposed of is not there for who joins.
      if (!history.empty() && history.back().input && history.back().input->has_agent_removal()) {
        continue;
      }
      const std::size_t first = history.size() - std::min(history.size(), depth);
      samples.insert(samples.end(), history.begin() + std::ptrdiff_t(first), history.end());
    }
    std::sort(samples.begin(), samples.end(),
              [](const Sample& a, const Sample& b) { return a.number < b.number; });
    for (const Sample& sample : samples) Transmit(writer, reader, sample);
  }
}

}  // namespace collision::faults
