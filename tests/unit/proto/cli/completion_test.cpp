// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/cli/completion.hpp"

#include <gtest/gtest.h>
#include <span>
#include <string>
#include <vector>

namespace hapnet::cli {
namespace {

/// A program with a choice, a file, a flag and a command.
class Completion : public ::testing::Test {
protected:
    Completion()
    {
        const Take nothing = [](const std::string&) -> base::Result<void> { return {}; };
        program_.describe("Relays datagrams.");
        program_.option("--timing", "eco|precise|TIME", "It's how it waits: [a] or b", nothing);
        program_.option("-p,--profile", "FILE", "Conditions", nothing);
        program_.flag("-q,--quiet", "Says less", is_quiet_);
        program_.command("check", "Says what a profile does")
            .option("--set", "KEY=VALUE", "A setting", nothing);
    }

    [[nodiscard]] std::string of(Shell shell) const { return completion(program_, shell); }

    Command program_{"hap-relay"};

private:
    bool is_quiet_ = false;
};

TEST_F(Completion, OffersInBashTheWordsThatAnOptionTakes)
{
    const auto text = of(Shell::bash);
    EXPECT_NE(text.find("--timing) COMPREPLY=($(compgen -W 'eco precise' "), std::string::npos)
        << text;
    EXPECT_NE(text.find("-p|--profile) return ;;"), std::string::npos) << "files: " << text;
    EXPECT_NE(text.find("complete -o default -F _hap_relay hap-relay"), std::string::npos);
}

TEST_F(Completion, KeepsTextInQuotesOfEachShell)
{
    EXPECT_NE(of(Shell::zsh).find("--timing[It'\\''s how it waits\\: \\[a\\] or b]"),
              std::string::npos)
        << of(Shell::zsh);
    EXPECT_NE(of(Shell::fish).find("-l timing -x -a 'eco precise' -d 'It'\\''s how"),
              std::string::npos)
        << of(Shell::fish);
}

TEST_F(Completion, KnowsTheOptionsOfACommand)
{
    EXPECT_NE(of(Shell::fish).find("-n '__fish_seen_subcommand_from check' -l set -r"),
              std::string::npos)
        << of(Shell::fish);
    EXPECT_NE(of(Shell::bash).find("    check)\n"), std::string::npos) << of(Shell::bash);
}

TEST_F(Completion, IsPrintedByTheProgramItself)
{
    std::string name = "hap-relay";
    std::string generate = "--generate";
    std::string shell = "bash";
    std::vector<char*> words{name.data(), generate.data(), shell.data()};
    const auto text = program_.parse(words);
    ASSERT_TRUE(text.has_value());
    EXPECT_EQ(*text, of(Shell::bash));
    std::string other = "perl";
    words[2] = other.data();
    const auto refused = program_.parse(words);
    ASSERT_FALSE(refused.has_value());
    EXPECT_NE(refused.error().message.find("man|bash|zsh|fish"), std::string::npos);
}

} // namespace
} // namespace hapnet::cli
