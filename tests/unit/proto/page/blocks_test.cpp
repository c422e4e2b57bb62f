// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/page/blocks.hpp"

#include <gtest/gtest.h>

namespace hapnet::page {
namespace {

TEST(Blocks, HaveOneKeyThatSaysWhatTheyAre)
{
    EXPECT_EQ(paragraph("a").dump(), R"({"p":"a"})");
    EXPECT_EQ(preformatted("a\n b").dump(), R"({"pre":"a\n b"})");
    EXPECT_EQ(banner("met", "a", {"b"}).dump(), R"({"banner":"a","style":"met","list":["b"]})");
    EXPECT_EQ(bold("a").dump(), R"({"b":"a"})");
    EXPECT_EQ(panels("small", Json::array()).dump(), R"({"panels":"small","blocks":[]})");
}

TEST(Blocks, TablesStyleOnlyTheCellsThatHaveAStyle)
{
    const Table table{"caption", {"a", "b"}, {{{"row"}, {"1", "ours"}}}};
    EXPECT_EQ(json_of(table).dump(), R"({"table":{"caption":"caption","heads":["a","b"],)"
                                     R"("rows":[["row",{"text":"1","style":"ours"}]]}})");
}

} // namespace
} // namespace hapnet::page
