// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Messages of the emulator to the person or script that starts it.
#include "tests/e2e/emulator.hpp"
#include "tests/e2e/no_network.hpp"
#include "tests/e2e/udp.hpp"

#include <chrono>
#include <csignal>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hapnet::e2e {

namespace {

using namespace std::chrono_literals;

const std::vector<std::string> listening{"--listen-a",  "127.0.0.1:0", "--listen-b",
                                         "127.0.0.1:0", "--duration",  "50ms"};

Outcome run_with(std::vector<std::string> options)
{
    options.insert(options.begin(), listening.begin(), listening.end());
    return run("hapnet-emulator", options);
}

} // namespace

TEST(EmulatorUsage, PrintsHelpWithEveryOptionAndExamples)
{
    const auto outcome = run("hapnet-emulator", {"--help"});
    EXPECT_EQ(outcome.exit, 0);
    for (const char* word :
         {"--listen-a", "--listen-b", "--a ",         "--b ",       "--delay",     "--jitter",
          "--order",    "--loss",     "--burst-loss", "--up.delay", "--down.loss", "--duplicate",
          "--corrupt",  "--reorder",  "--rate",       "--mtu",      "--profile",   "--netem",
          "--seed",     "--stats",    "--duration",   "--timing",   "--fates",     "--replay",
          "--pcap",     "--control",  "check",        "predict",    "verify",      "--budget",
          "--version",  "report",     "--require",    "Examples",   "160ms",       "Exit codes"}) {
        EXPECT_NE(outcome.out.find(word), std::string::npos) << word;
    }
}

TEST(EmulatorUsage, PrintsItsVersion)
{
    const auto outcome = run("hapnet-emulator", {"--version"});
    EXPECT_EQ(outcome.exit, 0);
    EXPECT_EQ(outcome.out.rfind("hapnet-emulator ", 0), 0U);
}

TEST(EmulatorUsage, RefusesWhatItDoesNotKnowNamingIt)
{
    expect_refusal(run_with({"--dealy", "160ms"}), 2, {"--dealy", "did you mean --delay?"});
    expect_refusal(run_with({"stray"}), 2, {"stray"});
    expect_refusal(run("hapnet-emulator", {}), 2, {"--listen-a"});
    expect_refusal(run("hapnet-emulator", {"--listen-a", "127.0.0.1:0"}), 2, {"--listen-b"});
}

TEST(EmulatorUsage, RefusesBadValuesNamingTheOptionTheTextAndTheCure)
{
    expect_refusal(run_with({"--delay", "160"}), 2, {"--delay", "'160'", "160ms"});
    expect_refusal(run_with({"--delay=-5ms"}), 2, {"--delay", "'-5ms'"});
    expect_refusal(run_with({"--up.jitter", "5%"}), 2, {"--up.jitter", "'5%'", "15us"});
    expect_refusal(run_with({"--loss", "93"}), 2, {"--loss", "'93'", "93%"});
    expect_refusal(run_with({"--down.loss", "101%"}), 2, {"--down.loss", "'101%'"});
    expect_refusal(run_with({"--burst-loss", "100/40"}), 2, {"--burst-loss", "'100/40'", "40/100"});
    expect_refusal(run_with({"--order", "random"}), 2, {"--order", "random", "keep", "free"});
    expect_refusal(run_with({"--timing", "now"}), 2, {"--timing", "'now'", "precise"});
    expect_refusal(run_with({"--seed", "x"}), 2, {"--seed", "'x'", "whole number"});
    expect_refusal(run_with({"--a", "127.0.0.1/40"}), 2, {"--a", "at most 32 bits"});
    expect_refusal(run_with({"--a", "127.0.0.1:0"}), 2, {"--a", "port 0"});
    expect_refusal(run_with({"--a", "127.0.0.1:70000"}), 2, {"--a", "65535"});
    expect_refusal(run_with({"--delay", "1ms", "--delay", "2ms"}), 2, {"--delay"});
    expect_refusal(run_with({"--delay"}), 2, {"--delay"});
    expect_refusal(run_with({"--replay", "/dev/zero"}), 2, {"line 1: expected 'direction"});
    expect_refusal(run_with({"--replay", "/tmp"}), 2,
                   {"--replay: cannot read /tmp: it is a folder"});
}

