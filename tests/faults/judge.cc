#include "tests/faults/judge.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "client/library/network/conversion.h"
#include "idl/identity.h"
#include "tests/support/truth/ball_contacts.h"

namespace collision::faults {
namespace {

using client::Event;
using client::EventStatus;

struct Body {
  const SimulatorProgram* program;
  const Flown* flown;

  std::string Text() const {
    return program->options().name + "." + std::to_string(flown->id.slot);
  }
  bool Is(const client::AgentId& id) const {
    return id.slot == flown->id.slot && id.generation == flown->id.generation &&
           id.simulator == flown->id.simulator && program->runs().contains(id.run);
  }
};

/// One story: (service, epoch, contact) of a pair, as the monitor was told of it.
using StoryKey = std::tuple<std::uint64_t, std::uint32_t, std::uint32_t>;
using Stories = std::map<StoryKey, std::vector<const MonitoredEvent*>>;

/// A slot in one generation, whatever the run.
using Place = std::tuple<std::uint64_t, std::uint32_t, std::uint32_t>;
Place PlaceOf(const client::AgentId& id) { return {id.simulator, id.slot, id.generation}; }
/// What the monitor was told, by pair.
using Heard = std::map<std::pair<Place, Place>, std::vector<const MonitoredEvent*>>;

std::pair<Place, Place> PairOf(const client::AgentId& a, const client::AgentId& b) {
  return std::minmax(PlaceOf(a), PlaceOf(b));
}

bool Confirmed(EventStatus status) {
  return status == EventStatus::kConfirmed || status == EventStatus::kEnded;
}

class PairJudge {
 public:
  PairJudge(const Body& a, const Body& b, const Heard& heard, const JudgeOptions& options,
            Judgement* judgement)
      : a_(a), b_(b), options_(options), result_(*judgement) {
    const auto of_pair = heard.find(PairOf(a.flown->id, b.flown->id));
    if (of_pair == heard.end()) return;
    for (const MonitoredEvent* one : of_pair->second) {
      const Event event = client::FromMessage(one->event);
      if (!IsOfPair(event)) continue;
      const v1::ServiceStamp& stamp = one->event.stamp();
      stories_[{stamp.service_id(), stamp.epoch(), event.contact}].push_back(one);
    }
  }

  void Run() {
    const Flown &a = *a_.flown, &b = *b_.flown;
    const std::int64_t from = std::max(*a.added_ns, *b.added_ns);
    const std::int64_t to = std::min(EndOf(a_), EndOf(b_));
    if (from < to) {
      contacts_ = BallContacts(a.flight.motion, b.flight.motion, a.flight.radius + b.flight.radius,
                               from, to);
    }
    for (const BallContact& contact : contacts_) {
      if (contact.depth >= options_.grazing) JudgeContact(contact);
    }
    for (const auto& [key, story] : stories_) JudgeStory(story);
  }

 private:
  static std::int64_t EndOf(const Body& body) {
    return std::min(body.flown->removed_ns, body.program->reached_ns());
  }

  bool IsOfPair(const Event& event) const {
    return (a_.Is(event.lower) && b_.Is(event.higher)) ||
           (a_.Is(event.higher) && b_.Is(event.lower));
  }

  std::int64_t Rel(std::int64_t instant_ns) const {
    return instant_ns == client::kNever || instant_ns == kAlways ? instant_ns
                                                                 : instant_ns - options_.base_ns;
  }

  void Fail(std::uint64_t* count, const std::string& what) {
    ++*count;
    result_.failures.push_back(a_.Text() + " and " + b_.Text() + ": " + what);
  }

  /// Whether the event, as it stood, says that a contact may begin then.
  bool Covers(const Event& event, std::int64_t begin_ns) const {
    if (event.status == EventStatus::kDismissed) return false;
    const std::int64_t latest =
        Confirmed(event.status) ? event.begin.latest_ns : event.end.latest_ns;
    return Rel(event.begin.earliest_ns) <= begin_ns + options_.tolerance_ns &&
           begin_ns - options_.tolerance_ns <= Rel(latest);
  }

