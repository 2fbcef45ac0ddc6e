// Goal:   a viewer gets everything once, of what changed meanwhile the newest alone, and nothing
//         that is gone.
// Method: items by hand, and two viewers, one of which comes rarely.
#include "client/programs/scene/board.h"

#include <gtest/gtest.h>

#include "client/programs/scene/item.h"

namespace collision::client {
namespace {

constexpr std::size_t kNoLimit = 1 << 20;

std::string Names(const Board::News& news) {
  std::string names;
  for (const Board::Item& item : news.items) names += item.name + "=" + *item.payload + " ";
  return names;
}

TEST(Board, TellsWhatChangedSinceInTheOrderOfTheChanges) {
  Board board;
  board.Put("a", MakePayload("1"));
  board.Put("b", MakePayload("2"));
  const Board::News first = board.After(0, kNoLimit);
  EXPECT_EQ(Names(first), "a=1 b=2 ");
  board.Put("a", MakePayload("3"));
  board.Put("a", MakePayload("4"));
  board.Put("c", MakePayload("5"));
  board.Remove("b");
  EXPECT_EQ(Names(board.After(first.seen, kNoLimit)), "a=4 c=5 ");
  EXPECT_EQ(Names(board.After(0, kNoLimit)), "a=4 c=5 ") << "who comes late gets the newest, too";
  EXPECT_EQ(board.size(), 2u);
  EXPECT_EQ(Names(board.After(board.After(0, kNoLimit).seen, kNoLimit)), "");
}

TEST(Board, MuchIsTakenPieceByPieceAndWhole) {
  Board board;
  for (int i = 0; i < 10; ++i) {
    board.Put(std::to_string(i), MakePayload(std::string(100, static_cast<char>('0' + i))));
  }
  std::string names;
  std::uint64_t seen = 0;
  int pieces = 0;
  for (;; ++pieces) {
    const Board::News news = board.After(seen, 250);
    if (news.items.empty()) break;
    EXPECT_LE(news.items.size(), 2u);
    for (const Board::Item& item : news.items) names += item.name;
    seen = news.seen;
    ASSERT_LT(pieces, 10);
  }
  EXPECT_EQ(names, "0123456789");
  EXPECT_EQ(board.After(0, 1).items.size(), 1u) << "one that is too large goes alone";
}

TEST(Item, IsFilledUpToEightBytes) {
  const Payload item = MakeItem(ItemKind::kJson, "{\"a\": 1}x");
  EXPECT_EQ(item->size(), 8u + 16u);
  EXPECT_EQ(item->substr(0, 8), std::string("\0\0\0\0\x10\0\0\0", 8));
  EXPECT_EQ(item->substr(8), "{\"a\": 1}x       ");
}

}  // namespace
}  // namespace collision::client
