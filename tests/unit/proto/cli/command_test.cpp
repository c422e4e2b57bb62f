// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/cli/command.hpp"

#include "proto/base/text.hpp"
#include "proto/cli/parsers.hpp"
#include "tests/support/cli/typed.hpp"

#include <gtest/gtest.h>

namespace hapnet::cli {
namespace {

using namespace std::chrono_literals;

/// A program that works without a command, and has two commands.
struct Relay {
    Command program{"relay", "Relays"};
    base::Duration delay{};
    std::optional<std::string> stats;
    std::string place;
    bool is_loud = false;
    std::vector<std::string> settings;
    std::vector<std::string> files;
    Command* play = nullptr;
    Command* list = nullptr;

    Relay()
    {
        program.option("--place", "ADDRESS", "Where", into(place)).required("here");
        program.option("--delay", "TIME", "How long", into(delay, base::parse_duration));
        program.option("--stats", "FILE", "Where to", into(stats));
        program.flag("--loud", "Say more", is_loud);
        play = &program.command("play", "Plays files");
        play->add_alias("perform");
        play->positional("FILE", "What to play", onto(files)).repeated().required("a.wav");
        play->option("--set", "KEY=VALUE", "A setting", onto(settings)).repeated();
        list = &program.command("list", "Lists files");
    }

    base::Result<std::optional<std::string>> parse(std::vector<std::string> words)
    {
        Typed typed{"relay", std::move(words)};
        return program.parse(typed.words());
    }

    std::string refusal(std::vector<std::string> words)
    {
        const auto parsed = parse(std::move(words));
        return parsed ? "taken" : parsed.error().message;
    }

    std::string printed(std::vector<std::string> words)
    {
        return parse(std::move(words)).value().value_or("");
    }
};

/// A program whose first word is an argument, and that needs a command.
struct Control {
    Command program{"control", "Controls"};
    std::string socket;
    bool as_json = false;
    std::vector<std::string> settings;
    Command* set = nullptr;
    Command* show = nullptr;

    Control()
    {
        program.require_command();
        program.positional("SOCKET", "Whom", into(socket));
        program.flag("--json", "As JSON", as_json);
        set = &program.command("set", "Sets");
        set->positional("KEY", "What", onto(settings)).repeated();
        show = &program.command("show", "Shows");
    }

    base::Result<std::optional<std::string>> parse(std::vector<std::string> words)
    {
        Typed typed{"control", std::move(words)};
        return program.parse(typed.words());
    }