  void JudgeContact(const BallContact& contact) {
    ++result_.contacts;
    const std::int64_t begin = contact.begin_ns;
    const auto unserved = [begin](const auto& gap) {
      return gap.first <= begin && begin <= gap.second;
    };
    const bool may_be = std::none_of(options_.unserved.begin(), options_.unserved.end(), unserved);
    // Time is granted ahead, and promises reach so far: a change counts from there on.
    const bool counts =
        KnownFrom(*a_.flown, begin) <= begin && KnownFrom(*b_.flown, begin) <= begin;
    const bool is_served = may_be && counts;
    if (!is_served) ++result_.unserved;
    if (contact.begins_in_motion) {
      if (may_be) JudgeAnnouncement(begin, is_served);
      for (const Body* body : {&a_, &b_}) {
        if (counts) JudgeReliance(*body, begin, is_served);
      }
    }
    for (const auto& [key, story] : stories_) {
      const Event last = client::FromMessage(story.back()->event);
      if (!Confirmed(last.status) || !Covers(last, begin)) continue;
      ++result_.confirmed;
      return;
    }
  }

  /// The monitor or a program in it was told, and at a time of the world that is not after the
  /// begin if it is `served`. A forecast that a newer one replaces on its way never comes to the
  /// monitor.
  void JudgeAnnouncement(std::int64_t begin, bool served) {
    std::int64_t first = client::kNever;
    for (const auto& [key, story] : stories_) {
      for (const MonitoredEvent* heard : story) {
        const Event event = client::FromMessage(heard->event);
        if (Covers(event, begin)) first = std::min(first, Rel(event.now_ns));
      }
    }
    for (const Body* body : {&a_, &b_}) {
      for (const HeardEvent& heard : body->program->heard()) {
        if (!IsOfPair(heard.event) || !Covers(heard.event, begin)) continue;
        first = std::min(first, Rel(heard.event.now_ns));
      }
    }
    if (!served) {
      if (first == client::kNever) {
        Fail(&result_.untold, "contact at " + std::to_string(begin) + " ns, never told");
      }
      return;
    }
    if (first > begin + options_.tolerance_ns) {
      return Fail(&result_.late, "contact at " + std::to_string(begin) + " ns, announced at " +
                                     std::to_string(first));
    }
    result_.notice_least_s =
        std::min(result_.notice_least_s, 1e-9 * static_cast<double>(begin - first));
  }

  /// What the program heard of this contact before its own clock passed the begin, and what it
  /// relied on until then.
  void JudgeReliance(const Body& body, std::int64_t begin, bool is_served) {
    std::int64_t told_at = client::kNever;  // Virtual time.
    bool in_time = false;
    for (const HeardEvent& heard : body.program->heard()) {
      if (!IsOfPair(heard.event) || !Covers(heard.event, begin)) continue;
      told_at = std::min(told_at, heard.at_ns);
      in_time |= heard.world_ns <= begin + options_.tolerance_ns;
    }
    if (!in_time && is_served) {
      Fail(&result_.unheard, "contact at " + std::to_string(begin) + " ns, not heard in time by " +
                                 body.program->options().name);
    }
    // A promise is about the agents that were known, and as they were known.
    const std::int64_t known_from =
        std::max(KnownFrom(*a_.flown, begin), KnownFrom(*b_.flown, begin));
    const Reliance* last = nullptr;
    for (const Reliance& promise : body.flown->relied) {
      if (promise.world_ns >= begin || promise.at_ns >= told_at) break;
      last = &promise;
      if (!options_.lowered && promise.world_ns > known_from) JudgePromise(body, promise, begin);
    }
    // What was promised before counts until the contact is heard of.
    if (last != nullptr && !in_time) JudgePromise(body, *last, begin);
  }

  /// Calls back with each instant up to `begin` at which it was added, while others flew already,
  /// jumped or was described anew, and whether its program waited until others knew.
  template <typename Visit>
  static void VisitChanges(const Flown& flown, std::int64_t begin, const Visit& visit) {
    if (*flown.added_ns > 0) visit(*flown.added_ns, false);
    for (const std::int64_t jump : flown.flight.motion.jumps_ns) {
      if (*flown.added_ns < jump && jump <= begin) visit(jump, false);
    }
    for (const Declaration& declared : flown.flight.changes) {
      if (*flown.added_ns < declared.at_ns && declared.at_ns <= begin) {
        visit(declared.at_ns, true);
      }
    }
  }

