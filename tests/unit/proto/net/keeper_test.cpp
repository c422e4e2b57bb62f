// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/keeper.hpp"

#include "proto/net/text_file.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <unistd.h>

namespace hapnet::net {
namespace {

class KeeperFolder : public testing::Test {
protected:
    KeeperFolder() { std::filesystem::create_directory(folder); }
    ~KeeperFolder() override { std::filesystem::remove_all(folder); }

    std::string folder = testing::TempDir() + "/hapnet-keeper-" + std::to_string(getpid());
};

TEST_F(KeeperFolder, SavesAnOrderForItsOwnerAlone)
{
    Keeper keeper{folder};
    const base::TimePoint from{std::chrono::seconds{3}};
    ASSERT_EQ(keeper.order("trap-1.rec", from), folder + "/trap-1.rec");
    const auto order = keeper.take();
    ASSERT_TRUE(order);
    EXPECT_EQ(order->from, from);
    EXPECT_FALSE(keeper.take());
    keeper.save(order->path, "the last seconds");
    EXPECT_EQ(text_of_file(order->path), "the last seconds");
    EXPECT_EQ(std::filesystem::status(order->path).permissions(),
              std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    EXPECT_FALSE(keeper.trouble());
}

TEST_F(KeeperFolder, NeverOverwritesAndTakesOneOrderAtATime)
{
    std::ofstream{folder + "/there.rec"} << "mine";
    Keeper keeper{folder};
    EXPECT_FALSE(keeper.order("there.rec", {}));
    ASSERT_TRUE(keeper.order("one.rec", {}));
    EXPECT_FALSE(keeper.order("two.rec", {}));
    ASSERT_TRUE(keeper.take());
    EXPECT_TRUE(keeper.order("two.rec", {}));
}

TEST_F(KeeperFolder, SavesAHundredFilesARun)
{
    Keeper keeper{folder};
    for (int i = 0; i < Keeper::files_max; ++i) {
        ASSERT_TRUE(keeper.order(std::to_string(i), {}));
        ASSERT_TRUE(keeper.take());
    }
    EXPECT_FALSE(keeper.order("one-more", {}));
}

TEST_F(KeeperFolder, TellsOnceWhyAFileIsMissing)
{
    Keeper keeper{folder + "/none"};
    const auto path = keeper.order("trap.rec", {});
    ASSERT_TRUE(path);
    keeper.save(*path, "lost");
    EXPECT_TRUE(keeper.trouble());
    EXPECT_FALSE(keeper.trouble());
}

} // namespace
} // namespace hapnet::net
