// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "ctl/print.hpp"

#include <algorithm>
#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::ctl {
namespace {

using Json = nlohmann::ordered_json;

const Json emulator{{"elapsed_s", 2.0},
                    {"generation", 1},
                    {"up",
                     {{"received", 2000},
                      {"delivered", 1990},
                      {"dropped", {{"burst", 10U}}},
                      {"in_flight", 3},
                      {"lateness_us", {{"p99", 84.5}}}}},
                    {"down", {{"received", 5}}}};
const Json peer{{"program", "hapnet-peer"},
                {"peer_id", 2},
                {"elapsed_s", 2.0},
                {"messages", {{"states_sent", 9}, {"states_received", 2000}}},
                {"governor", {{"state", "ready"}, {"fault", nullptr}}}};

TEST(WatchPrinter, PrintsKeysAndValuesWhenPiped)
{
    WatchPrinter printer{/*is_terminal*/ false};
    const std::string line = printer.next(emulator);
    EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1);
    EXPECT_NE(line.find(" up.per_s=1000 up.received=2000 up.delivered=1990 up.dropped=10 "
                        "up.in_flight=3 up.late_p99_us=84.5 "),
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

Options asked(const std::string& command)
{
    Options options;
    options.command = command;
    return options;
}

TEST(InWords, TellsHowLongWasWaited)
{
    Options options = asked("wait");
    options.timeout = std::chrono::milliseconds{200};
    Json reply{{"until", "up.received>1000"}, {"met", false}, {"elapsed_s", 2.43949}};
    EXPECT_EQ(in_words(options, reply),
              "up.received>1000: not met within 200ms (2.44 s after the start)\n");
    reply["met"] = true;
    EXPECT_EQ(in_words(options, reply), "up.received>1000: met 2.44 s after the start\n");
}

TEST(InWords, TellsAPeerInVirtualTimeFromTheEmulatorBesideIt)
{
    Json reply{{"program", "hapnet-lab"}, {"peer_id", 2},       {"task", "T3"},
               {"elapsed_s", 3.25},       {"state", "running"}, {"says", "plays in virtual time"}};
    const std::string shown = in_words(asked("show"), reply);
    EXPECT_EQ(shown.rfind("hapnet-lab, peer 2, started 3.25 s ago, running: plays in virtual "
                          "time\ntask T3, ",
                          0),
              0U)
        << shown;
    Json statistics = peer;
    statistics["program"] = "hapnet-lab";
    EXPECT_EQ(WatchPrinter{false}.next(statistics), WatchPrinter{false}.next(peer));
    reply.erase("peer_id");
    EXPECT_EQ(in_words(asked("show"), reply).rfind("# generation ", 0), 0U);
}

TEST(InWords, TellsTheTimeOfThePeerFromThatOfItsSession)
{
    Json reply{{"program", "hapnet-peer"},
               {"peer_id", 1},
               {"elapsed_s", 1.514},
               {"state", "running"},
               {"says", "in session"},
               {"session", {{"number", 7}, {"role", "L"}, {"at_s", 0.458848}}}};
    const std::string running = in_words(asked("show"), reply);
    EXPECT_EQ(running.rfind("hapnet-peer 1, started 1.51 s ago, running: in session\n", 0), 0U)
        << running;
    EXPECT_NE(running.find("\nsession 7 as A, 0.46 s after its start\n"), std::string::npos);
    reply["session"]["at_s"] = -0.5;
    reply["session"]["role"] = "R";
    EXPECT_NE(in_words(asked("show"), reply).find("as B, 0.50 s before its start\n"),
              std::string::npos);
}

TEST(InWords, CountsThePathsOfAChangeWhereTheyAreMany)
{
    Json reply{{"generation", 2},
               {"changed", true},
               {"elapsed_s", 0.24},
               {"effective_at", Json::object()}};
    for (const char* path : {"1-2", "1-3", "2-3", "1-4"})
        reply["effective_at"][path] = {{"up", 5}, {"down", 1}};
    EXPECT_NE(in_words(asked("set"), reply).find("datagram 5 up and 1 down of 1-4, "),
              std::string::npos);
    reply["effective_at"]["2-4"] = {{"up", 5}, {"down", 1}};
    EXPECT_EQ(in_words(asked("set"), reply),
              "generation 2 holds from the next datagrams of 5 paths, which --json names, 0.24 s "
              "after the start\n");
}

TEST(InWords, TellsFromWhenAChangeHolds)
{
    Json reply{{"generation", 2},
               {"changed", true},
               {"elapsed_s", 0.24},
               {"effective_at", {{"up", 5}, {"down", 1}}}};
    EXPECT_EQ(in_words(asked("set"), reply),
              "generation 2 holds from datagram 5 up (A to B) and datagram 1 down (B to A), "
              "0.24 s after the start\n");
    reply["changed"] = false;
    EXPECT_EQ(in_words(asked("reset"), reply), "nothing changed: generation 2 still holds\n");
}

} // namespace
} // namespace hapnet::ctl
