// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/cli/manual.hpp"

#include <gtest/gtest.h>

namespace hapnet::cli {
namespace {

Take any_text()
{
    return [](const std::string&) -> base::Result<void> { return {}; };
}

TEST(Manual, HasAllSectionsInTheOrderOfManPages)
{
    Command program{"relay"};
    program.describe("Relays datagrams.\nAnd waits.");
    program.add_footer("Examples:\n  relay --delay 5ms");
    program.add_exit_codes("  0  done");
    program.option("-d,--delay", "TIME", "How long each datagram waits", any_text());
    program.option("--secret", "TIME", "", any_text()).hidden();
    program.command("check", "Says what a profile does")
        .option("--set", "KEY=VALUE", "A setting", any_text());
    const auto page = manual(program);
    std::size_t place = 0;
    for (const char* heading :
         {"relay(1) ", "\n# NAME\n\nrelay - Relays datagrams\n", "\n# SYNOPSIS\n",
          "\n# DESCRIPTION\n", "\n# OPTIONS\n", "*\\-d*, *\\-\\-delay* TIME\n\tHow long",
          "\n# COMMANDS\n", "\n## check\n", "*\\-\\-set* KEY=VALUE", "\n# NOTES\n",
          "```\n  relay --delay 5ms\n```", "\n# EXIT STATUS\n"}) {
        const auto found = page.find(heading, place);
        ASSERT_NE(found, std::string::npos) << heading << "\n" << page;
        place = found;
    }
    EXPECT_EQ(page.find("secret"), std::string::npos) << "hidden options are left out";
}

TEST(Manual, TakesMarksInTextForLetters)
{
    Command program{"relay"};
    program.describe("Takes burst_loss and *.");
    EXPECT_NE(manual(program).find("Takes burst\\_loss and \\*\\."), std::string::npos)
        << manual(program);
}

} // namespace
} // namespace hapnet::cli
