#include "server/world/succession.h"

#include <algorithm>
#include <utility>

namespace collision::server {

bool Succession::Waits(std::uint64_t simulator, std::uint64_t sender) const {
  const auto held = held_.find(simulator);
  return held != held_.end() &&
         std::any_of(held->second.begin(), held->second.end(),
                     [sender](const v1::Input& input) { return input.sender() == sender; });
}

void Succession::Hold(std::uint64_t simulator, const v1::Input& input) {
  std::vector<v1::Input>& held = held_[simulator];
  if (held.size() >= kHeldInputsMax) return;
  held.push_back(input);
  shape_bytes_ += input.shape_part().bytes().size();
}

void Succession::HoldRemoval(std::uint64_t simulator, const v1::Input& removal) {
  std::vector<v1::Input>& held = held_[simulator];
  if (held.size() == kHeldInputsMax) held.pop_back();
  held.push_back(removal);
  CountBytes();
}

void Succession::Drop(std::uint64_t simulator, std::uint64_t sender) {
  const auto held = held_.find(simulator);
  if (held == held_.end()) return;
  std::erase_if(held->second,
                [sender](const v1::Input& input) { return input.sender() == sender; });
  if (held->second.empty()) held_.erase(held);
  CountBytes();
}

std::vector<v1::Input> Succession::Take(std::uint64_t simulator) {
  const auto held = held_.find(simulator);
  if (held == held_.end()) return {};
  std::vector<v1::Input> inputs = std::move(held->second);
  held_.erase(held);
  CountBytes();
  return inputs;
}

void Succession::CountBytes() {
  shape_bytes_ = 0;
  for (const auto& [simulator, inputs] : held_) {
    for (const v1::Input& input : inputs) shape_bytes_ += input.shape_part().bytes().size();
  }
}

}  // namespace collision::server
