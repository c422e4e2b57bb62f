// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/cli/command_line.hpp"

#include "peer/core/sync/text.hpp"
#include "tests/support/cli/help_faults.hpp"

#include <cstdio>
#include <fstream>
#include <gtest/gtest.h>

namespace hapnet::peer {
namespace {

using namespace std::chrono_literals;

std::string refusal_to(std::vector<std::string> words)
{
    return cli::refusal_of(parse_command_line, "hapnet-peer", std::move(words));
}

/// The refusal of words for a session, after a --remote.
std::string refusal_to_session(std::vector<std::string> words)
{
    words.insert(words.begin(), {"--remote", "127.0.0.1:9"});
    return refusal_to(std::move(words));
}

Options session_of(std::vector<std::string> words)
{
    words.insert(words.begin(), {"--remote", "127.0.0.1:9"});
    cli::Typed typed{"hapnet-peer", std::move(words)};
    return std::get<Options>(std::get<Command>(parse_command_line(typed.words()).value()));
}

void expect_words(const std::string& text, const std::string& words)
{
    EXPECT_NE(text.find(words), std::string::npos) << words << " is not in: " << text;
}

TEST(PeerOptions, HaveACompleteHelp)
{
    const auto prints = cli::prints_of("hapnet-peer", parse_command_line);
    EXPECT_EQ(cli::help_faults("hapnet-peer", prints), std::vector<std::string>{});
    EXPECT_EQ(cli::listed_commands(prints({"--help"}).value()),
              (std::vector<std::string>{"list-devices", "doctor", "self-test", "keygen", "key",
                                        "schema"}));
    EXPECT_EQ(prints({"--help"})->rfind("Usage: hapnet-peer [OPTIONS]\n", 0), 0U);
    EXPECT_EQ(prints({"self-test", "-h"})->rfind("Usage: hapnet-peer self-test --device ", 0), 0U);
}

TEST(PeerOptions, HoldWhatWasTyped)
{
    const Options options =
        session_of({"--id", "2", "--listen", ":7102", "--task", "T4", "--duration", "20s",
                    "--force-limit", "500mN", "--seed", "7", "--algorithm", "sep"});
    EXPECT_EQ(options.id, 2);
    EXPECT_EQ(options.listen.host, "127.0.0.1");
    EXPECT_EQ(options.listen.port, 7102);
    ASSERT_EQ(options.others.size(), 1U);
    EXPECT_EQ(options.others[0].place.port, 9);
    EXPECT_EQ(options.roster().others, std::vector<std::uint16_t>{0});
    EXPECT_EQ(options.scene_name, "lift");
    EXPECT_EQ(options.duration, 20s);
    EXPECT_EQ(options.force_max_n, 0.5);
    EXPECT_EQ(options.seed, base::Seed{7});
    EXPECT_EQ(name_of(options.algorithm), "sep");
    EXPECT_EQ(session_of({"--task", "T4", "--scene", "paper"}).scene_name, "paper");
}

TEST(PeerOptions, TakeNamesInSmallLettersAndByTheirUsualShortForms)
{
    EXPECT_EQ(session_of({"--task", "t3"}).task, device::Task::t3);
    EXPECT_EQ(name_of(session_of({"--algorithm", "dr"}).algorithm), "dead-reckoning");
    EXPECT_EQ(name_of(session_of({"--algorithm", "DR"}).algorithm), "dead-reckoning");
}

TEST(PeerOptions, SayWhatStandsInForWhatIsNotHere)
{
    expect_words(refusal_to_session({"--algorithm", "tidec"}), "--algorithm sep");
    expect_words(refusal_to_session({"--device", "touch"}), "--device hdapi");
    expect_words(refusal_to_session({"--device", "omni"}), "--device omni1394");
    expect_words(refusal_to({"devices"}), "did you mean hapnet-peer list-devices?");
    expect_words(refusal_to({"start"}), "did you mean hapnet-peer --remote ADDRESS?");
    expect_words(refusal_to_session({"--algo", "sep"}), "did you mean --algorithm?");
    expect_words(refusal_to_session({"--host", "x"}), "did you mean --remote?");
}

TEST(PeerOptions, NameTheOptionTheTextAndTheRange)
{
    EXPECT_EQ(refusal_to_session({"--id", "0"}),
              "--id: expected a whole number from 1 to 65535, not 0");
    expect_words(refusal_to_session({"--duration", "10ms"}), "--duration: '10ms'");
    expect_words(refusal_to_session({"--duration", "10ms"}), "1s or more");
    expect_words(refusal_to_session({"--force-limit", "-1N"}), "0N to 40N");
    expect_words(refusal_to_session({"--mount-scale", "30"}), "0.05 to 20");
    expect_words(refusal_to({"--remote", "127.0.0.1:0"}), "--remote: '127.0.0.1:0'");
    expect_words(refusal_to_session({"--record", "-"}), "--record: '-' is not a file");
    EXPECT_EQ(refusal_to({}), "--remote is required: --remote 127.0.0.1:7001");
    expect_words(refusal_to({"self-test", "--device", "sim", "--skip", "all"}), "cable");
}

TEST(PeerOptions, PrintAnAlgorithmWithoutARemote)
{
    const auto prints = cli::prints_of("hapnet-peer", parse_command_line);
    expect_words(prints({"--print-algorithm", "dr"}).value(), "velocity = ");
    expect_words(refusal_to({"--print-algorithm", "best"}),
                 "--print-algorithm: there is neither a file nor an algorithm 'best'");
    expect_words(prints({"doctor", "--print-udev-rules"}).value(), "SUBSYSTEM");
}

Options circle_of(std::vector<std::string> words)
{
    words.insert(words.begin(), {"--peer", "3=127.0.0.1:9", "--peer", "2=127.0.0.1:8"});
    cli::Typed typed{"hapnet-peer", std::move(words)};
    return std::get<Options>(std::get<Command>(parse_command_line(typed.words()).value()));
}

std::string refusal_to_circle(std::vector<std::string> words)
{
    words.insert(words.begin(), {"--peer", "3=127.0.0.1:9", "--peer", "2=127.0.0.1:8"});
    return refusal_to(std::move(words));
}

TEST(PeerOptions, NameTheOthersOfACircleInTheOrderOfTheirIds)
{
    const Options options = circle_of({"--task", "T7"});
    EXPECT_EQ(options.roster().others, (std::vector<std::uint16_t>{2, 3}));
    EXPECT_EQ(options.roster().wait_for, 0U);
    EXPECT_EQ(options.others[0].place.port, 8);
    EXPECT_EQ(options.scene_name, "carry");
    EXPECT_EQ(circle_of({"--task", "T3"}).scene_name, "carry");
    EXPECT_EQ(circle_of({"--task", "T7", "--wait-for", "2"}).roster().wait_for, 2U);
    EXPECT_EQ(circle_of({"--task", "T7", "--wait-for", "all"}).roster().wait_for, 0U);
}

TEST(PeerOptions, LetOneNamedPeerBeWhoeverAnswersThere)
{
    cli::Typed typed{"hapnet-peer", {"--peer", "2=127.0.0.1:8"}};
    const auto options =
        std::get<Options>(std::get<Command>(parse_command_line(typed.words()).value()));
    EXPECT_EQ(options.roster().others, std::vector<std::uint16_t>{0});
    EXPECT_EQ(options.scene_name, "paper");
}

TEST(PeerOptions, WantAHandInTheSceneForTheProxyOfTheOtherOne)
{
    const std::string file = testing::TempDir() + "hapnet-one-hand.toml";
    std::ofstream{file} << "name = \"one\"\n[hips]\ncount = 1\n[[body]]\nname = \"cube\"\n"
                           "size = \"40mm\"\nmass = \"100g\"\nturning = \"locked\"\n";
    const auto says = [&file](const std::string& algorithm) {
        cli::Typed typed{"hapnet-peer",
                         {"--remote", "127.0.0.1:8", "--scene", file, "--algorithm", algorithm}};
        const auto parsed = parse_command_line(typed.words());
        return parsed ? std::string{} : parsed.error().message;
    };
    EXPECT_EQ(says("base"), ""); // in it the other hand is only a force
    expect_words(says("remote-proxy"), "has room for 1 hands ([hips] count), and 2 peers");
    std::remove(file.c_str());
}

TEST(PeerOptions, SayWhatDoesNotFitACircle)
{
    expect_words(refusal_to_circle({}), "--scene paper has room for 2 hands");
    expect_words(refusal_to_circle({}), "use --task T7, or --scene carry");
    EXPECT_EQ(refusal_to_circle({"--task", "T7", "--algorithm", "sep"}),
              "--algorithm sep is for two peers: more than two play with another one, such as "
              "base or remote-proxy");
    EXPECT_EQ(refusal_to_circle({"--task", "T7", "--peer", "2=127.0.0.1:7"}),
              "--peer 2: this peer is named twice");
    expect_words(refusal_to_circle({"--task", "T7", "--id", "3"}), "--peer 3: this is the id of");
    expect_words(refusal_to_circle({"--task", "T7", "--id", "32"}), "ids are from 1 to 31");
    expect_words(refusal_to_circle({"--task", "T7", "--wait-for", "4"}),
                 "--wait-for 4: there are 3");
    expect_words(refusal_to_circle({"--wait-for", "1"}), "write all, or a number from 2 to 8");
    expect_words(refusal_to_circle({"--remote", "127.0.0.1:7"}), "--peer and --remote both say");
    std::vector<std::string> nine{"--task", "T7"};
    for (int id = 4; id < 10; ++id)
        nine.insert(nine.end(), {"--peer", std::to_string(id) + "=127.0.0.1:7"});
    expect_words(refusal_to_circle(nine), "9 peers are named, this one counted: a session has 8");
}

} // namespace
} // namespace hapnet::peer
