#include "client/programs/recordings/single_page.h"

#include <zlib.h>

#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "client/programs/shared/web_text.h"

namespace collision::client {
namespace {

constexpr std::string_view kPlace = "<!-- recorded -->";

/// As gzip packs it, as well as it can.
std::string Gzipped(const std::string& bytes) {
  constexpr int kGzip = 16 + MAX_WBITS, kMemory = 9;
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kGzip, kMemory, Z_DEFAULT_STRATEGY) !=
      Z_OK) {
    throw std::runtime_error("zlib cannot be used");
  }
  std::string packed(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const bool is_whole = bytes.size() < UINT32_MAX && deflate(&stream, Z_FINISH) == Z_STREAM_END;
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  if (!is_whole) throw std::runtime_error("the page is too large");
  return packed;
}

}  // namespace

std::string SinglePage(const std::string& page_template, const SinglePageTitle& title,
                       const std::vector<std::string>& messages) {
  const std::size_t place = page_template.find(kPlace);
  if (place == std::string::npos) throw std::runtime_error("not the template of a page");
  std::string bytes;
  for (const std::string& message : messages) {
    for (int shift = 0; shift < 32; shift += 8) {
      bytes += static_cast<char>(message.size() >> shift);
    }
    bytes += message;
  }
  return page_template.substr(0, place) +
         "<script type=\"text/plain\" id=\"recorded\" data-name=\"" + EscapeHtml(title.name) +
         "\" data-event=\"" + EscapeHtml(title.event_key) + "\">" + Base64(Gzipped(bytes)) +
         "</script>" + page_template.substr(place + kPlace.size());
}

}  // namespace collision::client
