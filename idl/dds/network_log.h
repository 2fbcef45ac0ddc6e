// What Cyclone DDS says of itself.
#pragma once

#include <functional>
#include <string>

namespace collision::dds {

/// From now on `write` gets what Cyclone DDS would write to standard error, a line for each error,
/// warning and note of any domain of this process. It is called from any thread of Cyclone DDS,
/// also from several at once, and no more once this function has been called again. Null: standard
/// error gets it, as at first.
void SetNetworkLog(std::function<void(const std::string& line)> write);

}  // namespace collision::dds