TEST(EmulatorUsage, AnErrorOfAFileNamesTheOptionThatAskedForIt)
{
    expect_refusal(run_with({"--profile", "/no/such.toml"}), 2,
                   {"--profile: cannot read /no/such.toml: No such file"});
    expect_refusal(run_with({"--profile", "nosuch"}), 2,
                   {"--profile: there is neither a file nor a preset 'nosuch'"});
    expect_refusal(run_with({"--replay", "/no/such.csv"}), 2,
                   {"--replay: cannot read /no/such.csv: No such file"});
    expect_refusal(run_with({"--replay", "/dev/null"}), 2, {"--replay: /dev/null: line 1"});
    for (const char* option : {"--stats", "--fates", "--pcap"}) {
        expect_refusal(run_with({option, "/no/such"}), 3,
                       {std::string{option} + ": cannot write /no/such: No such file",
                        "choose a path in a folder that exists"});
    }
    expect_refusal(run("hapnet-emulator", {"check", "/bin/sh"}), 2,
                   {"/bin/sh", "this is no text: it has the byte 0x7f", "TOML"});
    // A message about a word without an option must not name an option.
    const auto checked = run("hapnet-emulator", {"check", "/no/such.toml"});
    expect_refusal(checked, 2, {"hapnet-emulator: cannot read /no/such.toml: No such file"});

    const TemporaryFolder folder;
    std::ofstream{folder.file("fates.csv")}
        << "direction,number,verdict,cause,states,delay_ns,copy_after_ns,flipped_bits,"
           "displaced_places,displaced_ns\n";
    expect_refusal(
        run("hapnet-emulator", {"verify", folder.file("fates.csv"), "--profile", "/no/such.toml"}),
        2, {"--profile: cannot read /no/such.toml: No such file"});
    expect_refusal(run("hapnet-emulator", {"probe", "127.0.0.1:9", "--csv", "/no/such"}), 3,
                   {"--csv: cannot write /no/such"});
}

TEST(EmulatorUsage, SaysWhatSpinRisks)
{
    const std::string risk = "the kernel stops the emulator for about 50 ms in each second";
    EXPECT_NE(run_with({"--timing", "spin"}).err.find(risk), std::string::npos);
    EXPECT_EQ(run_with({"--timing", "precise"}).err.find(risk), std::string::npos);
}

TEST(EmulatorUsage, RefusesWhatTheRampsOfTheProfileCannotBeginAt)
{
    const TemporaryFolder folder;
    const std::string profile = folder.file("ramp.toml");
    std::ofstream{profile} << "both.rate = \"1Mbit/s\"\n"
                              "[[at]]\ntime = \"1s\"\nramp = \"1s\"\nup.rate = \"2Mbit/s\"\n";
    EXPECT_EQ(run_with({"--profile", profile, "--down.rate", "0"}).exit, 0);
    expect_refusal(run_with({"--profile", profile, "--up.rate", "0"}), 2,
                   {"change 1", "at 1s", "cannot ramp rate"});
}

TEST(EmulatorUsage, ChecksAndPredictsOneLinkOfAMesh)
{
    const TemporaryFolder folder;
    const std::string profile = folder.file("mesh.toml");
    std::ofstream{profile} << "both.loss = \"10%\"\n[matrix]\npeers = [1, 2, 3]\n"
                              "delay = [[\"0ms\", \"10ms\", \"20ms\"],\n"
                              "         [\"30ms\", \"0ms\", \"40ms\"],\n"
                              "         [\"50ms\", \"60ms\", \"0ms\"]]\n";
    const auto predicted = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"predict", profile, "--packets", "1000", "--json"});
        const auto outcome = run("hapnet-emulator", more);
        EXPECT_EQ(outcome.exit, 0) << outcome.err;
        return nlohmann::json::parse(outcome.out);
    };
    const auto two = predicted({"--link", "2-3"});
    EXPECT_EQ(two["link"], "2-3");
    EXPECT_EQ(two["up"]["delay_ms"]["mean"], 40.0);
    EXPECT_EQ(two["down"]["delay_ms"]["mean"], 60.0);
    const auto one = predicted({"--link", "1-3"});
    EXPECT_EQ(one["down"]["delay_ms"]["mean"], 50.0);
    // Each link has its own draws, as in a run.
    EXPECT_NE(one["up"]["dropped"], two["up"]["dropped"]);

    const auto common = run("hapnet-emulator", {"predict", profile, "--packets", "1000"});
    EXPECT_NE(common.err.find("--link NAME describes one of those that have some: 1-2, 1-3, 2-3"),
              std::string::npos)
        << common.err;
    const auto other = run("hapnet-emulator", {"check", profile, "--link", "wan"});
    EXPECT_NE(other.err.find("nothing of its own for wan"), std::string::npos) << other.err;

    const auto checked = run("hapnet-emulator", {"check", profile, "--link", "2-3"});
    EXPECT_EQ(checked.exit, 0) << checked.err;
    for (const char* words : {"delay = \"40ms\"", "# 2-3: from 2 to 3", "# 3-2: from 3 to 2"}) {
        EXPECT_NE(checked.out.find(words), std::string::npos) << checked.out;
    }
    const std::string alone = folder.file("alone.toml"); // a profile of one path
    std::ofstream{alone} << checked.out;
    EXPECT_EQ(run_with({"--profile", alone}).exit, 0);
}