    std::string refusal(std::vector<std::string> words)
    {
        const auto parsed = parse(std::move(words));
        return parsed ? "taken" : parsed.error().message;
    }
};

TEST(Command, PutsParsedValuesWhereTheyAreBoundTo)
{
    Relay relay;
    ASSERT_EQ(relay.refusal({"--place", "there", "--delay=10ms", "--stats", "-", "--loud"}),
              "taken");
    EXPECT_EQ(relay.place, "there");
    EXPECT_EQ(relay.delay, 10ms);
    EXPECT_EQ(relay.stats, "-");
    EXPECT_TRUE(relay.is_loud);
    EXPECT_TRUE(relay.program.is_given("--delay"));
    EXPECT_FALSE(relay.play->is_chosen());
}

TEST(Command, NamesTheOptionInWhatItsParserSays)
{
    Relay relay;
    EXPECT_EQ(
        relay.refusal({"--place", "x", "--delay", "10"}).rfind("--delay: '10' has no unit", 0), 0U);
}

TEST(Command, RequiresWhatIsRequiredWithAnExample)
{
    EXPECT_EQ(Relay{}.refusal({}), "--place is required: --place here");
    EXPECT_EQ(Relay{}.refusal({"play"}), "FILE is required: relay play a.wav");
}

TEST(Command, SaysThatAValueIsMissingOrGivenTwice)
{
    EXPECT_EQ(Relay{}.refusal({"--delay"}), "--delay needs a value: --delay TIME");
    EXPECT_EQ(Relay{}.refusal({"--delay", "1ms", "--delay", "2ms"}),
              "--delay is given 2 times: give it once");
}

TEST(Command, TakesRepeatedOptionsAndArgumentsInTheirOrder)
{
    Relay relay;
    ASSERT_EQ(relay.refusal({"play", "a", "--set", "x=1", "b", "--set", "y=2"}), "taken");
    EXPECT_TRUE(relay.play->is_chosen());
    EXPECT_EQ(relay.files, (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(relay.settings, (std::vector<std::string>{"x=1", "y=2"}));
}

TEST(Command, KeepsAListInBracketsInOnePiece)
{
    Relay relay;
    ASSERT_EQ(relay.refusal({"play", "[1, 2]", "--set", "[3,4]"}), "taken");
    EXPECT_EQ(relay.files, std::vector<std::string>{"[1, 2]"});
    EXPECT_EQ(relay.settings, std::vector<std::string>{"[3,4]"});
}

TEST(Command, TakesShortOptionsInEachSpelling)
{
    for (const std::vector<std::string>& words : {std::vector<std::string>{"-d", "1ms", "-qv"},
                                                  {"-d1ms", "-vq"},
                                                  {"-qvd=1ms"},
                                                  {"-q", "-v", "--delay=1ms"}}) {
        Command program{"relay"};
        base::Duration delay{};
        bool is_quiet = false, is_verbose = false;
        program.option("-d,--delay", "TIME", "How long", into(delay, base::parse_duration));
        program.flag("-q,--quiet", "Say less", is_quiet);
        program.flag("-v,--verbose", "Say more", is_verbose);
        Typed typed{"relay", words};
        ASSERT_TRUE(program.parse(typed.words())) << words.front();
        EXPECT_EQ(delay, 1ms);
        EXPECT_TRUE(is_quiet && is_verbose) << words.front();
    }
}

TEST(Command, TakesNumbersWithASignAndWhatStandsBehindTwoDashesAsArguments)
{
    Relay relay;
    ASSERT_EQ(relay.refusal({"play", "-5ms", "-", "--", "--set", "list", "--"}), "taken");
    EXPECT_EQ(relay.files, (std::vector<std::string>{"-5ms", "-", "--set", "list", "--"}));
    EXPECT_TRUE(relay.settings.empty());
    EXPECT_NE(Relay{}.refusal({"--place", "x", "--", "play"}), "taken");
}

TEST(Command, TakesTheWordBehindAnOptionAsItsValueWhateverItIs)
{
    Relay relay;
    ASSERT_EQ(relay.refusal({"--place", "--loud", "--stats", "play"}), "taken");
    EXPECT_EQ(relay.place, "--loud");
    EXPECT_EQ(relay.stats, "play");
    EXPECT_FALSE(relay.is_loud);
}

TEST(Command, RefusesAnEmptyValueAndAValueOfAFlag)
{
    EXPECT_EQ(Relay{}.refusal({"--place=", "x"}), "--place needs a value: --place ADDRESS");
    EXPECT_EQ(Relay{}.refusal({"--place", "x", "--loud=no"}), "--loud takes no value");
}

TEST(Command, KnowsACommandByItsAlias)
{
    Relay relay;
    ASSERT_EQ(relay.refusal({"perform", "a"}), "taken");
    EXPECT_TRUE(relay.play->is_chosen());
}

TEST(Command, SpeaksOfAMistypedOptionBeforeAWrongValueAndAMissingOption)
{
    EXPECT_EQ(Relay{}.refusal({"--delay", "10", "--lod"}),
              "unknown option --lod: did you mean --loud?");
}

TEST(Command, RefusesAnOptionThatIsNotOfTheChosenCommand)
{
    EXPECT_EQ(Relay{}.refusal({"play", "a", "--delay", "1ms"}).rfind("unknown option --delay", 0),
              0U);
    EXPECT_EQ(Relay{}.refusal({"--delay", "1ms", "play", "a"}).rfind("unknown option --delay", 0),
              0U);
}

TEST(Command, RefusesAWordThatIsNotACommand)
{
    EXPECT_EQ(Relay{}.refusal({"lst"}), "unknown command 'lst': did you mean relay list?");
    EXPECT_EQ(Relay{}.refusal({"--place", "x", "stray"}),
              "unknown command 'stray': commands are play, list");
    EXPECT_EQ(Relay{}.refusal({"list", "stray"}), "unexpected 'stray': relay list");
    EXPECT_EQ(Relay{}.refusal({"--delay", "80", "ms"}), "--delay: '80 ms' has a space: write 80ms");
    EXPECT_EQ(Relay{}.refusal({"--delay=80", "ms"}), "--delay: '80 ms' has a space: write 80ms");
    EXPECT_EQ(Relay{}.refusal({"play", "--set", "80", "ms"}),
              "--set: '80 ms' has a space: write 80ms");
    EXPECT_EQ(Relay{}.refusal({"play", "ms", "80"}), "taken");
    EXPECT_EQ(Relay{}.refusal({"--stats", "a", "ms"}).rfind("unknown command 'ms'", 0), 0U);
}

TEST(Command, PrintsItsHelpWhereverItIsAskedFor)
{
    const std::string help = Relay{}.printed({"--help"});
    EXPECT_EQ(help.rfind("Usage: relay --place ADDRESS [OPTIONS]\n", 0), 0U) << help;
    EXPECT_EQ(Relay{}.printed({"-h"}), help);
    EXPECT_EQ(Relay{}.printed({"help"}), help);
    EXPECT_EQ(Relay{}.printed({"--delay", "10", "--nonsense", "--help"}), help);
    const std::string of_play = Relay{}.printed({"play", "--help"});
    EXPECT_EQ(of_play.rfind("Usage: relay play FILE ... [--set KEY=VALUE]\n", 0), 0U) << of_play;
    EXPECT_EQ(Relay{}.printed({"help", "play"}), of_play);
    EXPECT_EQ(Relay{}.printed({"--help", "play"}), of_play);
    EXPECT_EQ(Relay{}.printed({"perform", "-h"}), of_play);
}

TEST(Command, PrintsItsVersion)
{
    EXPECT_EQ(Relay{}.printed({"--version"}).rfind("relay ", 0), 0U);
    EXPECT_EQ(Relay{}.printed({"-V"}), Relay{}.printed({"--version"}));
}

TEST(Command, TakesOptionsOfTheProgramBehindACommandThatItNeeds)
{
    Control control;
    ASSERT_EQ(control.refusal({"a.sock", "set", "both.delay", "-5ms", "--json"}), "taken");
    EXPECT_EQ(control.socket, "a.sock");
    EXPECT_TRUE(control.set->is_chosen());
    EXPECT_TRUE(control.as_json);
    EXPECT_EQ(control.settings, (std::vector<std::string>{"both.delay", "-5ms"}));
}

TEST(Command, TakesACommandWithoutTheArgumentInFrontOfIt)
{
    Control control;
    ASSERT_EQ(control.refusal({"set", "both.delay", "1ms"}), "taken");
    EXPECT_EQ(control.socket, "");
    EXPECT_EQ(control.settings.size(), 2U);
}

TEST(Command, PrintsHelpOfACommandWithAndWithoutTheArgumentInFrontOfIt)
{
    const std::string help = Control{}.parse({"set", "--help"}).value().value_or("");
    EXPECT_EQ(help.rfind("Usage: control [SOCKET] set [KEY ...]\n", 0), 0U) << help;
    EXPECT_EQ(Control{}.parse({"a.sock", "set", "--help"}).value(), help);
    EXPECT_EQ(Control{}.parse({"a.sock", "help", "set"}).value(), help);
}

TEST(Command, SaysThatACommandIsMissing)
{
    EXPECT_EQ(Control{}.refusal({"a.sock"}),
              "a command is required: control [SOCKET] COMMAND ..., with one of set, show");
    EXPECT_EQ(Control{}.refusal({"shwo"}),
              "unknown command 'shwo': did you mean control SOCKET show?");
    EXPECT_EQ(Control{}.refusal({"a.sock", "shwo"}),
              "unknown command 'shwo': did you mean control SOCKET show?");
}

TEST(Command, TakesValuesByTheirFormat)
{
    const auto said = [](const auto& value) { return value ? "taken" : value.error().message; };
    EXPECT_EQ(value_of<std::uint16_t>(base::Count{1, 9}, "9").value(), 9);
    EXPECT_EQ(said(value_of<std::uint16_t>(base::Count{1, 9}, "10")),
              "expected a whole number from 1 to 9, not 10");
    EXPECT_EQ(said(value_of<std::uint16_t>(base::Count{1, 9}, "x")),
              "expected a whole number from 1 to 9, not 'x'");
    EXPECT_EQ(value_of<double>(base::Number{0.5, 2.0}, "1.5").value(), 1.5);
    EXPECT_FALSE(value_of<double>(base::Number{0.5, 2.0}, "nan"));
    EXPECT_EQ(value_of<base::Duration>(base::Time{1s}, "2s").value(), 2s);
    EXPECT_NE(said(value_of<base::Duration>(base::Time{1s}, "10ms")).find("1s or more"),
              std::string::npos);
    EXPECT_NE(said(value_of<double>(base::Quantity{base::force_kind, 0.0, 40.0}, "41N"))
                  .find("0N to 40N"),
              std::string::npos);
}

TEST(Parsers, TakeAWordInSmallAndCapitalLetters)
{
    EXPECT_EQ(one_of({"eco", "spin"})("ECO").value(), "eco");
    EXPECT_EQ(one_of({"eco", "spin"})("now").error().message,
              "unknown value 'now': use one of eco, spin");
}

} // namespace
} // namespace hapnet::cli
