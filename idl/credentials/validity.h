// Until when credentials hold. Cyclone DDS checks that when a program starts; while it runs, the
// others drop it at that second, and it notices nothing by itself.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace collision::credentials {

/// The last second [s since 1970] of the first certificate in a PEM file; nullopt: there is none.
/// Reads its dates and nothing else: the certificate is verified by Cyclone DDS.
std::optional<std::int64_t> EndOfCertificate(std::string_view pem);

/// The earliest end of the grants of a permissions document, signed or not; nullopt: it names none.
std::optional<std::int64_t> EndOfPermissions(std::string_view document);

/// "2027-01-31 12:00:00 UTC".
std::string DateText(std::int64_t seconds);

/// The same as permissions documents have it: "2027-01-31T12:00:00Z".
std::string XmlDateText(std::int64_t seconds);

}  // namespace collision::credentials
