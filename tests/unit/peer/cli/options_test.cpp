// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/cli/command_line.hpp"

#include "peer/core/sync/text.hpp"
#include "tests/support/cli/help_faults.hpp"

#include <gtest/gtest.h>

namespace hapnet::peer {
namespace {

using namespace std::chrono_literals;

std::string refusal_to(std::vector<std::string> words)
{
    return cli::refusal_of(parse_command_line, "hapnet-peer", std::move(words));
}

/// Of a session, behind a --remote.
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
              (std::vector<std::string>{"list-devices", "doctor", "self-test", "keygen", "key"}));
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
    EXPECT_EQ(options.remote.port, 9);
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

} // namespace
} // namespace hapnet::peer
