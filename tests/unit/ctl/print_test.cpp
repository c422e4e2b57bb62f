// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "ctl/print.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace hapnet::ctl {
namespace {

using Json = nlohmann::ordered_json;

const Json emulator{{"elapsed_s", 2.0},
                    {"generation", 1},
                    {"up", {{"received", 2000}, {"delivered", 1990}, {"dropped", {{"burst", 10}}}}},
                    {"down", {{"received", 5}}}};
const Json peer{{"program", "hapnet-peer"},
                {"elapsed_s", 2.0},
                {"messages", {{"states_sent", 9}, {"states_received", 2000}}},
                {"governor", {{"state", "ready"}, {"fault", nullptr}}}};

TEST(WatchPrinter, PrintsKeysAndValuesWhenPiped)
{
    WatchPrinter printer{/*is_terminal*/ false};
    const std::string line = printer.next(emulator);
    EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1);
    EXPECT_NE(line.find(" up.per_s=1000 up.received=2000 up.delivered=1990 up.dropped=10 "),
              std::string::npos)
        << line;
    EXPECT_EQ(line.find('\x1b'), std::string::npos);
    EXPECT_NE(WatchPrinter{false}.next(peer).find(" received_per_s=1000 governor=ready "),
              std::string::npos);
}

TEST(WatchPrinter, OverwritesItsLastTableOnATerminal)
{
    for (const Json& statistics : {emulator, peer}) {
        WatchPrinter printer{/*is_terminal*/ true};
        const std::string first = printer.next(statistics);
        EXPECT_EQ(first.rfind("2 s, ", 0), 0U) << first;
        const auto lines = std::count(first.begin(), first.end(), '\n');
        const std::string back = "\x1b[" + std::to_string(lines) + "A";
        EXPECT_EQ(printer.next(statistics).rfind(back, 0), 0U);
    }
}

} // namespace
} // namespace hapnet::ctl
