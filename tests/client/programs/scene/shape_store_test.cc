// Goal:   a shape is there once all its parts have come, and only if it is what it is called; what
//         simulators invent takes no more memory than is allowed.
#include "client/programs/scene/shape_store.h"

#include <gtest/gtest.h>

#include "idl/sha256.h"

namespace collision::client {
namespace {

v1::ShapePart PartOf(const std::string& hash, std::uint32_t part, std::uint32_t parts,
                     const std::string& bytes) {
  v1::ShapePart message;
  message.set_content_hash(hash);
  message.set_part(part);
  message.set_parts(parts);
  message.set_bytes(bytes);
  return message;
}

TEST(ShapeStore, IsWholeWithItsLastPartInAnyOrder) {
  ShapeStore store;
  const std::string hash = Sha256("abcd");
  EXPECT_FALSE(store.Take(PartOf(hash, 1, 2, "cd")));
  EXPECT_FALSE(store.Take(PartOf(hash, 1, 2, "cd"))) << "the same again";
  EXPECT_EQ(store.Find(hash), nullptr);
  EXPECT_TRUE(store.Take(PartOf(hash, 0, 2, "ab")));
  ASSERT_NE(store.Find(hash), nullptr);
  EXPECT_EQ(*store.Find(hash), "abcd");
  EXPECT_FALSE(store.Take(PartOf(hash, 0, 2, "ab"))) << "it is there already";
}

TEST(ShapeStore, WhatIsNotWhatItIsCalledIsNotKept) {
  ShapeStore store;
  const std::string hash = Sha256("abcd");
  EXPECT_FALSE(store.Take(PartOf(hash, 0, 1, "abcx")));
  EXPECT_EQ(store.Find(hash), nullptr);
  EXPECT_TRUE(store.Take(PartOf(hash, 0, 1, "abcd"))) << "a right one may come yet";
}

TEST(ShapeStore, PartsThatCannotBeAreLeftOut) {
  ShapeStore store;
  const std::string hash = Sha256("abcd");
  EXPECT_FALSE(store.Take(PartOf(hash, 0, 0, "abcd")));
  EXPECT_FALSE(store.Take(PartOf(hash, 1, 1, "abcd")));
  EXPECT_FALSE(store.Take(PartOf(hash, 0, 1, "")));
  EXPECT_FALSE(store.Take(PartOf(hash, 0, 1, std::string(1 << 17, 'x'))));
  EXPECT_FALSE(store.Take(PartOf(hash, 0, 0xffffffff, "abcd"))) << "so many places are no shape";
  for (std::size_t i = 0; i < ShapeStore::kGatheringMax; ++i) {
    EXPECT_FALSE(store.Take(PartOf(std::to_string(i), 0, 2, "ab")));
  }
  EXPECT_FALSE(store.Take(PartOf(hash, 0, 1, "abcd"))) << "as many as may be are unfinished";
}

}  // namespace
}  // namespace collision::client
