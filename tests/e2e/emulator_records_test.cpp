// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The files that the emulator writes in a run, and those that it reads again.
#include "tests/e2e/emulator.hpp"
#include "tests/e2e/udp.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <vector>

namespace hapnet::e2e {

namespace {

using namespace std::chrono_literals;

/// The datagrams that get through, both ways, an emulator that writes its fates to `path`.
struct Crossing {
    std::vector<std::uint64_t> up;
    std::vector<std::uint64_t> down;
    std::string fates;
};

Crossing cross(const std::string& path, std::vector<std::string> options)
{
    constexpr std::uint64_t count = 400;
    Host a;
    Host b;
    options.insert(options.end(),
                   {"--a", a.endpoint().to_text(), "--b", b.endpoint().to_text(), "--fates", path});
    Emulator emulator{options};
    stream(a, emulator.a(), count, 500us);
    stream(b, emulator.b(), count, 500us);
    Crossing crossing{numbers_of(b.receive(count, 300ms)), numbers_of(a.receive(count, 300ms)), {}};
    EXPECT_EQ(emulator.stop()["fates_lost"], 0);
    crossing.fates = text_of(path);
    return crossing;
}

/// The rows of one direction, up to and with their `columns`-th column.
std::vector<std::string> rows_of(const std::string& fates, std::string_view direction,
                                 std::size_t columns)
{
    std::vector<std::string> rows;
    std::istringstream lines{fates};
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with(direction)) continue;
        std::size_t end = 0;
        for (std::size_t i = 0; i < columns; ++i) end = line.find(',', end + 1);
        rows.push_back(line.substr(0, end));
    }
    return rows;
}

} // namespace

TEST(EmulatorRecords, OnAFullDiskAreMissedOnceAndInTheSummaryAndTheRunGoesOn)
{
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
    const auto outcome = run("hapnet-emulator",
                             {"--listen-a", "127.0.0.1:0", "--listen-b", "127.0.0.1:0", "--pcap",
                              "/dev/full", "--duration", "1s", "--stats", "-"},
                             10s);
    EXPECT_EQ(outcome.exit, 3) << outcome.err;
    // The statistics are written all the same.
    const auto statistics = nlohmann::json::parse(outcome.out.substr(outcome.out.find('\n')));
    EXPECT_EQ(statistics["valid"], false);
    EXPECT_EQ(statistics["invalid_because"][0], "files: a file of this run could not be written");
    for (const char* said : {"cannot be written any more", "NOT COMPLETE", "No space left"}) {
        const auto at = outcome.err.find(said);
        EXPECT_NE(at, std::string::npos) << said << "\n" << outcome.err;
        EXPECT_EQ(outcome.err.find(said, at + 1), std::string::npos) << said;
    }
}

TEST(EmulatorRecords, FatesThatAreEqualForEqualSeedsAndCanBeReplayed)
{
    const TemporaryFolder folder;
    const std::string first = folder.file("first.csv");
    const std::vector<std::string> options{"--seed",  "7",    "--loss",   "30%",
                                           "--delay", "20ms", "--jitter", "5ms"};
    const Crossing original = cross(first, options);
    EXPECT_EQ(std::count(original.fates.begin(), original.fates.end(), '\n'), 801);
    EXPECT_EQ(cross(folder.file("second.csv"), options).fates, original.fates);

    const Crossing replayed = cross(folder.file("third.csv"), {"--seed", "8", "--replay", first});
    EXPECT_EQ(replayed.fates, original.fates);
    EXPECT_EQ(replayed.up, original.up);
    EXPECT_EQ(replayed.down, original.down);
    EXPECT_NE(original.up, original.down);
}

