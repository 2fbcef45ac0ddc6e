#include "tests/simulation/contact_checker.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "tests/support/truth/ball_contacts.h"

namespace collision::server {
namespace {

using PairKey = std::tuple<detection::AgentId, detection::AgentId>;

/// One contact as the service published it: when it first did, and the last revision.
struct Story {
  std::int64_t first_now_ns = 0;
  v1::CollisionEvent last;
};

struct Body {
  detection::AgentId id;
  const SimulatedAgent* agent;
};

detection::AgentId ToId(const v1::AgentId& wire) {
  return {wire.simulator_id(), wire.slot(), wire.run(), wire.generation()};
}

std::map<PairKey, std::map<std::uint32_t, Story>> StoriesOf(
    const std::vector<v1::Output>& published) {
  std::map<PairKey, std::map<std::uint32_t, Story>> stories;
  for (const v1::Output& output : published) {
    if (!output.has_collision_event()) continue;
    const v1::CollisionEvent& event = output.collision_event();
    auto& contacts = stories[{ToId(event.lower()), ToId(event.higher())}];
    const auto [story, added] = contacts.try_emplace(event.contact());
    if (added) story->second.first_now_ns = event.now_ns();
    story->second.last = event;
  }
  return stories;
}

bool Confirmed(const v1::CollisionEvent& event) {
  return event.status() == v1::EVENT_CONFIRMED || event.status() == v1::EVENT_ENDED;
}

bool Holds(const v1::TimeBracket& bracket, std::int64_t t_ns, std::int64_t tolerance_ns) {
  return bracket.earliest_ns() <= t_ns + tolerance_ns && t_ns - tolerance_ns <= bracket.latest_ns();
}

std::string Show(const Body& a, const Body& b, const BallContact& contact) {
  return "slots " + std::to_string(a.id.slot) + " and " + std::to_string(b.id.slot) +
         " touch in [" + std::to_string(contact.begin_ns) + ", " + std::to_string(contact.end_ns) +
         "] ns, " + std::to_string(contact.depth) + " m deep";
}

/// The story that covers the contact: its begin bracket, or all that is not certified free, holds
/// the begin.
const Story* Find(const std::map<std::uint32_t, Story>& stories, const BallContact& contact,
                  std::int64_t tolerance_ns) {
  for (const auto& [number, story] : stories) {
    const v1::CollisionEvent& event = story.last;
    if (event.status() == v1::EVENT_DISMISSED) continue;
    if (Confirmed(event) ? Holds(event.begin(), contact.begin_ns, tolerance_ns)
                         : event.begin().earliest_ns() <= contact.begin_ns + tolerance_ns &&
                               contact.begin_ns - tolerance_ns <= event.end().latest_ns()) {
      return &story;
    }
  }
  return nullptr;
}

/// What was promised to each agent, and when.
struct Promise {
  std::int64_t now_ns;
  std::int64_t clear_until_ns;
};
using Promises = std::map<detection::AgentId, std::vector<Promise>>;

Promises PromisesOf(const std::vector<v1::Output>& published) {
  Promises promises;
  for (const v1::Output& output : published) {
    if (!output.has_clearance()) continue;
    const v1::Clearance& sample = output.clearance();
    for (const v1::AgentClearance& agent : sample.agents()) {
      promises[{sample.simulator_id(), agent.slot(), sample.run(), agent.generation()}].push_back(
          {sample.now_ns(), agent.clear_until_ns()});
    }
  }
  return promises;
}

/// The last admission or jump of the agent up to `before_ns`: no earlier promise can know of it.
std::int64_t LastSurprise(const Body& body, std::int64_t before_ns) {
  std::int64_t last = body.agent->from_ns;
  for (const std::int64_t jump : body.agent->motion.jumps_ns) {
    if (jump <= before_ns) last = std::max(last, jump);
  }
  return last;
}

/// One true contact of a pair.
struct PairContact {
  const Body& a;
  const Body& b;
  const BallContact& contact;
};

/// `announced_ns`: when the service first announced the contact.
void CheckPromises(const PairContact& pair, std::int64_t announced_ns, const Promises& promises,
                   CheckerResult* result) {
  const auto& [a, b, contact] = pair;
  const std::int64_t known_from =
      std::max(LastSurprise(a, contact.begin_ns), LastSurprise(b, contact.begin_ns));
  for (const detection::AgentId& id : {a.id, b.id}) {
    const auto known = promises.find(id);
    if (known == promises.end()) continue;
    for (const Promise& promise : known->second) {
      const bool binds = promise.now_ns > known_from && promise.now_ns < contact.begin_ns &&
                         promise.now_ns < announced_ns;
      if (!binds) continue;
      ++result->promises;
      if (promise.clear_until_ns <= contact.begin_ns) continue;
      result->violations.push_back(Show(a, b, contact) + ": at " + std::to_string(promise.now_ns) +
                                   " slot " + std::to_string(id.slot) + " was clear until " +
                                   std::to_string(promise.clear_until_ns));
      return;
    }
  }
}

void CheckContact(const PairContact& pair, const std::map<std::uint32_t, Story>& stories,
                  const Promises& promises, const CheckerOptions& options, CheckerResult* result) {
  const BallContact& contact = pair.contact;
  const auto violate = [&](const std::string& what) {
    result->violations.push_back(Show(pair.a, pair.b, contact) + ": " + what);
  };
  ++result->contacts;
  const Story* story = Find(stories, contact, options.time_tolerance_ns);
  if (contact.begins_in_motion) {
    const std::int64_t announced_ns =
        story == nullptr ? std::numeric_limits<std::int64_t>::max() : story->first_now_ns;
    CheckPromises(pair, announced_ns, promises, result);
  }
  if (story == nullptr) {
    // What began by a jump or an admission begins for the service when it saw it.
    if (contact.begins_in_motion) violate("no event holds its begin");
    return;
  }
  if (contact.begins_in_motion &&
      story->first_now_ns > contact.begin_ns + options.time_tolerance_ns) {
    violate("announced only at " + std::to_string(story->first_now_ns));
  }
  if (!Confirmed(story->last)) return;
  ++result->confirmed;
  const v1::TimeBracket& begin = story->last.begin();
  result->begin_width_greatest =
      std::max(result->begin_width_greatest,
               static_cast<double>(begin.latest_ns() - begin.earliest_ns()) * 1e-9);
  if (contact.ends_in_motion && story->last.status() == v1::EVENT_ENDED &&
      !Holds(story->last.end(), contact.end_ns, options.time_tolerance_ns)) {
    violate("its end is not in [" + std::to_string(story->last.end().earliest_ns()) + ", " +
            std::to_string(story->last.end().latest_ns()) + "]");
  }
}

/// A confirmed event without a contact that touches its certified part is false.
void CheckConfirmed(const Body& a, const Body& b, const std::vector<BallContact>& contacts_true,
                    const std::map<std::uint32_t, Story>& stories, CheckerResult* result) {
  for (const auto& [number, story] : stories) {
    if (!Confirmed(story.last)) continue;
    const std::int64_t certified = story.last.begin().latest_ns();
    const bool is_true =
        std::any_of(contacts_true.begin(), contacts_true.end(), [&](const BallContact& m) {
          return m.begin_ns - 100 <= certified && certified <= m.end_ns + 100;
        });
    if (is_true) continue;
    result->violations.push_back("slots " + std::to_string(a.id.slot) + " and " +
                                 std::to_string(b.id.slot) + ": confirmed in contact at " +
                                 std::to_string(certified) + ", and are not");
  }
}

}  // namespace

CheckerResult CheckContacts(const std::vector<const SimulatedSimulator*>& simulators,
                            const std::vector<v1::Output>& published, std::int64_t end_ns,
                            const CheckerOptions& options) {
  CheckerResult result;
  const auto stories = StoriesOf(published);
  const Promises promises = PromisesOf(published);
  std::vector<Body> bodies;
  for (const SimulatedSimulator* simulator : simulators) {
    for (std::uint32_t slot = 0; slot < simulator->agents().size(); ++slot) {
      bodies.push_back({simulator->AgentAt(slot), &simulator->agents()[slot]});
    }
  }
  std::sort(bodies.begin(), bodies.end(), [](const Body& a, const Body& b) { return a.id < b.id; });
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t j = i + 1; j < bodies.size(); ++j) {
      const Body &a = bodies[i], &b = bodies[j];
      const auto found = stories.find({a.id, b.id});
      if (options.can_meet && !options.can_meet(a.id, b.id)) {
        if (found != stories.end()) {
          result.violations.push_back("slots " + std::to_string(a.id.slot) + " and " +
                                      std::to_string(b.id.slot) + ": an event of an excluded pair");
        }
        continue;
      }
      const std::int64_t from = std::max(a.agent->from_ns, b.agent->from_ns);
      const std::int64_t to = std::min({a.agent->until_ns, b.agent->until_ns, end_ns});
      const std::vector<BallContact> contacts_true = BallContacts(
          a.agent->motion, b.agent->motion,
          a.agent->radius + b.agent->radius + a.agent->margin + b.agent->margin, from, to);
      const auto& known = found == stories.end() ? std::map<std::uint32_t, Story>() : found->second;
      for (const BallContact& contact : contacts_true) {
        if (contact.depth < options.grazing) continue;
        CheckContact({a, b, contact}, known, promises, options, &result);
      }
      CheckConfirmed(a, b, contacts_true, known, &result);
    }
  }
  return result;
}

std::string ViolationsOf(const CheckerResult& result) {
  std::string text;
  for (const std::string& violation : result.violations) text += violation + "\n";
  return text;
}

std::vector<int> CountStatuses(const std::vector<v1::Output>& published) {
  std::vector<int> counts(v1::EventStatus_ARRAYSIZE, 0);
  std::map<std::tuple<detection::AgentId, detection::AgentId, std::uint32_t>, v1::EventStatus> last;
  for (const v1::Output& output : published) {
    if (!output.has_collision_event()) continue;
    const v1::CollisionEvent& event = output.collision_event();
    const auto [known, added] = last.try_emplace(
        {ToId(event.lower()), ToId(event.higher()), event.contact()}, event.status());
    if (!added && known->second == event.status()) continue;
    known->second = event.status();
    ++counts[event.status()];
  }
  return counts;
}

}  // namespace collision::server
