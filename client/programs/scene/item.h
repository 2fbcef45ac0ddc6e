// The items of the page's protocol: README.md of the gateway has it for who reads it elsewhere.
#pragma once

#include <cstdint>
#include <string>

#include "client/programs/scene/payload.h"

namespace collision::client {

/// What an item's bytes are.
enum class ItemKind : std::uint32_t {
  kJson = 0,           ///< An object whose member "item" says what it is about.
  kStates = 1,         ///< States of up to kStatesOfAChunk agents (state_table.h).
  kChangedStates = 2,  ///< In recordings: states of single agents (likewise).
  kShape = 3,          ///< In recordings: the 32 bytes of a hash, then the shape (shape_bytes.h).
};

/// Little-endian: u32 kind, u32 length, then so many bytes. A length is a multiple of 8, so that
/// the numbers of states can be read in place; JSON is filled up with spaces.
inline Payload MakeItem(ItemKind kind, std::string bytes) {
  while (bytes.size() % 8 != 0) bytes += kind == ItemKind::kJson ? ' ' : '\0';
  std::string item(8, '\0');
  const auto put = [&item](std::size_t at, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) item[at + i] = static_cast<char>(value >> (8 * i));
  };
  put(0, static_cast<std::uint32_t>(kind));
  put(4, static_cast<std::uint32_t>(bytes.size()));
  return MakePayload(item + bytes);
}

}  // namespace collision::client
