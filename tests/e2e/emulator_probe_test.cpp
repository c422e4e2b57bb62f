// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A probe and the program that answers it, directly and through the emulator.
#include "tests/e2e/emulator.hpp"
#include "tests/e2e/process.hpp"
#include "tests/e2e/udp.hpp"
#include "tests/support/ipv6.hpp"

#include <chrono>
#include <csignal>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>

namespace hapnet::e2e {

namespace {

using namespace std::chrono_literals;

/// `hapnet-emulator probe --answer` on a free port.
class AnsweringProbe {
public:
    explicit AnsweringProbe(const std::string& listen = "127.0.0.1:0")
        : process_{"hapnet-emulator", {"probe", "--answer", listen}}
    {
        const auto ready = process_.wait_for_out("ready ", 10s);
        if (!ready) throw std::runtime_error{"no probe answers: " + process_.err()};
        where_ = endpoint_in(*ready, "answer").to_text();
    }

    [[nodiscard]] const std::string& where() const { return where_; }
    [[nodiscard]] Process& process() { return process_; }

private:
    Process process_;
    std::string where_;
};

} // namespace

TEST(EmulatorProbe, MeasuresTheDelayOfEachWayAndNeverLessThanIsThere)
{
    AnsweringProbe answering;
    Emulator emulator{{"--b", answering.where(), "--up.delay", "40ms", "--down.delay", "15ms"}};
    const auto outcome = run("hapnet-emulator", {"probe", emulator.a().to_text(), "--count", "20",
                                                 "--rate", "100", "--json"});
    EXPECT_EQ(outcome.exit, 0) << outcome.err;
    const auto said = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(said["sent"], 20);
    EXPECT_EQ(said["answered"], 20);
    EXPECT_EQ(said["clocks_are_one"], true);
    EXPECT_GE(said["there"]["delay_ms"]["min"], 40.0);
    EXPECT_GE(said["back"]["delay_ms"]["min"], 15.0);
    EXPECT_GE(said["round_trip"]["delay_ms"]["min"], 55.0);
    std::ignore = emulator.stop();
}

TEST(EmulatorProbe, TellsOnWhichWayItsQuestionsWereLost)
{
    AnsweringProbe answering;
    const TemporaryFolder folder;
    Emulator emulator{
        {"--b", answering.where(), "--up.loss", "30%", "--down.burst-loss", "1/4", "--seed", "3"}};
    const auto outcome =
        run("hapnet-emulator", {"probe", emulator.a().to_text(), "--count", "60", "--rate", "200",
                                "--json", "--csv", folder.file("probe.csv")});
    EXPECT_EQ(outcome.exit, 0) << outcome.err;
    const auto said = nlohmann::json::parse(outcome.out);
    const auto statistics = emulator.stop();
    const auto lost = [&](const char* way, const char* cause) {
        return statistics[way]["dropped"][cause].get<std::uint64_t>();
    };
    const auto unknown = said["lost_on_unknown_way"].get<std::uint64_t>();
    const auto there = said["there"]["lost"].get<std::uint64_t>();
    const auto back = said["back"]["lost"].get<std::uint64_t>();
    EXPECT_EQ(there + back + unknown, lost("up", "random_loss") + lost("down", "burst_loss"));
    EXPECT_LE(there, lost("up", "random_loss"));
    EXPECT_GE(there + unknown, lost("up", "random_loss"));
    EXPECT_GT(back, 5U);
    const auto csv = text_of(folder.file("probe.csv"));
    EXPECT_EQ(std::ranges::count(csv, '\n'), 61);
}

TEST(EmulatorProbe, IsLearnedFromACaptureOfTheEmulatorThatItPassed)
{
    AnsweringProbe answering;
    const TemporaryFolder folder;
    const auto capture = folder.file("run.pcapng");
    Emulator emulator{{"--b", answering.where(), "--up.delay", "20ms", "--down.delay", "5ms",
                       "--down.burst-loss", "1/4", "--pcap", capture}};
    const auto asked = run("hapnet-emulator", {"probe", emulator.a().to_text(), "--count", "60",
                                               "--rate", "200", "--quiet"});
    EXPECT_EQ(asked.exit, 0) << asked.err;
    std::ignore = emulator.stop();
    const auto learned = run("hapnet-emulator", {"learn", capture, "--plot"});
    ASSERT_EQ(learned.exit, 0) << learned.err;
    for (const char* words : {"up: loss: none of 60", "down: loss: ", "up: delays from ... ms: #",
                              "clocks of the two ends are taken for one"}) {
        EXPECT_NE(learned.err.find(words), std::string::npos) << learned.err;
    }
    std::ofstream{folder.file("learned.toml")} << learned.out;
    const auto checked = run("hapnet-emulator", {"check", folder.file("learned.toml")});
    EXPECT_EQ(checked.exit, 0) << checked.err;
}

TEST(EmulatorProbe, PrintsALineForEachAnswerAndItsSummaryWhenItIsInterrupted)
{
    AnsweringProbe answering;
    Process probe{"hapnet-emulator", {"probe", answering.where(), "--rate", "50"}};
    ASSERT_TRUE(probe.wait_for_out("seq=2 time=", 10s));
    probe.signal(SIGINT);
    EXPECT_EQ(probe.wait_exit(10s), 0) << probe.err();
    EXPECT_NE(probe.out().find("136 bytes from " + answering.where() + ": seq=0 time="),
              std::string::npos);
    EXPECT_NE(probe.out().find("probe statistics ---\n"), std::string::npos);
    EXPECT_NE(probe.out().find("round trip"), std::string::npos);
    answering.process().signal(SIGINT);
    EXPECT_EQ(answering.process().wait_exit(10s), 0);
}

TEST(EmulatorProbe, ExitsWithOneAndSaysWhatToLookForWhenNothingAnswers)
{
    const auto outcome = run("hapnet-emulator", {"probe", Host{}.endpoint().to_text(), "--count",
                                                 "2", "--rate", "100", "--wait", "50ms"});
    EXPECT_EQ(outcome.exit, 1);
    EXPECT_NE(outcome.out.find("2 sent, 0 answered, 100% lost"), std::string::npos);
    EXPECT_NE(outcome.err.find("probe --answer"), std::string::npos);
}

TEST(EmulatorProbe, DoesNotAnswerWhatIsNoQuestion)
{
    AnsweringProbe answering;
    Host host;
    host.send(endpoint_of(answering.where()), 1);
    EXPECT_TRUE(host.receive(1, 200ms).empty());
    EXPECT_EQ(run("hapnet-emulator", {"probe", answering.where(), "--count", "1"}).exit, 0);
}

TEST(EmulatorProbe, MeasuresOverIpv6)
{
    if (!test::has_ipv6()) GTEST_SKIP() << "no IPv6 here";
    AnsweringProbe answering{"[::1]:0"};
    const auto outcome =
        run("hapnet-emulator", {"probe", answering.where(), "--count", "2", "--size", "1200"});
    EXPECT_EQ(outcome.exit, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("1200 bytes from [::1]:"), std::string::npos);
}

TEST(EmulatorProbe, RefusesWhatItCannotDoNamingTheCure)
{
    expect_refusal(run("hapnet-emulator", {"probe"}), 2, {"HOST:PORT is required", "--answer"});
    expect_refusal(run("hapnet-emulator", {"probe", "127.0.0.1:0"}), 2, {"port 0"});
    expect_refusal(run("hapnet-emulator", {"probe", "7001", "--answer", "7002"}), 2,
                   {"exclude each other"});
    expect_refusal(run("hapnet-emulator", {"probe", "--answer", "7002", "--count", "2"}), 2,
                   {"--count", "asks"});
    expect_refusal(run("hapnet-emulator", {"probe", "127.0.0.1:7", "--size", "71"}), 2,
                   {"--size", "72"});
    expect_refusal(run("hapnet-emulator", {"probe", "127.0.0.1:7", "--rate", "0"}), 2,
                   {"--rate", "'0'"});
}

} // namespace hapnet::e2e
