#include "client/programs/tools/certificates/signing.h"

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

#include <memory>

namespace collision::client {
namespace {

/// An object of libcrypto, freed at the end.
template <auto free>
struct Free {
  template <typename Object>
  void operator()(Object* object) const {
    free(object);
  }
};
using Key = std::unique_ptr<EVP_PKEY, Free<EVP_PKEY_free>>;
using Certificate = std::unique_ptr<X509, Free<X509_free>>;
using Stream = std::unique_ptr<BIO, Free<BIO_free_all>>;
using Signed = std::unique_ptr<PKCS7, Free<PKCS7_free>>;
using Extension = std::unique_ptr<X509_EXTENSION, Free<X509_EXTENSION_free>>;
using BigNumber = std::unique_ptr<BIGNUM, Free<BN_free>>;

constexpr int kVersion3 = 2;            // of X.509, as it is encoded
constexpr int kSerialNumberBits = 127;  // positive, in at most 20 bytes (RFC 5280, 4.1.2.2)

/// Throws, with the reason that libcrypto gives, unless `succeeded`.
void Check(bool succeeded, const char* what) {
  if (succeeded) return;
  char reason[256] = "no reason is known";
  if (const unsigned long code = ERR_get_error(); code != 0) {
    ERR_error_string_n(code, reason, sizeof reason);
  }
  ERR_clear_error();
  throw SigningError(std::string(what) + ": " + reason);
}

Stream MakeStream() {
  Stream stream(BIO_new(BIO_s_mem()));
  Check(stream != nullptr, "memory");
  return stream;
}

Stream StreamOf(const std::string& text) {
  Stream stream(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
  Check(stream != nullptr, "memory");
  return stream;
}

std::string BytesIn(BIO* stream) {
  char* bytes = nullptr;
  const long size = BIO_get_mem_data(stream, &bytes);
  return {bytes, static_cast<std::size_t>(size)};
}

Key ReadKey(const std::string& pem) {
  Key key(PEM_read_bio_PrivateKey(StreamOf(pem).get(), nullptr, nullptr, nullptr));
  Check(key != nullptr, "private key");
  return key;
}

Certificate ReadCertificate(const std::string& pem) {
  Certificate certificate(PEM_read_bio_X509(StreamOf(pem).get(), nullptr, nullptr, nullptr));
  Check(certificate != nullptr, "certificate");
  return certificate;
}

Key MakeKey() {
  Key key(EVP_EC_gen("P-256"));
  Check(key != nullptr, "private key");
  return key;
}

std::string PemOf(EVP_PKEY* key) {
  const Stream stream = MakeStream();
  Check(
      PEM_write_bio_PKCS8PrivateKey(stream.get(), key, nullptr, nullptr, 0, nullptr, nullptr) == 1,
      "private key");
  return BytesIn(stream.get());
}

std::string PemOf(X509* certificate) {
  const Stream stream = MakeStream();
  Check(PEM_write_bio_X509(stream.get(), certificate) == 1, "certificate");
  return BytesIn(stream.get());
}

void SetName(X509_NAME* name, const Subject& subject) {
  const auto add = [name](const char* field, const std::string& text) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(text.data());
    Check(X509_NAME_add_entry_by_txt(name, field, MBSTRING_UTF8, bytes,
                                     static_cast<int>(text.size()), -1, 0) == 1,
          "subject");
  };
  add("O", subject.world);
  add("OU", subject.role);
  add("CN", subject.name);
}

void SetSerialNumber(X509* certificate) {
  const BigNumber number(BN_new());
  Check(
      number && BN_rand(number.get(), kSerialNumberBits, BN_RAND_TOP_ANY, BN_RAND_BOTTOM_ANY) == 1,
      "serial number");
  Check(BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(certificate)) != nullptr,
        "serial number");
}

void Add(X509* certificate, X509* issuer, int kind, const char* value) {
  X509V3_CTX context;
  X509V3_set_ctx(&context, issuer, certificate, nullptr, nullptr, 0);
  const Extension extension(X509V3_EXT_conf_nid(nullptr, &context, kind, value));
  Check(extension && X509_add_ext(certificate, extension.get(), -1) == 1, "certificate");
}

/// All of a certificate but issuer, extensions and signature.
Certificate Begin(const Subject& subject, const Period& period, EVP_PKEY* key) {
  Certificate certificate(X509_new());
  Check(certificate && X509_set_version(certificate.get(), kVersion3) == 1, "certificate");
  SetSerialNumber(certificate.get());
  SetName(X509_get_subject_name(certificate.get()), subject);
  Check(ASN1_TIME_set(X509_getm_notBefore(certificate.get()), period.begin) != nullptr &&
            ASN1_TIME_set(X509_getm_notAfter(certificate.get()), period.end) != nullptr &&
            X509_set_pubkey(certificate.get(), key) == 1,
        "certificate");
  return certificate;
}

void Finish(X509* certificate, EVP_PKEY* key) {
  Check(X509_sign(certificate, key, EVP_sha256()) > 0, "signature of a certificate");
}

}  // namespace

bool CanSign() { return true; }

KeyAndCertificate MakeAuthority(const Subject& subject, const Period& period) {
  const Key key = MakeKey();
  const Certificate own = Begin(subject, period, key.get());
  Check(X509_set_issuer_name(own.get(), X509_get_subject_name(own.get())) == 1, "certificate");
  Add(own.get(), own.get(), NID_basic_constraints, "critical,CA:TRUE");
  Add(own.get(), own.get(), NID_key_usage, "critical,keyCertSign,cRLSign,digitalSignature");
  Add(own.get(), own.get(), NID_subject_key_identifier, "hash");
  Finish(own.get(), key.get());
  return {PemOf(key.get()), PemOf(own.get())};
}

KeyAndCertificate Issue(const KeyAndCertificate& authority, const Subject& subject,
                        const Period& period) {
  const Key key = MakeKey(), issuer_key = ReadKey(authority.key);
  const Certificate issuer = ReadCertificate(authority.certificate);
  const Certificate issued = Begin(subject, period, key.get());
  Check(X509_set_issuer_name(issued.get(), X509_get_subject_name(issuer.get())) == 1,
        "certificate");
  Add(issued.get(), issuer.get(), NID_basic_constraints, "critical,CA:FALSE");
  Add(issued.get(), issuer.get(), NID_key_usage, "critical,digitalSignature,keyAgreement");
  Add(issued.get(), issuer.get(), NID_authority_key_identifier, "keyid");
  Finish(issued.get(), issuer_key.get());
  return {PemOf(key.get()), PemOf(issued.get())};
}

std::string Sign(const KeyAndCertificate& authority, const std::string& text) {
  // Beside the text, which stays readable, and as text: line ends are those of S/MIME.
  constexpr int kFlags = PKCS7_TEXT | PKCS7_DETACHED | PKCS7_STREAM;
  const Key key = ReadKey(authority.key);
  const Certificate signer = ReadCertificate(authority.certificate);
  const Stream input = StreamOf(text), output = MakeStream();
  const Signed document(PKCS7_sign(signer.get(), key.get(), nullptr, input.get(), kFlags));
  Check(document != nullptr, "signature of a document");
  Check(SMIME_write_PKCS7(output.get(), document.get(), input.get(), kFlags) == 1,
        "signature of a document");
  return BytesIn(output.get());
}

}  // namespace collision::client
