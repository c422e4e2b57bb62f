// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The programs when their output finds no room: on a full disk (/dev/full), and beyond the limit of
// a user (ulimit -f).
#include "tests/e2e/process.hpp"

#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <sys/wait.h>
#include <vector>

namespace hapnet::e2e {

namespace {

const std::string relays_briefly =
    "hapnet-emulator --listen-a 127.0.0.1:0 --listen-b 127.0.0.1:0 --duration 50ms";
/// Options for a peer whose partner does not come.
const std::string waits_briefly =
    "timeout --preserve-status -s TERM 2 hapnet-peer --remote 127.0.0.1:9";

/// The output of a shell command, and its exit code: 128 + n after signal n.
struct Said {
    int exit = -1;
    std::string text;
};

Said shell(const std::string& command)
{
    const std::string all = "PATH='" HAPNET_BIN_DIR "':$PATH; " + command;
    FILE* const pipe = popen(all.c_str(), "r"); // NOLINT(cert-env33-c): its words are ours
    Said said;
    if (pipe == nullptr) return said;
    std::array<char, 4096> part{};
    while (const auto count = std::fread(part.data(), 1, part.size(), pipe))
        said.text.append(part.data(), count);
    const int status = pclose(pipe);
    said.exit = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return said;
}

void expect_said(const Said& said, const std::vector<std::string>& words)
{
    for (const std::string& word : words)
        EXPECT_NE(said.text.find(word), std::string::npos) << word << "\n" << said.text;
}

nlohmann::json json_in(const std::string& text)
{
    const auto begin = text.find("\n{\n");
    const auto end = text.find("\n}\n", begin);
    if (begin == std::string::npos || end == std::string::npos) return nullptr;
    return nlohmann::json::parse(text.substr(begin, end + 2 - begin), nullptr, false);
}

} // namespace

TEST(Limits, AFullStandardOutputIsNamedWithItsReason)
{
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
    const std::vector<std::string> commands{
        "hapnet-emulator --help", "hapnet-peer --help",
        "hapnet-lab --help",      "hapnet-ctl --help",
        relays_briefly,           "hapnet-emulator probe --answer 127.0.0.1:0"};
    for (const std::string& command : commands) {
        const Said said = shell("exec timeout 20 " + command + " 2>&1 >/dev/full");
        EXPECT_EQ(said.exit, 3) << command << "\n" << said.text;
        expect_said(said, {"No space left on device"});
        EXPECT_EQ(said.text.find("unavailable"), std::string::npos) << said.text;
    }
}

TEST(Limits, AFileBeyondThatOfTheUserIsAnErrorAndKillsNoProgram)
{
    const TemporaryFolder folder;
    const std::string file = folder.file("out");
    for (const char* program : {"hapnet-emulator", "hapnet-peer", "hapnet-lab", "hapnet-ctl"}) {
        const Said said =
            shell(std::string{"ulimit -f 0; exec "} + program + " --help 2>&1 >'" + file + "'");
        EXPECT_EQ(said.exit, 3) << program << "\n" << said.text;
        expect_said(said, {"File too large", "ulimit -f"});
    }
}

TEST(Limits, StatisticsThatFindNoRoomGoToStandardOutput)
{
    const TemporaryFolder folder;
    const std::string file = folder.file("stats.json"), errors = folder.file("errors");
    const std::string options = " --stats '" + file + "' 2>'" + errors + "'";
    for (const std::string program : {"hapnet-emulator", "hapnet-peer"}) {
        const Said said =
            shell("ulimit -f 4; exec " +
                  (program == "hapnet-peer" ? waits_briefly : relays_briefly) + options);
        EXPECT_EQ(said.exit, 3) << said.text;
        EXPECT_EQ(json_in(said.text).value("program", ""), program) << said.text;
        const auto told = text_of(errors);
        EXPECT_NE(told.find("cannot write " + file + ": File too large"), std::string::npos)
            << told;
        EXPECT_EQ(folder.names(), std::vector<std::string>{"errors"});
    }
}

TEST(Limits, ARecordThatFindsNoRoomIsCountedAndTheSessionGoesOn)
{
    const TemporaryFolder folder;
    const std::string file = folder.file("a.rec"), errors = folder.file("errors");
    const Said said = shell("ulimit -f 100; exec " + waits_briefly + " --stats - --record '" +
                            file + "' 2>'" + errors + "'");
    EXPECT_EQ(said.exit, 3) << said.text;
    const auto told = text_of(errors);
    EXPECT_NE(told.find("the record ends here, and the session goes on without it"),
              std::string::npos)
        << told;
    const auto statistics = json_in(said.text);
    ASSERT_TRUE(statistics.is_object()) << said.text;
    EXPECT_EQ(statistics["record_whole"], false);
    EXPECT_EQ(statistics["valid"], false);
    const auto ticks = statistics["tick"]["count"].get<std::uint64_t>();
    EXPECT_GT(statistics["record_rows_lost"].get<std::uint64_t>(), ticks / 2);
    EXPECT_LE(std::filesystem::file_size(file), 100U * 1024U);
}

} // namespace hapnet::e2e
