// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/core/frames.hpp"

#include <gtest/gtest.h>
#include <string>

namespace hapnet::web {
namespace {

const std::string way = R"({"received":4,"delivered":3,"duplicated":0,"dropped":{"random_loss":1},)"
                        R"("in_flight":2,"delay_ms":null,"late_us":null})";
const std::string good = R"({"ok":true,"frame":1,"at_ns":1000,"elapsed_s":2.5,"generation":3,)"
                         R"("paths":[{"name":"","up":)" +
                         way + R"(,"down":)" + way + "}]}";

/// `good` with this in place of that.
std::string with(const std::string& that, const std::string& instead)
{
    std::string text = good;
    return text.replace(text.find(that), that.size(), instead);
}

TEST(WebFrames, OfAnEmulatorAreRead)
{
    const auto frame = parse_emulator_frame(good);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->generation, 3U);
    EXPECT_EQ(frame->elapsed_s, 2.5);
    ASSERT_EQ(frame->paths.size(), 1U);
    EXPECT_EQ(frame->paths[0].up.dropped_share(), 0.25);
}

TEST(WebFrames, RefuseNonsenseFromADaemon)
{
    for (const std::string& line :
         {std::string{}, std::string{"{}"}, std::string{"[1]"}, std::string(70'000, ' ') + good,
          good.substr(0, good.size() / 2), good + "x", with("\"at_ns\":1000", "\"at_ns\":\"now\""),
          with("1000", "1e300"), with("\"paths\":[", "\"paths\":[7,"),
          with("\"random_loss\":1", "\"random_loss\":\"many\""),
          with("\"name\":\"\"", "\"name\":7"), with("\"elapsed_s\":2.5", "\"elapsed_s\":1e300"),
          std::string(100, '[') + std::string(100, ']'),
          R"({"ok":false,"error":"no frames here"})" + std::string{}}) {
        EXPECT_FALSE(parse_emulator_frame(line)) << line.substr(0, 200);
        EXPECT_FALSE(parse_peer_frame(line)) << line.substr(0, 200);
    }
}

TEST(WebFrames, TakeNoMarkupInTheNameOfAPath)
{
    const auto frame = parse_emulator_frame(with("\"name\":\"\"", R"("name":"<b> x")"));
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->paths[0].name, "_b>_x");
}

} // namespace
} // namespace hapnet::web
