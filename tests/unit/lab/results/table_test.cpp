// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/table.hpp"

#include "lab/results/session_rows.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace hapnet::lab::results {
namespace {

Table limits()
{
    Table table{"limits", {{"task"}, {"limit", 2}, {"seeds"}, {"scene", {}, Stands::if_filled}}};
    table.add("T1", 94.5, 3U, std::optional<std::string>{});
    table.add("T3", std::numeric_limits<double>::infinity(), 3U, std::optional<std::string>{});
    return table;
}

TEST(Table, HasCellsByTheKeysOfItsColumns)
{
    const Table table = limits();
    const Rows rows = rows_of(table);
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].text("task"), "T1");
    EXPECT_EQ(rows[0].number("limit"), 94.5);
    EXPECT_EQ(rows[0].number("seeds"), 3.0);
    EXPECT_EQ(rows[0].number("task"), std::nullopt);
    EXPECT_EQ(rows[0].number("hands"), std::nullopt) << "there is no such column";
    EXPECT_EQ(rows[1].number("limit"), std::nullopt) << "it is not finite";
    EXPECT_EQ(rows[1].text("limit"), "");
}

TEST(Table, HasAColumnForEachFieldOfAStruct)
{
    SessionRow session;
    session.seed = 7;
    session.mean_mm = 1.0 / 3.0;
    session.tier = metrics::Tier::usable;
    const Table table = table_of("sessions", std::vector{session});
    const TableRow row{table, 0};
    EXPECT_EQ(row.number("seed"), 7.0);
    EXPECT_EQ(row.number("mean_mm"), 1.0 / 3.0);
    EXPECT_EQ(table.columns[*table.place_of("mean_mm")].decimals, 3);
    EXPECT_EQ(row.text("tier"), "usable");
    EXPECT_EQ(row.number("std_mm"), std::nullopt);
    EXPECT_EQ(table.columns[*table.place_of("force_above_2hz_n")].stands, Stands::if_filled);
}

TEST(Table, IsFilledWithoutTheSpareColumnsThatNoRowHas)
{
    EXPECT_EQ(filled(limits()).columns.size(), 3U);
    Table table = limits();
    table.add("T7", 20.0, 1U, std::optional<std::string>{"carry"});
    EXPECT_EQ(filled(table).columns.size(), 4U);
}

TEST(Table, TakesThePartsOfSeveralWhoseColumnsDiffer)
{
    Table all{"t", {}};
    Table first{"t", {{"a"}, {"b"}}}, second{"t", {{"a"}, {"c"}}};
    first.add(1U, 2U);
    second.add(3U, "x");
    append(all, with_leading({{"value", "1ms"}}, first));
    append(all, with_leading({{"value", "2ms"}}, second));
    append(all, with_leading({{"value", "1ms"}}, first));
    ASSERT_EQ(all.columns.size(), 4U);
    EXPECT_EQ(all.columns[3].key, "c");
    const Rows rows = rows_of(all);
    EXPECT_EQ(rows[0].text("value") + rows[0].text("b") + rows[0].text("c"), "1ms2");
    EXPECT_EQ(rows[1].text("value") + rows[1].text("b") + rows[1].text("c"), "2msx");
    EXPECT_EQ(rows[2].number("a"), 1.0);
}

TEST(Columns, StandInALineWithTheirDecimalsAndWhereTheyStand)
{
    const auto columns = columns_in("task,mean_mm:3,scene?,turned_deg:2?,band+");
    ASSERT_EQ(columns.size(), 5U);
    EXPECT_EQ(columns[0].key, "task");
    EXPECT_EQ(columns[0].decimals, std::nullopt);
    EXPECT_EQ(columns[0].stands, Stands::always);
    EXPECT_EQ(columns[1].key, "mean_mm");
    EXPECT_EQ(columns[1].decimals, 3);
    EXPECT_EQ(columns[2].stands, Stands::if_filled);
    EXPECT_EQ(columns[3].key, "turned_deg");
    EXPECT_EQ(columns[3].decimals, 2);
    EXPECT_EQ(columns[4].key, "band");
    EXPECT_EQ(columns[4].stands, Stands::in_json);
}

TEST(Columns, SayTheirUnitAndWordsByTheirKey)
{
    EXPECT_EQ(unit_of("paper_mean_mm"), "mm");
    EXPECT_EQ(label_of("paper_mean_mm"), "paper mean");
    EXPECT_EQ(unit_of("loss_percent"), "%");
    EXPECT_EQ(unit_of("burst_of_100"), "of 100");
    EXPECT_EQ(unit_of("seeds"), "");
    EXPECT_EQ(label_of("limited_by"), "limited by");
}

} // namespace
} // namespace hapnet::lab::results
