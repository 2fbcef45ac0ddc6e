#include "idl/dds/security/credentials.h"

#include <cerrno>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "idl/credentials/files.h"
#include "idl/credentials/validity.h"

namespace collision::dds {
namespace {

namespace fs = std::filesystem;
using namespace collision::credentials;

constexpr std::string_view kFiles[] = {kIdentityCa,    kCertificate, kKey,
                                       kPermissionsCa, kGovernance,  kPermissions};

/// More than any of them has.
constexpr std::size_t kFileBytesMax = std::size_t{1} << 20;

struct Property {
  const char* name;
  const char* value;
};

/// The plugins: libraries that come with Cyclone DDS, and lie where it looks.
constexpr Property kPlugins[] = {
    {"dds.sec.auth.library.path", "dds_security_auth"},
    {"dds.sec.auth.library.init", "init_authentication"},
    {"dds.sec.auth.library.finalize", "finalize_authentication"},
    {"dds.sec.crypto.library.path", "dds_security_crypto"},
    {"dds.sec.crypto.library.init", "init_crypto"},
    {"dds.sec.crypto.library.finalize", "finalize_crypto"},
    {"dds.sec.access.library.path", "dds_security_ac"},
    {"dds.sec.access.library.init", "init_access_control"},
    {"dds.sec.access.library.finalize", "finalize_access_control"},
};

/// And what they read.
constexpr Property kFileOf[] = {
    {"dds.sec.auth.identity_ca", kIdentityCa},  {"dds.sec.auth.identity_certificate", kCertificate},
    {"dds.sec.auth.private_key", kKey},         {"dds.sec.access.permissions_ca", kPermissionsCa},
    {"dds.sec.access.governance", kGovernance}, {"dds.sec.access.permissions", kPermissions},
};

std::runtime_error Refused(const std::string& what) {
  return std::runtime_error("credentials: " + what);
}

std::string TextOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const int error = errno;
  std::string text(kFileBytesMax, '\0');
  if (!file || fs::is_directory(path)) {
    throw Refused(path + ": " + std::generic_category().message(file ? EISDIR : error));
  }
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.empty()) throw Refused(path + ": is empty");
  return text;
}

/// The folder that this process shows in a domain, for as long as somebody holds it.
std::shared_ptr<const std::string> Hold(std::uint32_t domain, const std::string& folder) {
  static std::mutex mutex;
  static std::map<std::uint32_t, std::weak_ptr<const std::string>> folders;
  const std::lock_guard lock(mutex);
  std::weak_ptr<const std::string>& held = folders[domain];
  auto holder = held.lock();
  if (holder && *holder != folder) {
    throw Refused(folder + ": this program takes part in DDS domain " + std::to_string(domain) +
                  " with " + *holder +
                  " already, and one process has one: for a simulator that also monitors, make "
                  "credentials with collisionctl make-certificates --simulator NAME --monitoring");
  }
  if (!holder) held = holder = std::make_shared<const std::string>(folder);
  return holder;
}

std::int64_t SecondsSince1970() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::seconds>(now).count();
}

}  // namespace

Credentials::Credentials(const std::string& folder, std::uint32_t domain) {
  std::error_code error;
  folder_ = fs::weakly_canonical(fs::absolute(folder, error), error).string();
  if (!fs::is_directory(folder_, error)) throw Refused(folder_ + ": there is no such folder");
  for (const std::string_view name : kFiles) {
    const std::string path = folder_ + "/" + std::string(name);
    const std::string text = TextOf(path);
    std::optional<std::int64_t> end;
    if (name == kCertificate || name == kIdentityCa) end = EndOfCertificate(text);
    if (name == kPermissions) end = EndOfPermissions(text);
    if (name == kCertificate && !end) throw Refused(path + ": is no certificate");
    if (!end) continue;
    if (*end < SecondsSince1970()) {
      throw Refused(path + ": ended at " + DateText(*end) +
                    "; make new ones with collisionctl make-certificates");
    }
    if (!first_to_end_.empty() && *end >= end_) continue;
    first_to_end_ = path;
    end_ = *end;
  }
  held_ = Hold(domain, folder_);
}

void Credentials::Apply(dds_qos_t* participant) const {
  for (const auto& [name, value] : kPlugins) dds_qset_prop(participant, name, value);
  for (const auto& [name, file] : kFileOf) {
    dds_qset_prop(participant, name, ("file:" + folder_ + "/" + file).c_str());
  }
}

}  // namespace collision::dds
