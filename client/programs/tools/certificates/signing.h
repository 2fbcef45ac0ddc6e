// Keys, certificates and signatures: the one place that knows libcrypto.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace collision::client {

/// What is wrong with files of keys or certificates, or with libcrypto itself.
struct SigningError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Whether this build has libcrypto. Without it every function below throws SigningError, which
/// says so.
bool CanSign();

/// How long something holds [s since 1970].
struct Period {
  std::int64_t begin = 0;
  std::int64_t end = 0;
};

/// Of whom a certificate tells: O is the world, OU the role, CN the name. All are names
/// (idl/limits.h), so that nothing in them needs quoting.
struct Subject {
  std::string world;
  std::string role;
  std::string name;
};

/// "CN=alpha,OU=simulator,O=lab", as RFC 2253 writes it and permissions name it.
inline std::string TextOf(const Subject& subject) {
  return "CN=" + subject.name + ",OU=" + subject.role + ",O=" + subject.world;
}

/// A private key and its certificate, both in PEM.
struct KeyAndCertificate {
  std::string key;
  std::string certificate;
};

/// A key on the curve P-256, and a certificate that it has signed itself.
KeyAndCertificate MakeAuthority(const Subject& subject, const Period& period);

/// A new key, and a certificate of it by `authority`.
KeyAndCertificate Issue(const KeyAndCertificate& authority, const Subject& subject,
                        const Period& period);

/// `text` as an S/MIME message that carries the signature of `authority` beside it, as DDS Security
/// reads documents.
std::string Sign(const KeyAndCertificate& authority, const std::string& text);

}  // namespace collision::client
