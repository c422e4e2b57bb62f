// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/options.hpp"

#include "emulator/core/profile/setting_hints.hpp"
#include "emulator/scenario.hpp"
#include "tests/support/cli/help_faults.hpp"

#include <filesystem>
#include <gtest/gtest.h>

namespace hapnet::emulator {
namespace {

using namespace std::chrono_literals;
using namespace base::literals;

/// The refusal of these options of a run; "" where they are accepted, as far as can be checked
/// without a network.
std::string refusal(std::vector<std::string> words)
{
    words.insert(words.begin(), {"--listen-a", "127.0.0.1:0", "--listen-b", "127.0.0.1:0"});
    cli::Typed typed{"hapnet-emulator", std::move(words)};
    const auto line = parse_command_line(typed.words());
    if (!line) return line.error().message;
    std::vector<std::string> warnings;
    const auto& options = std::get<Options>(std::get<AnyOptions>(*line));
    const auto profile = profile_for(options.conditions, warnings);
    return profile ? "" : profile.error().message;
}

std::string refusal_alone(std::vector<std::string> words)
{
    return cli::refusal_of(parse_command_line, "hapnet-emulator", std::move(words));
}

template <typename T>
T options_of(std::vector<std::string> words)
{
    cli::Typed typed{"hapnet-emulator", std::move(words)};
    return std::get<T>(std::get<AnyOptions>(parse_command_line(typed.words()).value()));
}

template <typename T>
base::Result<Profile> profile_of(std::vector<std::string> words)
{
    std::vector<std::string> warnings;
    return profile_for(options_of<T>(std::move(words)).conditions, warnings);
}

void expect_said(const std::string& refusal, const std::string& words)
{
    EXPECT_NE(refusal.find(words), std::string::npos) << words << " is not in: " << refusal;
}

TEST(EmulatorOptions, HaveACompleteHelp)
{
    const auto prints = cli::prints_of("hapnet-emulator", parse_command_line);
    EXPECT_EQ(cli::help_faults("hapnet-emulator", prints), std::vector<std::string>{});
    EXPECT_EQ(cli::listed_commands(prints({"--help"}).value()),
              (std::vector<std::string>{"check", "predict", "verify", "report", "learn", "probe",
                                        "between", "exec", "bridge", "schema"}));
    EXPECT_EQ(prints({"--help"})->rfind("Usage: hapnet-emulator [OPTIONS]\n", 0), 0U);
}

TEST(EmulatorOptions, AnswerTheWordsOfOtherTools)
{
    for (const auto& [typed, meant] : {std::pair{"--bandwidth", "--rate"},
                                       {"--latency", "--delay"},
                                       {"--up.latency", "--up.delay"},
                                       {"--preset", "--profile"},
                                       {"--drop", "--loss"},
                                       {"--dry-run", "hapnet-emulator check"},
                                       {"--dealy", "--delay"}}) {
        EXPECT_EQ(refusal({typed, "10ms"}),
                  std::string{"unknown option "} + typed + ": did you mean " + meant + "?");
    }
    EXPECT_EQ(refusal_alone({"start"}),
              "unknown command 'start': did you mean hapnet-emulator --listen-a ADDRESS "
              "--listen-b ADDRESS?");
}

TEST(EmulatorOptions, SayHowALawIsWritten)
{
    EXPECT_EQ(refusal({"--reorder", "5%"}),
              "--reorder: '5%': give displacement, too, the number of later datagrams: "
              "'{ share = \"5%\", displacement = 3 }'");
    EXPECT_EQ(refusal({"--loss", "gilbert"}),
              "--loss: 'gilbert': a law is written as a table: '{ law = \"gilbert\", share = "
              "\"2%\", mean_burst = 5.0 }'");
    expect_said(refusal({"--up.jitter", "20ms normal"}), "'{ law = \"normal\", sd = \"5ms\" }'");
    expect_said(refusal({"--delay", "80ms 5ms"}), "--netem \"delay 80ms 5ms\"");
    EXPECT_EQ(refusal({"--reorder", "{ share = \"5%\", displacement = 3 }"}), "");
    expect_said(refusal({"--loss", "5% 25% ecn"}), "--netem \"loss 5% 25% ecn\"");
    EXPECT_EQ(refusal({"--netem", "delay 80ms 5ms"}), "");
}

TEST(EmulatorOptions, NameASpaceInAValue)
{
    EXPECT_EQ(refusal({"--delay", "80 ms"}), "--delay: '80 ms' has a space: write 80ms");
    EXPECT_EQ(refusal({"--loss", "5 %"}), "--loss: '5 %' has a space: write 5%");
    EXPECT_EQ(refusal({"--delay", "80", "ms"}), "--delay: '80 ms' has a space: write 80ms");
    EXPECT_EQ(refusal({"--delay", "80ms later"}).find("--netem"), std::string::npos);
}

TEST(EmulatorOptions, ProposeOnlyLawsThatCanBeTyped)
{
    // Laws that name a file need the file.
    for (const std::string law :
         {"random", "k-of-n", "every", "burst", "timed-burst", "gilbert", "gilbert-elliott",
          "gemodel", "timed-gilbert-elliott", "four-state", "list", "pattern", "outage"}) {
        const std::string example{law_example("loss", law)};
        EXPECT_EQ(refusal({"--loss", example}), "") << example;
    }
    for (const std::string law : {"constant", "uniform", "normal", "gaussian", "log-normal",
                                  "exponential", "pareto", "gamma"}) {
        const std::string example{law_example("delay", law)};
        EXPECT_EQ(refusal({"--delay", example}), "") << example;
    }
    for (const auto& [setting, law] :
         {std::pair{"loss", "trace"}, {"delay", "trace"}, {"jitter", "table"}}) {
        const std::string example{law_example(setting, law)};
        expect_said(refusal({std::string{"--"} + setting, example}), "No such file");
    }
}

TEST(EmulatorOptions, TakeUnitsInTheSpellingsOfOtherTools)
{
    EXPECT_EQ(refusal({"--rate", "10mbit"}), "");
    expect_said(refusal({"--rate", "10Mbps"}), "write 10Mbit/s");
    EXPECT_EQ(refusal({"--delay", "100msec"}), "");
    expect_said(refusal({"--delay", "1m"}), "write 1min or 1ms");
    expect_said(refusal({"--delay", "160"}), "'160'");
    EXPECT_EQ(profile_of<CheckOptions>({"check", "--mtu", "1500"})->path.up.mtu,
              profile_of<CheckOptions>({"check", "--mtu", "1500B"})->path.up.mtu);
}

TEST(EmulatorOptions, ListenOnLoopbackWhereOnlyAPortIsGiven)
{
    const auto options =
        options_of<Options>({"--listen-a", ":7001", "--listen-b", "7002", "--duration", "1s"});
    EXPECT_EQ(options.listen_a.host, "127.0.0.1");
    EXPECT_EQ(options.listen_a.port, 7001);
    EXPECT_EQ(options.listen_b.host, "127.0.0.1");
    EXPECT_EQ(options.listen_b.port, 7002);
    EXPECT_EQ(options.duration, 1s);
}

TEST(EmulatorOptions, SayThatBothSidesHaveTheSameAddress)
{
    EXPECT_EQ(refusal_alone({"--listen-a", ":7001", "--listen-b", "127.0.0.1:7001"}),
              "--listen-a and --listen-b are the same address, 127.0.0.1:7001: give each side its "
              "own port");
    EXPECT_EQ(refusal({}), "") << "port 0 is another one each time";
}

TEST(EmulatorOptions, TakeThePresetAndTheTimingInCapitalLetters)
{
    EXPECT_EQ(refusal({"--profile", "LTE", "--timing", "ECO"}), "");
    expect_said(refusal({"--profile", "ltee"}), "did you mean 'lte'?");
    expect_said(refusal({"--timing", "now"}), "use one of eco, precise, spin");
}

TEST(EmulatorOptions, GiveDryRunsTheConditionsOfARun)
{
    EXPECT_EQ(profile_of<PredictOptions>({"predict", "--jitter", "15ms"})->path.up.jitter,
              profile_of<Options>({"--listen-a", ":0", "--listen-b", ":0", "--jitter", "15ms"})
                  ->path.up.jitter);
    EXPECT_EQ(profile_of<CheckOptions>({"check", "--netem", "loss 1%"})->path.up.loss.size(), 1U);
    const auto lte = profile_of<PredictOptions>({"predict", "lte", "--down.delay", "5ms"});
    EXPECT_EQ(lte->name, profile_of<PredictOptions>({"predict", "lte"})->name);
    EXPECT_NE(lte->path, profile_of<PredictOptions>({"predict", "lte"})->path);
    expect_said(refusal_alone({"check"}), "conditions are required");
    std::vector<std::string> warnings;
    EXPECT_FALSE(profile_for(
        options_of<CheckOptions>({"check", "lte", "--netem", "loss 1%"}).conditions, warnings));
}

TEST(EmulatorOptions, TellARateOfDatagramsFromABitRate)
{
    const auto options =
        options_of<PredictOptions>({"predict", "--rate", "500/s", "--rate", "10Mbit/s"});
    EXPECT_EQ(options.stream.spacing, 2ms);
    ASSERT_EQ(options.conditions.settings.size(), 1U);
    EXPECT_EQ(options.conditions.settings[0].key, "rate");
    EXPECT_EQ(options_of<CheckOptions>({"check", "lte", "--rate", "1000"}).stream.spacing, 1ms);
    expect_said(refusal_alone({"predict", "lte", "--rate", "x"}), "--rate: 'x' is not a rate");
    expect_said(refusal_alone({"predict", "lte", "--packets", "0"}), "a whole number from 1 to");
}

TEST(EmulatorOptions, ListThePresets)
{
    const auto prints = cli::prints_of("hapnet-emulator", parse_command_line);
    const std::string list = prints({"check", "--list"}).value();
    expect_said(list, "lte\n");
    EXPECT_EQ(prints({"predict", "--list"}), list);
}

TEST(EmulatorOptions, OfARunAreNotThoseOfACommand)
{
    EXPECT_EQ(refusal_alone({"--listen-a", ":7001", "check", "lte"}).rfind("unknown option", 0),
              0U);
    EXPECT_EQ(refusal_alone({"learn"}), "FILE is required: hapnet-emulator learn ping.txt");
    EXPECT_EQ(options_of<LearnOptions>({"learn", "x", "--rate", "50"}).spacing, 20ms);
    EXPECT_EQ(options_of<LearnOptions>({"learn", "a", "b", "--plot"}).files,
              (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(refusal_alone({"verify"}), "RUN is required: hapnet-emulator verify run.json");
    EXPECT_EQ(options_of<VerifyOptions>({"verify", "run.json", "--rate", "1000"}).spacing, 1ms);
    expect_said(refusal_alone({"verify", "run.json", "--rate", "0"}),
                "a whole number from 1 to 1000000000");
}

TEST(EmulatorOptions, OfADryRunNameOnePathOfSeveral)
{
    for (const auto& [typed, path] :
         {std::pair{"1-2", "1-2"}, std::pair{"2-1", "1-2"}, std::pair{"wan", "wan"},
          std::pair{"wan.down", "wan"}, std::pair{"client.3", "client.3"}}) {
        EXPECT_EQ(options_of<PredictOptions>({"predict", "lte", "--link", typed}).stream.path,
                  path);
        EXPECT_EQ(options_of<CheckOptions>({"check", "lte", "--link", typed}).stream.path, path);
    }
    EXPECT_EQ(options_of<CheckOptions>({"check", "lte"}).stream.path, "");
    expect_said(refusal_alone({"predict", "lte", "--link", "up"}),
                "'up' is not the name of a link");
}

TEST(EmulatorOptions, TakeTheSizeOfAStateForThatOfADatagram)
{
    EXPECT_EQ(options_of<PredictOptions>({"predict", "lte"}).stream.bytes, 136U);
    EXPECT_EQ(options_of<ProbeOptions>({"probe", "127.0.0.1:7000"}).bytes, 136U);
}

TEST(EmulatorOptions, SpeakOfSeveralPathsOnlyWhereThereMayBeSome)
{
    const auto prints = cli::prints_of("hapnet-emulator", parse_command_line);
    for (const char* command : {"between", "exec", "bridge"}) {
        const std::string help = prints({command, "--help"}).value();
        expect_said(help, "Sets a condition by its key: up.delay=20ms");
        EXPECT_EQ(help.find("1-2.delay"), std::string::npos) << command;
        EXPECT_EQ(help.find("client.3"), std::string::npos) << command;
    }
    expect_said(prints({"--help"}).value(), "1-2.delay=20ms");
    expect_said(prints({"predict", "--help"}).value(), "1-2.delay=20ms");
}

TEST(EmulatorOptions, OfClientsOfAServerGoTogether)
{
    const auto options = options_of<UpstreamOptions>({"--listen", ":7001", "--upstream", "[::1]:53",
                                                      "--allow", "10.0.0.0/8", "--allow", "host:*",
                                                      "--clients", "5", "--loss", "2%"});
    EXPECT_EQ(options.allowed.size(), 2U);
    EXPECT_EQ(options.allowed[0].prefix, 8U);
    EXPECT_EQ(options.clients_max, 5U);
    EXPECT_EQ(options.idle, 60s);
    EXPECT_EQ(options.run.conditions.settings.at(0).key, "loss");
    expect_said(refusal_alone({}), "--listen-a is required: --listen-a 127.0.0.1:7001");
    expect_said(refusal_alone({"--upstream", "a:1"}), "--listen is required");
    expect_said(refusal_alone({"--listen", ":1", "--upstream", "a:1", "--b", "b:1"}),
                "--b and --upstream exclude each other");
    EXPECT_EQ(options_of<UpstreamOptions>({"--listen", ":1", "--upstream", "a:1", "--fates", "f"})
                  .run.fates,
              "f");
    EXPECT_TRUE(
        options_of<UpstreamOptions>({"--listen", ":1", "--upstream", "a:1", "--name-by", "address"})
            .named_by_address);
    expect_said(refusal({"--clients", "5"}), "--clients goes with --upstream");
    expect_said(refusal_alone({"--listen", ":1", "--upstream", "a:1", "--allow", "10.0.0.0/40"}),
                "at most 32 bits");
}

TEST(EmulatorOptions, OfLinksNameTheirSidesAndTheirEnds)
{
    const auto options = options_of<LinkOptions>({"--link", "1-2=:7001,:7002", "--link",
                                                  "wan=0.0.0.0:7003,:7004,10.0.0.0/8,", "--set",
                                                  "2-1.delay=80ms", "--loss", "2%"});
    ASSERT_EQ(options.links.size(), 2U);
    EXPECT_EQ(options.links[0].name, "1-2");
    EXPECT_EQ(options.links[0].listen_2.port, 7002);
    EXPECT_EQ(options.links[0].end_1.size(), 0U);
    EXPECT_EQ(options.links[1].listen_1.host, "0.0.0.0");
    EXPECT_EQ(options.links[1].end_1.at(0).prefix, 8U);
    EXPECT_EQ(options.links[1].end_2.size(), 0U);
    EXPECT_EQ(options.run.conditions.settings.at(0).key, "2-1.delay");
    expect_said(refusal_alone({"--link", "2-1=:1,:2"}), "'2-1': name the lower number first: 1-2");
    expect_said(refusal_alone({"--link", "both=:1,:2"}), "'both' is not the name of a link");
    expect_said(refusal_alone({"--link", "delay=:1,:2"}), "'delay' is not the name of a link");
    expect_said(refusal_alone({"--link", "1-2=:1"}), "write two addresses to listen on");
    expect_said(refusal_alone({"--link", "1-2"}), "write NAME=LISTEN_A,LISTEN_B");
    expect_said(refusal_alone({"--link", "1-2=:1,:2", "--link", "1-2=:3,:4"}), "given twice");
    expect_said(refusal_alone({"--link", "1-2=:1,:2", "--link", "1-3=:2,:4"}),
                "--link 1-3: 127.0.0.1:2 is the address of another side");
    expect_said(refusal_alone({"--link", "1-2=:1,:2", "--listen-a", ":3"}),
                "--listen-a and --link exclude each other");
    EXPECT_EQ(options.run.threads, 1U);
    EXPECT_EQ(options_of<LinkOptions>({"--link", "1-2=:1,:2", "--threads", "4"}).run.threads, 4U);
    expect_said(refusal_alone({"--link", "1-2=:1,:2", "--threads", "17"}), "from 1 to 16");
    expect_said(refusal({"--threads", "2"}), "--threads goes with --link or --upstream");
    expect_said(refusal_alone({"--link", "1-2=:1,:2", "--upstream", "a:1"}),
                "--upstream and --link exclude each other");
    std::vector<std::string> many;
    for (int i = 0; i < 29; ++i) {
        many.insert(many.end(), {"--link", fmt::format("l{}=:0,:0", i)});
    }
    expect_said(refusal_alone(many), "at most 28");
    expect_said(refusal({"--set", "delay"}), "write KEY=VALUE");
    expect_said(refusal({"--set", "1-2.dealy=5ms"}), "--set unknown key '1-2.dealy'");
}

TEST(EmulatorOptions, OfOneSideAreOnePeerOrSeveralThatMaySend)
{
    const auto options = options_of<Options>({"--listen-a", ":1", "--listen-b", ":2", "--a",
                                              "10.0.0.0/8", "--a", "host:*", "--b", "[::1]:9"});
    EXPECT_EQ(options.a.size(), 2U);
    EXPECT_FALSE(options.a[1].port);
    EXPECT_EQ(options.b.at(0).port, 9U);
    expect_said(refusal({"--a", "10.0.0.1:0"}), "nothing comes from port 0");
}

TEST(EmulatorOptions, OfTheMemoryInFlightHaveARange)
{
    EXPECT_EQ(options_of<Options>({"--listen-a", ":1", "--listen-b", ":2", "--in-flight", "1GiB"})
                  .in_flight_bytes,
              std::size_t{1} << 30);
    expect_said(refusal({"--in-flight", "1KiB"}), "out of range");
}

} // namespace
} // namespace hapnet::emulator
