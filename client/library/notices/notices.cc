#include "client/library/notices/notices.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <utility>

#include "collision/event_text.h"

namespace collision::client {
namespace {

const char* ModeText(bool lock_step) { return lock_step ? "lock-step" : "real time"; }

std::string Quoted(const std::string& text) { return "\"" + text + "\""; }

/// What was refused that is of no agent.
std::string TopicText(const std::string& topic) {
  if (topic == "TOPIC_SIMULATOR_CLOCK") return "this simulator's clock";
  if (topic == "TOPIC_SHAPE") return "a shape";
  return topic;
}

std::string Joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : ", ") + text;
  return all;
}

}  // namespace

std::string NetworkProfileText() {
  const char* uri = std::getenv("CYCLONEDDS_URI");
  if (uri == nullptr || *uri == '\0') return "no network profile, CYCLONEDDS_URI is not set";
  return "network profile " + std::string(uri);
}

std::string PlaceText(const std::string& world, std::uint32_t domain) {
  return "world " + Quoted(world) + ", DDS domain " + std::to_string(domain) + ", " +
         NetworkProfileText();
}

const char* Name(NoticeKind kind) {
  switch (kind) {
    case NoticeKind::kNoService:
      return "no service";
    case NoticeKind::kWrongClock:
      return "wrong clock";
    case NoticeKind::kWaiting:
      return "waiting";
    case NoticeKind::kRefused:
      return "refused";
    case NoticeKind::kNameTaken:
      return "name taken";
    case NoticeKind::kEnded:
      return "ended";
    case NoticeKind::kBreach:
      return "breach";
    case NoticeKind::kCredentials:
      return "credentials";
  }
  return "unknown";
}

bool Notices::Lasting::Lasts(const std::string& cause, Time now, std::chrono::seconds after) {
  if (!since_) since_ = now;
  if (now - *since_ < after) return false;
  const bool again = told_ && now - *told_ >= kNoticeAgain;
  // What flickers between causes is not told more often than it is when it begins.
  const bool other = told_ && cause != cause_ && now - *told_ >= after;
  if (told_ && !again && !other) return false;
  told_ = now;
  cause_ = cause;
  return true;
}

bool Notices::Lasting::Ends() {
  since_.reset();
  cause_.clear();
  return std::exchange(told_, std::nullopt).has_value();
}

std::chrono::seconds Notices::Lasting::Since(Time now) const {
  return std::chrono::duration_cast<std::chrono::seconds>(now - since_.value_or(now));
}

void Notices::Look(const Situation& situation, Time now) {
  LookForService(situation, now);
  const bool fits = LookAtClock(situation, now);
  if (!situation.other_program.empty()) {
    if (name_taken_.Lasts("", now, std::chrono::seconds(0))) {
      Tell(NoticeKind::kNameTaken, situation.other_program);
    }
  } else if (name_taken_.Ends()) {
    Tell(NoticeKind::kNameTaken, "the name " + Quoted(facts_.simulator) + " is free now", true);
  }
  if (!situation.ended.empty() && ended_.Lasts("", now, std::chrono::seconds(0))) {
    Tell(NoticeKind::kEnded, situation.ended);
  }
  // Who is not served for another reason has heard that one.
  if (fits && situation.service_heard && situation.other_program.empty() &&
      situation.ended.empty()) {
    LookAtGrant(situation, now);
    LookAtStep(situation, now);
  } else {
    waiting_ = {};
    step_ns_.reset();
  }
}

void Notices::LookForService(const Situation& situation, Time now) {
  const std::string world =
      "world " + Quoted(facts_.world) + " on DDS domain " + std::to_string(facts_.domain);
  if (situation.service_heard) {
    if (no_service_.Ends())
      Tell(NoticeKind::kNoService, "the service of " + world + " is heard", true);
    return;
  }
  if (!no_service_.Lasts("", now, kNoticeAfter)) return;
  Tell(NoticeKind::kNoService, "no service of " + world + " has been heard for " +
                                   std::to_string(no_service_.Since(now).count()) +
                                   " s: does collisiond run, with the same world, domain, "
                                   "CYCLONEDDS_URI and authority of credentials? Here is " +
                                   NetworkProfileText() + "; collisionctl --world " + facts_.world +
                                   " --domain " + std::to_string(facts_.domain) +
                                   " doctor finds what is wrong");
}

bool Notices::LookAtClock(const Situation& situation, Time now) {
  if (!situation.world_lock_step || *situation.world_lock_step == facts_.lock_step) {
    if (wrong_clock_.Ends()) {
      Tell(NoticeKind::kWrongClock,
           "the world runs in " + std::string(ModeText(facts_.lock_step)) + " now, too", true);
    }
    return true;
  }
  if (!wrong_clock_.Lasts("", now, std::chrono::seconds(0))) return false;
  const bool lock_step = facts_.lock_step;
  Tell(NoticeKind::kWrongClock,
       "this simulator runs in " + std::string(ModeText(lock_step)) + ", but world " +
           Quoted(facts_.world) + " runs in " + ModeText(!lock_step) +
           ": start the simulator with " + (lock_step ? "--real-time" : "--lock-step") +
           " (WorldOptions::lock_step = " + (lock_step ? "false" : "true") +
           "), or collisiond with clock { kind: " + (lock_step ? "LOCK_STEP" : "REAL_TIME") + " }");
  return false;
}

