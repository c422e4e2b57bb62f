// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/table_text.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace hapnet::lab::results {
namespace {

Table sample_of_limits()
{
    Table table{"limits",
                {{"task"}, {"limit_ms", 2}, {"met"}, {"seed"}, {"scene", {}, Stands::if_filled}}};
    const std::optional<std::string> none;
    table.add("T1, \"fast\"", 94.0 / 3.0, true, 18446744073709551615U, none);
    table.add("T3\n", std::optional<double>{}, false, 1U, none);
    return table;
}

TEST(TableText, RoundsInCsvAndNotInJson)
{
    EXPECT_EQ(csv_text(sample_of_limits()), "task,limit_ms,met,seed\n"
                                            "\"T1, \"\"fast\"\"\",31.33,true,18446744073709551615\n"
                                            "\"T3\n\",,false,1\n");
    const auto json = nlohmann::json::parse(json_text(std::vector{sample_of_limits()}));
    EXPECT_EQ(json.at("version"), 1);
    const auto& table = json.at("tables").at("limits");
    EXPECT_EQ(table.at("columns")[1].dump(),
              R"({"decimals":2,"key":"limit_ms","label":"limit","unit":"ms"})");
    EXPECT_EQ(table.at("columns").size(), 4U) << "no row fills the scene";
    EXPECT_EQ(table.at("rows")[0][1].get<double>(), 94.0 / 3.0);
    EXPECT_EQ(table.at("rows")[1].dump(), R"(["T3\n",null,false,1])");
}

TEST(TableText, LeavesOutOfCsvWhatStandsInJsonAlone)
{
    Table table{"t", {{"low", {}, Stands::in_json}, {"a"}, {"high", {}, Stands::in_json}}};
    table.add(1.0, 2.0, 3.0);
    EXPECT_EQ(csv_text(table), "a\n2\n");
    EXPECT_EQ(aligned_text(table), "a\n2\n");
    const auto json = nlohmann::json::parse(json_text(std::vector{table}));
    EXPECT_EQ(json["tables"]["t"]["rows"].dump(), "[[1,2,3]]");
}

TEST(TableText, ReadsWhatItHasWritten)
{
    const Table other{"none", {{"a"}}};
    const auto text = json_text(std::vector{sample_of_limits(), other});
    const auto tables = read_tables(text, "results.json");
    ASSERT_TRUE(tables) << tables.error().message;
    EXPECT_EQ(json_text(*tables), text);
    EXPECT_EQ(csv_text(tables->front()), csv_text(sample_of_limits()));
}

TEST(TableText, RefusesWhatItWouldNotWrite)
{
    const auto refusal = [](std::string_view text) {
        const auto tables = read_tables(text, "r/results.json");
        EXPECT_FALSE(tables) << text;
        return tables ? "" : tables.error().message;
    };
    const std::string begin = "r/results.json: not what this version of hapnet-lab writes: ";
    EXPECT_EQ(refusal("[1"), begin + "it holds no object of JSON");
    EXPECT_EQ(refusal("{}"), begin + "its version is not 1");
    EXPECT_EQ(refusal(R"({"version":2,"tables":{}})"), begin + "its version is not 1");
    EXPECT_EQ(refusal(R"({"version":1,"tables":{"t":{"columns":[]}}})"),
              begin + "a table lacks its columns or rows");
    EXPECT_EQ(refusal(R"({"version":1,"tables":{"t":{"columns":[{"key":"a"}],"rows":[[1,2]]}}})"),
              begin + "a row of 't' has not a cell for each column");
}

TEST(TableText, AlignsItsColumnsForPeople)
{
    Table table{"t", {{"a"}, {"wide", 1}}};
    table.add("long word", 2.0);
    EXPECT_EQ(aligned_text(table), "a          wide\nlong word  2.0\n");
}

} // namespace
} // namespace hapnet::lab::results
