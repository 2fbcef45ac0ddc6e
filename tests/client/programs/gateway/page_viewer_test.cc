// Goal:   a page that has shown what it got is sent what is newest; two messages at most are on
//         their way.
// Method: items and answers by hand.
#include "client/programs/gateway/page_viewer.h"

#include <gtest/gtest.h>

namespace collision::gateway {
namespace {

using client::Board;
using client::MakePayload;

TEST(PageViewer, WaitsUntilTwoMessagesAreShown) {
  Board board;
  PageViewer viewer(&board);
  EXPECT_FALSE(viewer.Next()) << "nothing is there";
  for (const char* text : {"1", "2"}) {
    board.Put("a", MakePayload(text));
    const auto message = viewer.Next();
    ASSERT_TRUE(message);
    EXPECT_FALSE(message->is_text);
    EXPECT_EQ(*message->pieces.at(0), text);
  }
  board.Put("a", MakePayload("3"));
  board.Put("a", MakePayload("4"));
  EXPECT_FALSE(viewer.Next()) << "two are on their way";
  EXPECT_EQ(viewer.Hear("ack", true), "");
  EXPECT_EQ(*viewer.Next()->pieces.at(0), "4") << "what was overtaken is not sent";
  EXPECT_EQ(viewer.Hear("ack", true), "");
  EXPECT_EQ(viewer.Hear("ack", true), "");
  EXPECT_NE(viewer.Hear("ack", true), "") << "nothing is left to acknowledge";
  EXPECT_NE(viewer.Hear("hello", true), "");
  EXPECT_NE(viewer.Hear("ack", false), "");
}

}  // namespace
}  // namespace collision::gateway
