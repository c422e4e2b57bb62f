// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/page/blocks.hpp"

#include <gtest/gtest.h>

namespace hapnet::page {
namespace {

TEST(Blocks, HaveOneKeyThatSaysWhatTheyAre)
{
    EXPECT_EQ(paragraph("a").dump(), R"({"p":"a"})");
    EXPECT_EQ(heading("a").dump(), R"({"heading":"a"})");
    EXPECT_EQ(preformatted("a\n b").dump(), R"({"pre":"a\n b"})");
    EXPECT_EQ(banner("met", "a", {"b"}).dump(), R"({"banner":"a","style":"met","list":["b"]})");
    EXPECT_EQ(folded("a", Json::array({heading("b")})).dump(),
              R"({"folded":"a","blocks":[{"heading":"b"}]})");
    EXPECT_EQ(panels("small", Json::array()).dump(), R"({"panels":"small","blocks":[]})");
    EXPECT_EQ(zoomed(Json::array()).dump(), R"({"zoomed":true,"blocks":[]})");
}

TEST(Blocks, TextsAreListsOfPiecesWithoutListsInside)
{
    const Json inner = text_of({"b ", bold("c")});
    EXPECT_EQ(text_of({"a ", inner, code("d"), link("e", "f"), badge("g", "met")}).dump(),
              R"(["a ","b ",{"b":"c"},{"code":"d"},{"a":"e","href":"f"},)"
              R"({"badge":"g","style":"met"}])");
}

TEST(Blocks, TablesStyleOnlyTheCellsThatHaveAStyle)
{
    const Table table{"caption", {"a", "b"}, {{{"row"}, {"1", "ours"}}}};
    EXPECT_EQ(json_of(table).dump(), R"({"table":{"caption":"caption","heads":["a","b"],)"
                                     R"("rows":[["row",{"text":"1","style":"ours"}]]}})");
}

} // namespace
} // namespace hapnet::page
