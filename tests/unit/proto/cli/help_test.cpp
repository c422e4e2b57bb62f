// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/cli/help.hpp"

#include <gtest/gtest.h>

namespace hapnet::cli {
namespace {

Take nothing()
{
    return [](const std::string&) -> base::Result<void> { return {}; };
}

TEST(Help, FillsLinesUpToTheWidth)
{
    EXPECT_EQ(filled("one two three\nfour five", 0, 13), "one two three\nfour five");
    EXPECT_EQ(filled("one two three\nfour five", 0, 12), "one two\nthree four\nfive");
    EXPECT_EQ(filled("one two", 3, 6), "   one\n   two");
}

TEST(Help, KeepsParagraphsExamplesAndLists)
{
    EXPECT_EQ(filled("one\n\ntwo\n  program --option that is long\nthree", 0, 10),
              "one\n\ntwo\n  program --option that is long\nthree");
    EXPECT_EQ(filled("  P1   one two three", 0, 14), "  P1   one two\n       three");
}

TEST(Help, HasUsageCommandsOptionsAndFooter)
{
    Command program{"relay"};
    program.describe("Relays datagrams.");
    program.add_footer("Units are mandatory.");
    program.add_exit_codes("  0  done");
    program.option("--place", "ADDRESS", "Where it listens", nothing()).required("here");
    program.option("-d,--delay", "TIME", "How long each datagram waits (default 0)", nothing());
    program.option("--up.delay", "TIME", "One way", nothing()).hidden();
    program.option("--seed", "NUMBER", "Seed for every random draw", nothing()).under("Chance");
    program.command("check", "Says what a profile does");
    EXPECT_EQ(help_text(program, 60), R"(Usage: relay --place ADDRESS [--delay TIME] [--seed NUMBER]
       relay COMMAND ...

Relays datagrams.

Commands (relay COMMAND --help says more):
  check                   Says what a profile does

Options:
  --place ADDRESS         Where it listens (required)
  -d, --delay TIME        How long each datagram waits
                          (default 0)
  -h, --help              Print this help and exit
  -V, --version           Print version, commit and
                          compiler, and exit
  --generate man|bash|zsh|fish
                          Print the manual page, for scdoc,
                          or what completes the command line
                          in a shell, and exit

Chance:
  --seed NUMBER           Seed for every random draw

Units are mandatory.

Exit codes:
  0  done
)");
    const std::string of_check = help_text(program.commands().front(), 60);
    EXPECT_NE(of_check.find("\nExit codes:\n  0  done\n"), std::string::npos) << of_check;
}

TEST(Help, EndsTheUsageLineWithWordsThatAreNotParsed)
{
    Command program{"relay"};
    program.command("wire", "Runs a command").add_usage("-- COMMAND [ARGUMENT ...]");
    const Command& wire = program.commands().front();
    EXPECT_EQ(usage(wire), "relay wire -- COMMAND [ARGUMENT ...]");
    EXPECT_EQ(help_text(wire, 60).rfind("Usage: relay wire -- COMMAND [ARGUMENT ...]\n", 0), 0U);
}

} // namespace
} // namespace hapnet::cli