  /// Since when others count it as it is at the begin.
  std::int64_t KnownFrom(const Flown& flown, std::int64_t begin) const {
    std::int64_t from = *flown.added_ns;
    VisitChanges(flown, begin, [&](std::int64_t at_ns, bool waited) {
      const auto told = flown.effective_ns.lower_bound(at_ns - options_.tolerance_ns);
      const bool has_left = flown.removed_ns != client::kNever;
      const std::int64_t never_told = has_left ? client::kNever : at_ns;
      const std::int64_t effective = told == flown.effective_ns.end() ? never_told : *told;
      const std::int64_t hearing = waited ? 0 : options_.hearing_ns;
      if (effective == client::kNever) from = client::kNever;
      if (from == client::kNever) return;
      from = std::max(from, std::max(at_ns, effective) + options_.tolerance_ns + hearing);
    });
    return from;
  }

  void JudgePromise(const Body& body, const Reliance& promise, std::int64_t begin) {
    ++result_.promises;
    if (promise.clear_until_ns <= begin + options_.tolerance_ns) return;
    Fail(&result_.relied, "contact at " + std::to_string(begin) + " ns; at " +
                              std::to_string(promise.world_ns) + " " + body.Text() +
                              " was clear until " + std::to_string(promise.clear_until_ns));
  }

  void JudgeStory(const std::vector<const MonitoredEvent*>& story) {
    for (const MonitoredEvent* heard : story) {
      const Event event = client::FromMessage(heard->event);
      if (Confirmed(event.status)) JudgeConfirmed(event);
    }
    const Event last = client::FromMessage(story.back()->event);
    if (!Confirmed(last.status)) return;
    result_.begin_width_s =
        std::max(result_.begin_width_s,
                 1e-9 * static_cast<double>(last.begin.latest_ns - last.begin.earliest_ns));
  }

  bool Holds(const client::TimeBracket& bracket, std::int64_t t_ns) const {
    return Rel(bracket.earliest_ns) <= t_ns + options_.tolerance_ns &&
           t_ns - options_.tolerance_ns <= Rel(bracket.latest_ns);
  }

  void JudgeConfirmed(const Event& event) {
    const std::int64_t certified = Rel(event.begin.latest_ns);
    const auto is_in = [&](const BallContact& contact) {
      return contact.begin_ns - options_.tolerance_ns <= certified &&
             certified <= contact.end_ns + options_.tolerance_ns;
    };
    const auto found = std::find_if(contacts_.begin(), contacts_.end(), is_in);
    if (found == contacts_.end()) {
      return Fail(&result_.untrue, "confirmed at " + std::to_string(certified) + " ns, untrue");
    }
    if (found->begins_in_motion && !event.began_before && !Holds(event.begin, found->begin_ns)) {
      Fail(&result_.wrong_brackets,
           "begin " + std::to_string(found->begin_ns) + " ns is not in the bracket");
    }
    const bool by_service = !event.because.empty() && event.because != "left";
    if (event.status != EventStatus::kEnded || by_service) return;
    const auto ends = [&](const BallContact& contact) {
      return contact.end_ns >= found->begin_ns &&
             (!contact.ends_in_motion || Holds(event.end, contact.end_ns));
    };
    if (std::none_of(contacts_.begin(), contacts_.end(), ends)) {
      Fail(&result_.wrong_brackets, "end " + std::to_string(found->end_ns) +
                                        " ns is not in the bracket [" +
                                        std::to_string(Rel(event.end.earliest_ns)) + ", " +
                                        std::to_string(Rel(event.end.latest_ns)) + "], begin " +
                                        std::to_string(found->begin_ns) + " in [" +
                                        std::to_string(Rel(event.begin.earliest_ns)) + ", " +
                                        std::to_string(Rel(event.begin.latest_ns)) + "]");
    }
  }

  const Body &a_, &b_;
  const JudgeOptions& options_;
  Judgement& result_;
  Stories stories_;
  std::vector<BallContact> contacts_;
};

}  // namespace

Judgement Judge(const std::vector<const SimulatorProgram*>& programs, const MonitorProgram& monitor,
                const JudgeOptions& options) {
  Judgement judgement;
  std::vector<Body> bodies;
  for (const SimulatorProgram* program : programs) {
    for (const Flown& flown : program->flown()) {
      if (flown.added_ns) bodies.push_back({program, &flown});
    }
  }
  Heard heard;
  for (const MonitoredEvent& one : monitor.heard()) {
    const Event event = client::FromMessage(one.event);
    heard[PairOf(event.lower, event.higher)].push_back(&one);
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t j = i + 1; j < bodies.size(); ++j) {
      PairJudge(bodies[i], bodies[j], heard, options, &judgement).Run();
    }
  }
  return judgement;
}

}  // namespace collision::faults
