#include "client/programs/gateway/web/page_files.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "client/programs/shared/web_text.h"
#include "idl/sha256.h"

namespace collision::gateway {
namespace {

constexpr std::string_view kIndex = "/index.html";

const char* TypeOf(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension();
  if (ending == ".html") return "text/html; charset=utf-8";
  if (ending == ".js" || ending == ".mjs") return "text/javascript; charset=utf-8";
  if (ending == ".css") return "text/css; charset=utf-8";
  if (ending == ".json") return "application/json";
  if (ending == ".svg") return "image/svg+xml";
  return "application/octet-stream";
}

std::string ContentOf(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file || !text) throw std::runtime_error(path.string() + ": cannot be read");
  return text.str();
}

}  // namespace

PageFiles::PageFiles(const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code failed;
  for (fs::recursive_directory_iterator next(folder, failed), end; !failed && next != end;
       next.increment(failed)) {
    if (!next->is_regular_file()) continue;
    const std::string path = "/" + fs::relative(next->path(), folder).generic_string();
    files_[path] = MakePayload(ContentOf(next->path()));
  }
  if (failed) throw std::runtime_error(folder + ": " + failed.message());
  const auto index = files_.find(std::string(kIndex));
  if (index == files_.end()) throw std::runtime_error(folder + ": the page is not there");
  policy_ = SecurityPolicyFor(*index->second);
}

WebResponse PageFiles::Answer(const std::string& path, bool takes_gzip) const {
  const std::string wanted = path == "/" ? std::string(kIndex) : path;
  const auto file = files_.find(wanted);
  if (file == files_.end())
    return {.status = 404, .body = MakePayload("there is no " + path + "\n")};
  WebResponse answer{.type = TypeOf(wanted), .body = file->second};
  answer.headers.emplace_back("Cache-Control", "no-cache");
  answer.headers.emplace_back("Vary", "Accept-Encoding");
  if (wanted == kIndex) answer.headers.emplace_back("Content-Security-Policy", policy_);
  const auto packed = files_.find(wanted + ".gz");
  if (takes_gzip && packed != files_.end()) {
    answer.body = packed->second;
    answer.headers.emplace_back("Content-Encoding", "gzip");
  }
  return answer;
}

std::string SecurityPolicyFor(const std::string& index) {
  constexpr std::string_view kBegin = "<script type=\"importmap\">", kEnd = "</script>";
  std::string map_hash;
  const std::size_t begin = index.find(kBegin);
  const std::size_t end = index.find(kEnd, begin);
  if (begin != std::string::npos && end != std::string::npos) {
    const std::size_t from = begin + kBegin.size();
    map_hash = " 'sha256-" + client::Base64(Sha256(index.substr(from, end - from))) + "'";
  }
  return "default-src 'none'; script-src 'self'" + map_hash +
         "; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; connect-src 'self'; "
         "worker-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
}

}  // namespace collision::gateway