void Notices::LookAtGrant(const Situation& situation, Time now) {
  const bool stands = granted_ns_ == situation.granted_until_ns;
  if (!situation.waits || !stands) {
    if (waiting_.Ends()) Tell(NoticeKind::kWaiting, "the world's time goes on", true);
    granted_ns_ = situation.granted_until_ns;
    if (!situation.waits) return;
  }
  std::vector<std::string> names = situation.waiting_for;
  std::erase(names, facts_.simulator);
  std::string cause = Joined(names);
  std::string whom = cause;
  if (names.empty() && situation.laggard) {
    whom = "the other simulators; furthest behind is " + situation.laggard->name + ", at " +
           InstantText(situation.laggard->clock_ns, 0, 3);
    cause = situation.laggard->name;
  } else if (names.empty()) {
    whom = "the service, which names no simulator; see collisionctl status";
  }
  if (!waiting_.Lasts(cause, now, kNoticeAfter)) return;
  const std::int64_t until_ns = situation.granted_until_ns;
  const std::string stays =
      until_ns == std::numeric_limits<std::int64_t>::min()
          ? "the world's time has not begun for "
          : "the world's time stands at " + InstantText(until_ns, 0, 3) + " for ";
  Tell(NoticeKind::kWaiting,
       stays + std::to_string(waiting_.Since(now).count()) + " s: it waits for " + whom);
}

/// Time goes on, but the step is far ahead: without a word the program would seem to hang.
void Notices::LookAtStep(const Situation& situation, Time now) {
  if (!situation.waits || situation.granted_until_ns >= situation.next_ns) {
    step_ns_.reset();
    return;
  }
  if (step_ns_ != situation.next_ns) long_step_ = {};
  step_ns_ = situation.next_ns;
  if (waiting_.Since(now) >= kNoticeAfter) return;  // It stands, and LookAtGrant() has said so.
  if (!long_step_.Lasts("", now, kNoticeAfter)) return;
  std::string text = "the next step of this simulator is at " + InstantText(*step_ns_, 0, 3) +
                     ", and the world's time, which goes on, has come to " +
                     InstantText(situation.granted_until_ns, 0, 3);
  if (situation.laggard) {
    text += "; furthest behind is " + situation.laggard->name + ", at " +
            InstantText(situation.laggard->clock_ns, 0, 3);
  }
  Tell(NoticeKind::kWaiting, text);
}

void Notices::Refuse(const Rejection& rejection, const std::string& agent) {
  // Said in words of their own: the name is another program's, the clock of the other kind.
  if (rejection.reason == "REJECTED_ID_OWNED" || rejection.field == "lock_step" ||
      rejection.field == "clock_kind") {
    return;
  }
  const std::string cause = rejection.reason + " " + rejection.field;
  if (refusals_.size() == kRefusalsToldMax || !refusals_.insert(cause).second) return;
  Tell(NoticeKind::kRefused,
       "the service refuses " +
           (agent.empty() ? TopicText(rejection.topic) : "agent " + Quoted(agent)) + ": " +
           rejection.field + ": " + rejection.detail + " (" + rejection.reason + "; told once)");
}

void Notices::Breach(const client::Breach& breach, const std::string& agent, Time now) {
  const std::pair cause(agent, breach.field);
  const auto told = breaches_.find(cause);
  const bool is_new = told == breaches_.end();
  if (is_new ? breaches_.size() == kBreachesToldMax : now - told->second < kNoticeAgain) return;
  breaches_[cause] = now;
  const auto name = [&agent](const AgentId&) { return agent; };
  Tell(NoticeKind::kBreach, BreachText(breach, name, 0) + "; see client/BOUNDS.md");
}

void Notices::SkewedClock(std::int64_t since_ns) {
  if (std::exchange(skew_told_, true)) return;
  const std::string since = since_ns == std::numeric_limits<std::int64_t>::min()
                                ? ""
                                : ", from " + InstantText(since_ns, 0, 3) + " on";
  Tell(NoticeKind::kBreach,
       "the service finds this simulator's clock off by more than its clock.skew_max_s: promises "
       "about its agents are void" +
           since);
}

void Notices::Credentials(const std::string& warning) { Tell(NoticeKind::kCredentials, warning); }

std::optional<Notice> Notices::Take() {
  if (notices_.empty()) return std::nullopt;
  Notice notice = std::move(notices_.front());
  notices_.pop_front();
  return notice;
}

void Notices::Tell(NoticeKind kind, const std::string& text, bool over) {
  notices_.push_back({kind, over, text});
}

}  // namespace collision::client
