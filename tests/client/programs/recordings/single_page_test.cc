// Goal:   the page holds the messages and their names, whatever is in these.
// Method: a template of three words; what was put in is unpacked by zlib, and read by hand.
#include "client/programs/recordings/single_page.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <stdexcept>

#include "tests/support/random.h"

namespace collision::client {
namespace {

std::string FromBase64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  EXPECT_EQ(text.size() % 4, 0u);
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
    count += 6;
    if (count >= 8) bytes += static_cast<char>(bits >> (count -= 8));
  }
  return bytes;
}

std::string Unzipped(const std::string& packed) {
  constexpr int kGzip = 16 + MAX_WBITS;
  z_stream stream{};
  EXPECT_EQ(inflateInit2(&stream, kGzip), Z_OK);
  std::string plain(1 << 20, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(plain.data());
  stream.avail_out = static_cast<uInt>(plain.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  plain.resize(stream.total_out);
  inflateEnd(&stream);
  return plain;
}

TEST(SinglePage, HoldsTheMessagesBehindTheirLengths) {
  Random random(1995);
  for (std::size_t size = 0; size < 40; ++size) {  // for each padding of base64
    std::string message;
    while (message.size() < size) message += static_cast<char>(random.Below(256));
    const std::string page =
        SinglePage("head<!-- recorded -->tail", {.name = "run", .event_key = ""}, {message, "ab"});
    const std::string begin =
        "head<script type=\"text/plain\" id=\"recorded\" data-name=\"run\" data-event=\"\">";
    ASSERT_TRUE(page.starts_with(begin)) << page;
    ASSERT_TRUE(page.ends_with("</script>tail")) << page;
    const std::string text = page.substr(begin.size(), page.find("</script>") - begin.size());
    const std::string plain = Unzipped(FromBase64(text));
    const auto length = [](std::size_t n) {
      return std::string(1, static_cast<char>(n)) + std::string(3, '\0');
    };
    ASSERT_EQ(plain, length(size) + message + length(2) + "ab");
  }
}

TEST(SinglePage, NamesStayNames) {
  const std::string page =
      SinglePage("<!-- recorded -->",
                 {.name = "\"><script>alert(1)</script>&amp;", .event_key = "event/\"7\""}, {});
  EXPECT_NE(page.find("data-name=\"&quot;&gt;&lt;script&gt;alert(1)&lt;/script&gt;&amp;amp;\""),
            std::string::npos)
      << page;
  EXPECT_NE(page.find("data-event=\"event/&quot;7&quot;\""), std::string::npos) << page;
}

TEST(SinglePage, AnotherPageIsNoTemplate) {
  EXPECT_THROW(SinglePage("<html></html>", {.name = "", .event_key = ""}, {}), std::runtime_error);
}

}  // namespace
}  // namespace collision::client
