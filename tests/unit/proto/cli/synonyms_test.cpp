// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/cli/synonyms.hpp"

#include <gtest/gtest.h>

namespace hapnet::cli {
namespace {

/// A program with these options.
Command with_options(const std::string& name, const std::vector<std::string>& options)
{
    Command program{name};
    for (const std::string& option : options) {
        program.option(option, "VALUE", "",
                       [](const std::string&) -> base::Result<void> { return {}; });
    }
    return program;
}

TEST(Synonyms, OfOtherToolsAreAnsweredWithTheNameHere)
{
    const Command program = with_options(
        "hapnet-emulator", {"--rate", "--delay", "--loss", "--profile", "--listen-a", "--up.delay",
                            "--down.loss", "--reorder", "--corrupt", "--duration"});
    for (const auto& [typed, meant] : {
             std::pair{"--bandwidth", "--rate"},
             std::pair{"--bandwidth=10Mbit/s", "--rate"},
             std::pair{"--latency", "--delay"},
             std::pair{"--LATENCY", "--delay"},
             std::pair{"--up.latency", "--up.delay"},
             std::pair{"--both.delay", "--delay"},
             std::pair{"--down.packet_loss", "--down.loss"},
             std::pair{"--preset", "--profile"},
             std::pair{"--listen", "--listen-a"},
             std::pair{"--drop", "--loss"},
             std::pair{"--tamper", "--corrupt"},
             std::pair{"--ood", "--reorder"},
             std::pair{"--time", "--duration"},
             std::pair{"-delay", "--delay"},
             std::pair{"--dry-run", "hapnet-emulator check"},
             std::pair{"--dealy", "--delay"},
         }) {
        const std::string said = unknown_option(program, typed);
        EXPECT_NE(said.find(std::string{": did you mean "} + meant + "?"), std::string::npos)
            << said;
    }
    EXPECT_EQ(unknown_option(program, "--bandwidth"),
              "unknown option --bandwidth: did you mean --rate?");
}

TEST(Synonyms, AreProposedOnlyWhereTheProgramHasThem)
{
    const Command program = with_options("hapnet-peer", {"--remote", "--listen"});
    EXPECT_EQ(unknown_option(program, "--bandwidth"),
              "unknown option --bandwidth: hapnet-peer --help lists the options");
    EXPECT_EQ(unknown_option(program, "--dry-run"),
              "unknown option --dry-run: hapnet-peer --help lists the options");
    EXPECT_EQ(unknown_option(program, "--port"), "unknown option --port: did you mean --listen?");
}

TEST(Synonyms, OfCommandsAreAnsweredWithWhatToType)
{
    Command program{"hapnet-emulator"};
    program.command("check", "");
    program.command("predict", "");
    EXPECT_EQ(unknown_command(program, "start"),
              "unknown command 'start': did you mean hapnet-emulator --listen-a ADDRESS "
              "--listen-b ADDRESS?");
    EXPECT_EQ(unknown_command(program, "simulate"),
              "unknown command 'simulate': did you mean hapnet-emulator predict?");
    EXPECT_EQ(unknown_command(program, "chekc"),
              "unknown command 'chekc': did you mean hapnet-emulator check?");
    EXPECT_EQ(unknown_command(program, "zzz"),
              "unknown command 'zzz': commands are check, predict");
}

TEST(Synonyms, OfValuesAreUnderstoodOrAnsweredByName)
{
    EXPECT_EQ(meant_value("--algorithm", "dr").value(), "dead-reckoning");
    EXPECT_EQ(meant_value("--algorithm", "DR").value(), "dead-reckoning");
    EXPECT_EQ(meant_value("--algorithm", "mine.toml").value(), "mine.toml");
    EXPECT_EQ(meant_value("--task", "dr").value(), "dr");
    EXPECT_EQ(meant_value("--algorithm", "TiDeC").error().message,
              "'TiDeC': TiDeC is not open; sep is its open stand-in: --algorithm sep");
}

} // namespace
} // namespace hapnet::cli
