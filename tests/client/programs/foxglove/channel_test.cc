// Goal:   a client can read every channel with what the channel says of itself.
// Method: each schema alone in an empty pool.
#include "client/programs/foxglove/channel.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <gtest/gtest.h>

#include <set>

namespace collision::client {
namespace {

TEST(Channels, HaveTheirOwnIdsAndTopics) {
  std::set<std::string> topics;
  for (std::size_t i = 0; i < Channels().size(); ++i) {
    EXPECT_EQ(Channels()[i].id, i + 1);
    EXPECT_TRUE(topics.insert(Channels()[i].topic).second);
    EXPECT_TRUE(IsChannel(Channels()[i].id));
  }
  EXPECT_FALSE(IsChannel(0));
  EXPECT_FALSE(IsChannel(static_cast<std::uint32_t>(Channels().size()) + 1));
}

TEST(Channels, BringTheirSchemaWithAllImports) {
  int protobuf = 0;
  for (const Channel& channel : Channels()) {
    if (channel.encoding != "protobuf") continue;
    ++protobuf;
    EXPECT_EQ(channel.schema_encoding, "protobuf");
    google::protobuf::FileDescriptorSet files;
    ASSERT_TRUE(files.ParseFromString(channel.schema));
    google::protobuf::DescriptorPool pool;
    for (const auto& file : files.file()) EXPECT_TRUE(pool.BuildFile(file)) << file.name();
    EXPECT_TRUE(pool.FindMessageTypeByName(channel.schema_name)) << channel.schema_name;
  }
  EXPECT_EQ(protobuf, 5);
}

TEST(Channels, NumbersAreForPlotJuggler) {
  for (const std::size_t i : {5u, 6u}) {
    EXPECT_EQ(Channels().at(i).encoding, "cdr");
    EXPECT_EQ(Channels().at(i).schema_encoding, "ros2msg");
    EXPECT_NE(Channels().at(i).schema.find(std::string(80, '=') + "\nMSG: "), std::string::npos);
  }
}

}  // namespace
}  // namespace collision::client
