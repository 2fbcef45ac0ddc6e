#include "server/service/reports/contact_report.h"

#include <spdlog/fmt/fmt.h>

#include <ctime>
#include <limits>

#include "idl/identity.h"
#include "server/process/logging.h"

namespace collision::server {
namespace {

std::string NameOf(const v1::AgentLabel& label, const v1::AgentId& id) {
  if (label.simulator_name().empty()) return fmt::format("agent in slot {}", id.slot());
  if (label.agent_name().empty()) return fmt::format("{}/{}", label.simulator_name(), id.slot());
  return label.simulator_name() + "/" + label.agent_name();
}

std::string TimeText(std::int64_t ns, bool simulated_clock) {
  if (ns == std::numeric_limits<std::int64_t>::max()) return "not known";
  if (simulated_clock) return fmt::format("{:.6f} s", 1e-9 * static_cast<double>(ns));
  constexpr std::int64_t kSecond = 1'000'000'000;
  const std::int64_t rest = ((ns % kSecond) + kSecond) % kSecond;
  const std::time_t seconds = (ns - rest) / kSecond;
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  char text[32];
  if (std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S", &utc) == 0) return std::to_string(ns);
  return fmt::format("{}.{:06d}Z", text, rest / 1000);
}

/// Of this contact of this pair in this epoch, and of no other one but by chance.
std::uint64_t HashOf(const v1::CollisionEvent& contact) {
  const v1::AgentId &lower = contact.lower(), &higher = contact.higher();
  return Fnv1a(fmt::format("{} {}.{}.{}.{} {}.{}.{}.{} {} {}", contact.stamp().epoch(),
                           lower.simulator_id(), lower.run(), lower.slot(), lower.generation(),
                           higher.simulator_id(), higher.run(), higher.slot(), higher.generation(),
                           contact.contact(), contact.level()));
}

}  // namespace

std::string ContactText(const v1::CollisionEvent& contact, bool simulated_clock) {
  const v1::TimeBracket& begin = contact.begin();
  const std::string what =
      contact.level().empty() ? "touch" : fmt::format("cross level \"{}\"", contact.level());
  return fmt::format(
      "{} and {} {}, from between {} and {}", NameOf(contact.lower_label(), contact.lower()),
      NameOf(contact.higher_label(), contact.higher()), what,
      TimeText(begin.earliest_ns(), simulated_clock), TimeText(begin.latest_ns(), simulated_clock));
}

void ContactReport::WriteToLog(const std::string& text) {
  Log(spdlog::level::info, "contact", text);
}

void ContactReport::TakeContact(const v1::CollisionEvent& contact) {
  measurements_.TakeContact(contact);
  if (kept_ != nullptr) kept_->Add(contact);
  if (contact.status() != v1::EVENT_CONFIRMED) return;
  const std::uint64_t hash = HashOf(contact);
  std::uint64_t& place = written_[hash % kPlaces];
  if (place == hash) return;
  place = hash;
  write_(ContactText(contact, simulated_));
}

}  // namespace collision::server
