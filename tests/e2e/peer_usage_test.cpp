// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Messages of the peer to the person or script that starts it.
#include "tests/e2e/no_network.hpp"
#include "tests/e2e/peer.hpp"
#include "tests/e2e/udp.hpp"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <initializer_list>
#include <string>
#include <vector>

namespace hapnet::e2e {

namespace {

using namespace std::chrono_literals;

Outcome run_peer_with(std::vector<std::string> options)
{
    options.insert(options.begin(), {"--remote", "127.0.0.1:9"});
    return run("hapnet-peer", options, 10s);
}

} // namespace

TEST(PeerUsage, PrintsHelpWithEveryOptionAndExamples)
{
    const auto outcome = run("hapnet-peer", {"--help"});
    EXPECT_EQ(outcome.exit, 0);
    for (const char* word : {"--id",
                             "--force-limit",
                             "--listen",
                             "--remote",
                             "--device",
                             "--scene",
                             "--grip-damping",
                             "--task",
                             "--algorithm",
                             "--seed",
                             "--key",
                             "--duration",
                             "--record",
                             "--stats",
                             "--control",
                             "--insecure",
                             "--no-roam",
                             "--peer",
                             "keygen",
                             "--version",
                             "Examples",
                             "P1",
                             "T1",
                             "T3",
                             "Exit codes",
                             "list-devices",
                             "doctor",
                             "self-test",
                             "--mount-scale"}) {
        EXPECT_NE(outcome.out.find(word), std::string::npos) << word;
    }
}

TEST(PeerUsage, PrintsItsVersion)
{
    const auto outcome = run("hapnet-peer", {"--version"});
    EXPECT_EQ(outcome.exit, 0);
    EXPECT_EQ(outcome.out.rfind("hapnet-peer ", 0), 0U);
}

TEST(PeerUsage, RefusesWhatItDoesNotKnowNamingIt)
{
    expect_refusal(run("hapnet-peer", {}), 2, {"--remote"});
    expect_refusal(run_peer_with({"--tsak", "P1"}), 2, {"--tsak", "did you mean --task?"});
    expect_refusal(run_peer_with({"stray"}), 2, {"stray"});
    expect_refusal(run_peer_with({"--task", "P2"}), 2, {"--task", "'P2'", "P1, T1, T2, T3"});
    expect_refusal(run_peer_with({"--operator", "giant"}), 2, {"--operator", "'giant'", "nominal"});
    expect_refusal(run_peer_with({"--device", "replay:/no/such.csv"}), 2,
                   {"--device", "/no/such.csv"});
    expect_refusal(
        run_peer_with({"--algorithm", "newest"}), 2,
        {"--algorithm", "neither a file nor an algorithm 'newest'", "base, dead-reckoning, sep"});
    expect_refusal(run_peer_with({"--device", "omni1394:"}), 2, {"--device", "'omni1394:'", "sim"});
    expect_refusal(run_peer_with({"--scene", "papers"}), 2, {"--scene", "'papers'", "paper"});
}

TEST(PeerUsage, RefusesBadValuesNamingTheOptionTheTextAndTheCure)
{
    expect_refusal(run_peer_with({"--duration", "30"}), 2, {"--duration", "'30'", "30us or 30s"});
    expect_refusal(run_peer_with({"--duration", "5%"}), 2, {"--duration", "'5%'"});
    expect_refusal(run_peer_with({"--duration", "10ms"}), 2, {"--duration", "1s or more"});
    expect_refusal(run_peer_with({"--id", "0"}), 2, {"--id", "1 to 65535"});
    expect_refusal(run_peer_with({"--id", "65536"}), 2, {"--id", "65536"});
    expect_refusal(run_peer_with({"--seed", "x"}), 2, {"--seed", "'x'"});
    expect_refusal(run_peer_with({"--grip-damping", "4"}), 2,
                   {"--grip-damping", "'4'", "write 4Ns/m"});
    expect_refusal(run_peer_with({"--grip-damping", "0"}), 2, {"--grip-damping", "more than 0"});
    expect_refusal(run_peer_with({"--force-limit", "3"}), 2,
                   {"--force-limit", "'3'", "write 3N, 3mN"});
    expect_refusal(run_peer_with({"--force-limit", "-1N"}), 2, {"--force-limit", "0N to 40N"});
    expect_refusal(run_peer_with({"--listen", "here"}), 2, {"--listen", "HOST:PORT"});
    expect_refusal(run("hapnet-peer", {"--remote", "127.0.0.1:0"}), 2, {"--remote", "port"});
    expect_refusal(run("hapnet-peer", {"--remote", "127.0.0.1:99999"}), 2, {"--remote", "65535"});
    expect_refusal(run_peer_with({"--listen", "[::1]:0"}), 2,
                   {"--listen", "--remote", "IPv4", "IPv6"});
    expect_refusal(run_peer_with({"--task"}), 2, {"--task"});
}

TEST(PeerUsage, RefusesAScenePointingAtTheLineAndAtTheCure)
{
    expect_refusal(run_peer_with({"--scene", "no/such.toml"}), 2, {"--scene", "no/such.toml"});
    expect_refusal(run_peer_with({"--scene", "stack-10"}), 2,
                   {"--scene", "tests/bench/scenes/stack-10.toml"});
    expect_refusal(run_peer_with({"--scene", "push-6dof", "--algorithm", "sep"}), 2,
                   {"--algorithm", "'sep'", "turning = \"locked\""});
    const std::string file = testing::TempDir() + "hapnet-bad-scene.toml";
    std::ofstream{file}
        << "name = \"bad\"\n[[body]]\nsize = \"40mm\"\nmass = \"100g\"\nfricton = 0.3\n";
    expect_refusal(run_peer_with({"--scene", file}), 2, {"--scene", file + ":5:1: ", "'friction'"});
    std::filesystem::remove(file);
}

TEST(PeerUsage, PrintsAnAlgorithmThatItTakesFromAFileAgain)
{
    const auto printed = run("hapnet-peer", {"--print-algorithm", "dead-reckoning"});
    EXPECT_EQ(printed.exit, 0);
    EXPECT_NE(printed.out.find("velocity = \"nominal\""), std::string::npos);
    const std::string file = testing::TempDir() + "hapnet-algorithm.toml";
    std::ofstream{file} << printed.out;
    EXPECT_EQ(run("hapnet-peer", {"--print-algorithm", file}).out, printed.out);
    std::ofstream{file} << "algorithm = \"sep\"\nfade_aftr = \"1ms\"\n";
    expect_refusal(run_peer_with({"--algorithm", file}), 2,
                   {"--algorithm", file + ":2:1: ", "did you mean 'fade_after'?"});
    std::filesystem::remove(file);
}

/// The code of a shared object runs as soon as it is loaded.
TEST(PeerUsage, RunsNoCodeOfAnAlgorithmWhereItOnlyPrintsOrRefuses)
{
    const TemporaryFolder folder;
    const auto loaded = folder.file("loaded");
    setenv("HAPNET_LOADED", loaded.c_str(), 1);
    const std::string own = HAPNET_EXAMPLE_LEAVING;
    const auto file = folder.file("own.toml");
    std::ofstream{file} << "algorithm = \"shared-object\"\nfile = \"" << own << "\"\n";
    for (const std::string& algorithm : {own, file}) {
        const auto printed = run("hapnet-peer", {"--print-algorithm", algorithm});
        EXPECT_EQ(printed.exit, 0) << printed.err;
        EXPECT_NE(printed.out.find(own), std::string::npos) << printed.out;
        for (const std::vector<std::string>& more : std::initializer_list<std::vector<std::string>>{
                 {"--print-algorithm", "base"}, {"--help"}, {"--version"}}) {
            std::vector<std::string> words{"--algorithm", algorithm};
            words.insert(words.end(), more.begin(), more.end());
            EXPECT_EQ(run("hapnet-peer", words).exit, 0);
        }
        expect_refusal(run_peer_with({"--algorithm", algorithm, "--task", "T99"}), 2, {"--task"});
        expect_refusal(run_peer_with({"--algorithm", algorithm, "--record", ""}), 2, {"--record"});
    }
    const auto experiment = folder.file("own-experiment.toml");
    std::ofstream{experiment} << "kind = \"table1\"\ntitle = \"own\"\nduration = \"6s\"\n"
                                 "seeds = 1\nalgorithms = [\"leaving\"]\ntasks = [\"T1\"]\n"
                                 "[both]\ndelay = \"40ms\"\n[algorithm.leaving]\n"
                                 "algorithm = \"shared-object\"\nfile = \""
                              << own << "\"\n";
    const auto planned = run("hapnet-lab", {"plan", experiment, "--out", folder.file("plan")});
    EXPECT_EQ(planned.exit, 0) << planned.err;
    EXPECT_EQ(text_of(loaded), "") << "a command ran code of the shared object";
    // The file reports that it was loaded. A file that ends the program makes the run fail.
    const auto played = run("hapnet-lab", {"run", folder.file("plan")}, 60s);
    EXPECT_EQ(played.exit, 1);
    EXPECT_NE(played.err.find(own + " has called exit()"), std::string::npos) << played.err;
    EXPECT_EQ(text_of(loaded), "loaded\n");
    unsetenv("HAPNET_LOADED");
}

TEST(PeerUsage, PlaysOverARealNetworkOnlyWhenToldThatItIsInsecure)
{
    expect_refusal(run("hapnet-peer", {"--remote", "192.0.2.1:7000"}), 2,
                   {"--key", "keygen", "--insecure"});
    expect_refusal(run_peer_with({"--listen", "0.0.0.0:0"}), 2, {"--insecure"});
}

TEST(PeerUsage, ListensOnLoopbackForLoopbackOnly)
{
    expect_refusal(run("hapnet-peer", {"--remote", "192.0.2.1:7000", "--insecure"}), 2,
                   {"--remote 192.0.2.1:7000", "--listen 127.0.0.1:0", "--listen 0.0.0.0:7000"});
}

TEST(PeerUsage, RefusesARemoteFromWhichNoAnswerCanCome)
{
    for (const char* remote : {"224.0.0.1:7000", "255.255.255.255:7000", "0.0.0.0:7000"}) {
        expect_refusal(
            run("hapnet-peer", {"--remote", remote, "--listen", "0.0.0.0:0", "--insecure"}), 2,
            {"--remote", remote, "one host"});
    }
}

TEST(PeerUsage, RefusesOneFileForTwoResults)
{
    const TemporaryFolder folder;
    const std::string file = folder.file("same");
    expect_refusal(run_peer_with({"--record", file, "--stats", file}), 2, {"--record", file});
    std::ofstream{file} << "kept";
    std::filesystem::create_symlink(file, folder.file("other"));
    expect_refusal(run_peer_with({"--record", folder.file("other"), "--stats", file}), 2,
                   {"--record", "--stats"});
    EXPECT_EQ(text_of(file), "kept");
    expect_refusal(run_peer_with({"--stats", ""}), 2, {"--stats", "needs a file"});
    expect_refusal(run_peer_with({"--record", ""}), 2, {"--record", "not a file"});
}

TEST(PeerUsage, LeavesAnOlderRecordAsItIsWhenItRefusesToStart)
{
    const TemporaryFolder folder;
    const std::string file = folder.file("keep.rec");
    std::ofstream{file} << "an older record";
    expect_refusal(run_peer_with({"--record", file, "--stats", "/no/such/folder/x.json"}), 3,
                   {"/no/such/folder"});
    expect_refusal(run_peer_with({"--record", file, "--control", "/no/such/folder/x.sock"}), 3,
                   {"/no/such/folder"});
    expect_refusal(run_peer_with({"--record", file, "--dead-man", "evdev:/dev/null"}), 3,
                   {"--dead-man", "/dev/null"});
    EXPECT_EQ(text_of(file), "an older record");
}

TEST(PeerUsage, RefusesForcesAndDampingsThatNoHandCouldTellFromNone)
{
    expect_refusal(run_peer_with({"--grip-damping", "1e-300Ns/m"}), 2, {"--grip-damping"});
    expect_refusal(run_peer_with({"--force-limit", "1e-320N"}), 2, {"--force-limit", "0N to 40N"});
    expect_refusal(run_peer_with({"--dead-man", "pedal"}), 2, {"--dead-man", "'pedal'", "button"});
}

TEST(PeerUsage, EndsWithThreeWhenTheSystemRefuses)
{
    const Host occupant;
    expect_refusal(run_peer_with({"--listen", occupant.endpoint().to_text()}), 3,
                   {occupant.endpoint().to_text(), "in use"});
    expect_refusal(run("hapnet-peer", {"--remote", "no-such-host.invalid:7000"}), 3,
                   {"no-such-host.invalid"});
    expect_refusal(run_peer_with({"--record", "/no/such/folder/a.rec"}), 3,
                   {"/no/such/folder/a.rec"});
    expect_refusal(run_peer_with({"--stats", "/no/such/folder/a.json"}), 3, {"/no/such/folder"});
}

TEST(PeerUsage, EndsWithThreeWhenThereIsNoRoute)
{
    const NoNetwork none;
    if (!none.in_force()) GTEST_SKIP() << "needs to be root, to take the network away";
    expect_refusal(
        run("hapnet-peer", {"--remote", "192.0.2.1:7000", "--insecure", "--listen", "0.0.0.0:0"}),
        3, {"192.0.2.1", "nreachable"});
}

TEST(PeerUsage, SaysWhyTwoPeersCannotPlayTogetherAndHowTheyCould)
{
    struct Case {
        std::string id;
        std::string task;
        std::string scene;
        std::string cure;
    };
    const std::string heavy = testing::TempDir() + "hapnet-heavy.toml";
    std::ofstream{heavy} << "[[body]]\nsize = \"40mm\"\nmass = \"1kg\"\nturning = \"locked\"\n";
    for (const Case& c : {Case{"2", "P1", "paper", "--task"}, Case{"1", "T3", "paper", "--id"},
                          Case{"2", "T3", heavy, "--scene"}}) {
        const std::string place_a = free_place();
        const std::string place_b = free_place();
        Process a{"hapnet-peer",
                  {"--id", "1", "--task", "T3", "--listen", place_a, "--remote", place_b}};
        Process b{"hapnet-peer",
                  {"--id", c.id, "--task", c.task, "--scene", c.scene, "--listen", place_b,
                   "--remote", place_a}};
        for (Process* peer : {&a, &b}) {
            EXPECT_EQ(peer->wait_exit(10s), 1);
            EXPECT_TRUE(peer->wait_for_err("refused", 1s)) << peer->err();
            EXPECT_NE(peer->err().find(c.cure), std::string::npos) << peer->err();
        }
    }
    std::filesystem::remove(heavy);
}

} // namespace hapnet::e2e
