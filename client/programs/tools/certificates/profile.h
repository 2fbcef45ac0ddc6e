// Credentials for a program of Cyclone DDS that does not use our library.
#pragma once

#include <string>

namespace collision::client {

/// The file, in each folder of credentials.
inline constexpr char kProfile[] = "cyclonedds-security.xml";

/// A network profile that adds security to another one: CYCLONEDDS_URI names both, separated by a
/// comma. It finds the files by COLLISION_CREDENTIALS, so that the folder can be copied anywhere.
std::string SecurityProfile();

}  // namespace collision::client
