// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "ctl/options.hpp"

#include "tests/support/cli/help_faults.hpp"

#include <gtest/gtest.h>

namespace hapnet::ctl {
namespace {

using namespace std::chrono_literals;
using Settings = std::vector<std::pair<std::string, std::string>>;

net::CommandLine<Options> parse(std::span<char*> words) { return parse_options(words, nullptr); }

std::string refusal(std::vector<std::string> words)
{
    return cli::refusal_of(parse, "hapnet-ctl", std::move(words));
}

Options options_of(std::vector<std::string> words, const char* default_socket = nullptr)
{
    cli::Typed typed{"hapnet-ctl", std::move(words)};
    return std::get<Options>(parse_options(typed.words(), default_socket).value());
}

TEST(CtlOptions, HaveACompleteHelp)
{
    EXPECT_EQ(cli::help_faults("hapnet-ctl", cli::prints_of("hapnet-ctl", parse)),
              std::vector<std::string>{});
}

TEST(CtlOptions, ShowTheSocketInTheUsageOfACommand)
{
    const auto prints = cli::prints_of("hapnet-ctl", parse);
    const std::string help = prints({"set", "--help"}).value();
    EXPECT_EQ(help.rfind("Usage: hapnet-ctl [SOCKET] set KEY VALUE ... [--for TIME]\n", 0), 0U);
    EXPECT_EQ(prints({"a.sock", "set", "--help"}), help);
}

TEST(CtlOptions, TakeSettingsAsPairsAndWithEqualsSigns)
{
    const Settings expected{{"both.delay", "10ms"}, {"up.loss", R"({ law = "random" })"}};
    EXPECT_EQ(
        options_of({"s", "set", "both.delay", "10ms", "up.loss", R"({ law = "random" })"}).settings,
        expected);
    EXPECT_EQ(options_of({"s", "set", "both.delay=10ms", R"(up.loss={ law = "random" })"}).settings,
              expected);
    EXPECT_EQ(options_of({"s", "set", "up.loss", R"(["5%", "40/100"])"}).settings,
              (Settings{{"up.loss", R"(["5%", "40/100"])"}}));
    EXPECT_EQ(refusal({"s", "set", "both.delay"}),
              "set: 'both.delay' has no value: write set both.delay VALUE");
    EXPECT_EQ(refusal({"s", "set"}),
              "KEY VALUE is required: hapnet-ctl SOCKET set both.delay 80ms");
}

TEST(CtlOptions, NameASpaceInASetting)
{
    EXPECT_EQ(refusal({"s", "set", "up.delay", "80", "ms"}),
              "set: 'ms' is not a setting: write up.delay 80ms, without a space");
    EXPECT_EQ(refusal({"s", "set", "up.delay", "=", "80ms"}),
              "set: write up.delay=80ms, without a space");
    EXPECT_EQ(refusal({"s", "set", "up.delay=", "80ms"}),
              "set: write up.delay=80ms, without a space");
    EXPECT_EQ(refusal({"s", "set", "up.delay", "=80ms"}),
              "set: write up.delay=80ms, without a space");
    EXPECT_EQ(refusal({"s", "set", "up.delay="}),
              "set: 'up.delay=' has no value: write set up.delay VALUE");
}

TEST(CtlOptions, TakeTheSocketInFrontAsAnOptionOrFromTheEnvironment)
{
    EXPECT_EQ(options_of({"a.sock", "show"}).socket, "a.sock");
    EXPECT_EQ(options_of({"-s", "a.sock", "show"}).socket, "a.sock");
    EXPECT_EQ(options_of({"show", "--socket", "a.sock"}).socket, "a.sock");
    EXPECT_EQ(options_of({"show", "a.sock"}).socket, "a.sock");
    EXPECT_EQ(options_of({"set", "delay", "1ms"}, "env.sock").socket, "env.sock");
    EXPECT_EQ(options_of({"a.sock", "show"}, "env.sock").socket, "a.sock");
    EXPECT_NE(refusal({"show"}).find("HAPNET_SOCKET"), std::string::npos);
    EXPECT_NE(refusal({"a", "show", "-s", "b"}).find("two sockets"), std::string::npos);
}

TEST(CtlOptions, NameTheOptionWhoseTimeHasNoUnit)
{
    EXPECT_EQ(
        refusal({"s", "set", "delay", "1ms", "--for", "5"}).rfind("--for: '5' has no unit", 0), 0U);
    EXPECT_EQ(options_of({"s", "set", "delay", "1ms", "--for", "5s"}).lasting, 5s);
    EXPECT_EQ(refusal({"s", "set", "delay", "1ms", "--for", "0s"}),
              "--for: '0s' is out of range: use 1ms to 24h");
    EXPECT_EQ(options_of({"s", "set", "delay", "1ms", "--for", "2h"}).lasting, 7200s);
    EXPECT_EQ(refusal({"s", "wait"}), "--until is required: --until 'up.received>1000'");
}

TEST(CtlOptions, AnswerAMistypedCommandByName)
{
    EXPECT_EQ(refusal({"s", "shwo"}),
              "unknown command 'shwo': did you mean hapnet-ctl SOCKET show?");
    EXPECT_EQ(refusal({"s", "status"}),
              "unknown command 'status': did you mean hapnet-ctl SOCKET show?");
    EXPECT_EQ(refusal({"/tmp/e.sock"}).rfind("a command is required", 0), 0U);
    EXPECT_EQ(refusal({}).rfind("a command is required", 0), 0U);
}

} // namespace
} // namespace hapnet::ctl