TEST(EmulatorRecords, FatesThatAreTheSameWhateverElseIsSwitchedOn)
{
    constexpr std::size_t all = 10;
    constexpr std::size_t to_delay = 6; // the columns after it belong to stages after the delay
    const TemporaryFolder folder;
    const std::vector<std::string> options{
        "--seed",   "7",
        "--loss",   R"(["20%", { law = "gilbert", share = "10%", mean_burst = 3 }])",
        "--delay",  "20ms",
        "--jitter", "5ms"};
    const auto with = [&](const char* name, const std::vector<std::string>& more) {
        auto words = options;
        words.insert(words.end(), more.begin(), more.end());
        return cross(folder.file(name), words).fates;
    };
    const auto plain = with("plain.csv", {});
    ASSERT_EQ(rows_of(plain, "up,", all).size(), 400U);

    const auto other_way =
        with("way.csv", {"--pcap", folder.file("run.pcapng"), "--control", folder.file("socket"),
                         "--timing", "eco", "--down.loss", "80%", "--down.delay", "5ms"});
    EXPECT_EQ(rows_of(other_way, "up,", all), rows_of(plain, "up,", all));
    EXPECT_NE(rows_of(other_way, "down,", all), rows_of(plain, "down,", all));

    const auto stages =
        with("stages.csv",
             {"--mtu", "1400B", "--rate", "1Gbit/s", "--duplicate", "20%", "--corrupt", "20%",
              "--reorder", "{ share = \"5%\", displacement = 3 }", "--order", "free"});
    EXPECT_NE(rows_of(stages, "up,", all), rows_of(plain, "up,", all));
    for (const char* direction : {"up,", "down,"}) {
        EXPECT_EQ(rows_of(stages, direction, to_delay), rows_of(plain, direction, to_delay));
    }
}

TEST(EmulatorRecords, FatesThatCannotBeReadAreRefusedWithTheirPlace)
{
    const TemporaryFolder folder;
    const std::string path = folder.file("wrong.csv");
    std::ofstream{path} << "not,fates\n";
    Process emulator{"hapnet-emulator",
                     {"--listen-a", "127.0.0.1:0", "--listen-b", "127.0.0.1:0", "--replay", path}};
    EXPECT_EQ(emulator.wait_exit(5s), 2);
    EXPECT_NE(emulator.err().find(path + ": line 1: expected 'direction,number,"),
              std::string::npos)
        << emulator.err();
}

TEST(EmulatorRecords, ACaptureThatTsharkReads)
{
    if (std::system("command -v tshark >/dev/null 2>&1") != 0) {
        GTEST_SKIP() << "tshark is not installed";
    }
    const TemporaryFolder folder;
    const std::string path = folder.file("run.pcapng");
    Host a;
    Host b;
    Emulator emulator{{"--a", a.endpoint().to_text(), "--b", b.endpoint().to_text(), "--up.delay",
                       "20ms", "--down.loss", "100%", "--pcap", path}};
    const auto ports =
        std::to_string(a.endpoint().port()) + "\t" + std::to_string(emulator.a().port());
    stream(a, emulator.a(), 20, 1ms);
    stream(b, emulator.b(), 20, 1ms);
    EXPECT_EQ(b.receive(20, 500ms).size(), 20U);
    EXPECT_EQ(emulator.stop()["capture_lost"], 0);

    const std::string command =
        "tshark -X 'lua_script:" HAPNET_DISSECTOR "' -r '" + path +
        "' -o udp.check_checksum:TRUE -T fields -e frame.interface_name -e udp.srcport"
        " -e udp.dstport -e udp.checksum.status -e frame.comment -e hapnet.fate -e hapnet.delay_ms"
        " -e hapnet.cause 2>/dev/null";
    FILE* const pipe = popen(command.c_str(), "r");
    ASSERT_NE(pipe, nullptr);
    std::string printed;
    std::array<char, 4096> part{};
    while (const auto count = std::fread(part.data(), 1, part.size(), pipe)) {
        printed.append(part.data(), count);
    }
    pclose(pipe);
    int delayed = 0;
    int late = 0;
    int dropped = 0;
    std::istringstream lines{printed};
    for (std::string line; std::getline(lines, line);) {
        if (line == "side A\t" + ports + "\t1\tdelayed 20.0 ms\tdelayed\t20\t") ++delayed;
        if (!line.starts_with("side B\t")) continue;
        if (line.find("\t1\tlate ") != std::string::npos && line.ends_with("\tleft\t\t")) ++late;
        if (line.ends_with("\t1\tdropped: random-loss\tdropped\t\trandom-loss")) ++dropped;
    }
    EXPECT_EQ(delayed, 20) << printed;
    EXPECT_EQ(late, 20) << printed;
    EXPECT_EQ(dropped, 20) << printed;
}

} // namespace hapnet::e2e