TEST(EmulatorUsage, AdoptsOnLoopbackOnly)
{
    expect_refusal(run("hapnet-emulator", {"--listen-a", "0.0.0.0:0", "--listen-b", "127.0.0.1:0"}),
                   2, {"--listen-a 0.0.0.0", "--a HOST:PORT"});
    expect_refusal(run("hapnet-emulator", {"--listen-a", "127.0.0.1:0", "--listen-b", "[::]:0"}), 2,
                   {"--listen-b", "--b HOST:PORT"});
}

TEST(EmulatorUsage, RefusesAPeerThatItsOwnAddressCannotReach)
{
    expect_refusal(run_with({"--b", "192.0.2.1:7000"}), 2, {"--b", "--listen-b", "0.0.0.0"});
}

TEST(EmulatorUsage, RefusesItselfAsAPeer)
{
    expect_refusal(run("hapnet-emulator", {"--listen-a", "127.0.0.1:7001", "--listen-b",
                                           "127.0.0.1:7002", "--b", "127.0.0.1:7001"}),
                   2, {"--b 127.0.0.1:7001", "itself listens"});
    expect_refusal(run("hapnet-emulator", {"--listen-a", "0.0.0.0:7001", "--a", "127.0.0.1:7001",
                                           "--listen-b", "127.0.0.1:7002"}),
                   2, {"--a 127.0.0.1:7001", "itself listens"});
}

TEST(EmulatorUsage, RefusesTwoResultsInOneFile)
{
    expect_refusal(run_with({"--stats", "run.json", "--fates", "run.json"}), 2,
                   {"--stats", "--fates", "run.json"});
}

TEST(EmulatorUsage, SaysThatAPortIsInUse)
{
    const Host other;
    const auto outcome = run(
        "hapnet-emulator", {"--listen-a", other.endpoint().to_text(), "--listen-b", "127.0.0.1:0"});
    expect_refusal(outcome, 3, {other.endpoint().to_text(), "another port"});
}

TEST(EmulatorUsage, SaysThatANameDoesNotResolve)
{
    expect_refusal(run_with({"--a", "no-such-host.invalid:7000"}), 3,
                   {"no-such-host.invalid", "IP address"});
}

TEST(EmulatorUsage, SaysThatAnAddressIsNotOfThisMachine)
{
    expect_refusal(run("hapnet-emulator", {"--listen-a", "192.0.2.1:0", "--a", "127.0.0.1:7000",
                                           "--listen-b", "127.0.0.1:0"}),
                   3, {"192.0.2.1", "0.0.0.0"});
}

TEST(EmulatorUsage, SaysThatThereIsNoRoute)
{
    const NoNetwork no_network;
    if (!no_network.in_force()) GTEST_SKIP() << "only root may take the network away";
    expect_refusal(run("hapnet-emulator", {"--listen-a", "0.0.0.0:0", "--a", "192.0.2.1:7000",
                                           "--listen-b", "127.0.0.1:0"}),
                   3, {"192.0.2.1:7000", "no route"});
}

TEST(EmulatorUsage, FindsOutBeforeTheRunThatStatisticsCannotBeWritten)
{
    expect_refusal(run_with({"--stats", "/no/such/folder/stats.json"}), 3,
                   {"/no/such/folder/stats.json", "folder that exists"});
    expect_refusal(run_with({"--stats", "/tmp"}), 3, {"/tmp", "name a file"});
}

