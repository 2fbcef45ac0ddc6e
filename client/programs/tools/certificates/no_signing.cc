#include "client/programs/tools/certificates/signing.h"

namespace collision::client {
namespace {

[[noreturn]] void Fail() {
  throw SigningError(
      "this build cannot make certificates: libcrypto was not found (Debian: libssl-dev)");
}

}  // namespace

bool CanSign() { return false; }

KeyAndCertificate MakeAuthority(const Subject&, const Period&) { Fail(); }

KeyAndCertificate Issue(const KeyAndCertificate&, const Subject&, const Period&) { Fail(); }

std::string Sign(const KeyAndCertificate&, const std::string&) { Fail(); }

}  // namespace collision::client
