// Where libzstd or zlib was not found when the program was built.
#include <stdexcept>

#include "client/programs/recordings/mcap_writer.h"
#include "client/programs/recordings/single_page.h"

namespace collision::client {

class McapWriter::File {};

McapWriter::McapWriter(const std::string& path) {
  throw std::runtime_error(path + ": this build writes no MCAP files: it takes libzstd and zlib");
}
McapWriter::~McapWriter() = default;
std::uint16_t McapWriter::Add(const Schema&) { return 0; }
std::uint16_t McapWriter::Add(const Channel&) { return 0; }
void McapWriter::Write(std::uint16_t, std::uint64_t, std::uint64_t, const std::string&) {}
void McapWriter::WriteMetadata(const std::string&, const std::map<std::string, std::string>&) {}
void McapWriter::EndChunk() {}
void McapWriter::Close() {}
const std::string& McapWriter::path() const {
  static const std::string kNone;
  return kNone;
}
std::uint64_t McapWriter::messages() const { return 0; }
std::uint64_t McapWriter::bytes() const { return 0; }

std::string SinglePage(const std::string&, const SinglePageTitle&,
                       const std::vector<std::string>&) {
  throw std::runtime_error("this build writes no pages: it takes libzstd and zlib");
}

}  // namespace collision::client