TEST(EmulatorUsage, PrintsExactlyOneReadyLineAndASummaryForPeople)
{
    const auto outcome = run_with({"--seed", "42"});
    EXPECT_EQ(outcome.exit, 0);
    EXPECT_EQ(outcome.out.rfind("ready a=127.0.0.1:", 0), 0U) << outcome.out;
    EXPECT_NE(outcome.out.find(" seed=42 "), std::string::npos);
    EXPECT_EQ(outcome.out.find('\n'), outcome.out.size() - 1);
    EXPECT_NE(outcome.err.find("0 received"), std::string::npos) << outcome.err;
}

TEST(EmulatorUsage, WritesStatisticsToStdoutForADash)
{
    const auto outcome = run_with({"--stats", "-", "--loss", "5%", "--up.loss", "7%"});
    EXPECT_EQ(outcome.exit, 0);
    const auto statistics = nlohmann::json::parse(outcome.out.substr(outcome.out.find('\n')));
    EXPECT_EQ(statistics["configuration_at_start"]["up"]["loss"], "7%");
    EXPECT_EQ(statistics["configuration_at_start"]["down"]["loss"], "5%");
    EXPECT_EQ(statistics["seed"], 1);
    EXPECT_EQ(statistics["budget_us"], 1000.0);
    EXPECT_TRUE(statistics["valid"].get<bool>());
}

TEST(EmulatorUsage, FailsWhereTheRunDoesNotMeetWhatItRequires)
{
    TemporaryFolder folder;
    const std::string profile = folder.file("profile.toml");
    std::ofstream{profile} << "[[check]]\nrequire = \"down.received>=7\"\n";
    const auto outcome = run_with({"--require", "up.received>=1000", "--require", "valid==true",
                                   "--profile", profile, "--stats", "-"});
    EXPECT_EQ(outcome.exit, 1);
    EXPECT_NE(outcome.err.find("NOT MET: up.received>=1000 is required, and it is 0\n"),
              std::string::npos)
        << outcome.err;
    EXPECT_NE(outcome.err.find("NOT MET: down.received>=7"), std::string::npos);
    EXPECT_EQ(outcome.err.find("valid=="), std::string::npos);
    const auto statistics = nlohmann::json::parse(outcome.out.substr(outcome.out.find('\n')));
    ASSERT_EQ(statistics["checks"].size(), 3U);
    EXPECT_EQ(statistics["checks"][2]["met"], true);
    EXPECT_EQ(run_with({"--require", "up.received==0"}).exit, 0);
}

TEST(EmulatorUsage, RefusesARequirementThatNoStatisticsCanMeet)
{
    expect_refusal(run_with({"--require", "up.recieved>=1"}), 2, {"recieved", "received"});
    expect_refusal(run_with({"--require", "up.received"}), 2, {"--require", "up.received>1000"});
    expect_refusal(run("hapnet-emulator", {"--listen", "127.0.0.1:0", "--upstream", "127.0.0.1:9",
                                           "--require", "client>1", "--duration", "50ms"}),
                   2, {"clients"});
}

TEST(EmulatorUsage, EndsCleanlyOnEitherSignalWithItsStatisticsWritten)
{
    for (const int signal_number : {SIGTERM, SIGINT}) {
        Host a;
        Host b;
        Emulator emulator{{"--delay", "1s", "--b", b.endpoint().to_text()}};
        a.send(emulator.a(), 0);
        a.receive(1, 50ms);
        const auto statistics = emulator.stop(signal_number);
        EXPECT_EQ(statistics["up"]["received"], 1);
        EXPECT_EQ(statistics["up"]["in_flight"], 1);
    }
}

TEST(EmulatorUsage, LeavesNoPartOfAStatisticsFileBehind)
{
    const TemporaryFolder folder;
    const auto outcome = run_with({"--stats", folder.file("stats.json")});
    EXPECT_EQ(outcome.exit, 0);
    EXPECT_TRUE(nlohmann::json::accept(text_of(folder.file("stats.json"))));
    EXPECT_EQ(folder.names(), std::vector<std::string>{"stats.json"});
}

} // namespace hapnet::e2e
