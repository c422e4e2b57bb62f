// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The emulator between a server and any number of clients.
#include "emulator/core/fates/fates.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/udp_socket.hpp"
#include "tests/e2e/emulator.hpp"
#include "tests/e2e/process.hpp"
#include "tests/e2e/udp.hpp"

#include <chrono>
#include <csignal>
#include <gtest/gtest.h>
#include <list>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <vector>

namespace hapnet::e2e {

namespace {

using namespace std::chrono_literals;

/// Answers every datagram with the same bytes.
class EchoServer {
public:
    [[nodiscard]] std::string address() const { return socket_.local().to_text(); }

    /// Answers until `count` datagrams have come, or none for a while.
    void answer(std::size_t count)
    {
        const auto end = net::monotonic_now() + 5s;
        for (std::size_t answered = 0; answered < count && net::monotonic_now() < end;) {
            for (const auto& datagram : socket_.receive()) {
                EXPECT_EQ(socket_.send(datagram.from, datagram.bytes), net::SendOutcome::sent);
                ++answered;
            }
            net::sleep_until(net::monotonic_now() + 1ms);
        }
    }

private:
    net::UdpSocket socket_{endpoint_of("127.0.0.1:0")};
};

class UpstreamRunning {
public:
    explicit UpstreamRunning(const EchoServer& server, const std::vector<std::string>& options)
    {
        std::vector<std::string> words{"--listen",       "127.0.0.1:0", "--upstream",
                                       server.address(), "--stats",     folder_.file("stats.json")};
        words.insert(words.end(), options.begin(), options.end());
        process.emplace("hapnet-emulator", words);
        const auto ready = process->wait_for_out("ready ", 10s);
        if (!ready) throw std::runtime_error{"the emulator is not ready: " + process->err()};
        listen = endpoint_in(*ready, "listen");
    }

    [[nodiscard]] nlohmann::json stop()
    {
        process->signal(SIGTERM);
        EXPECT_EQ(process->wait_exit(10s), 0) << process->err();
        auto statistics = nlohmann::json::parse(text_of(folder_.file("stats.json")));
        expect_identity(statistics["up"]);
        expect_identity(statistics["down"]);
        for (const auto& client : statistics["clients"]) {
            expect_identity(client["up"]);
            expect_identity(client["down"]);
        }
        return statistics;
    }

    std::optional<Process> process;
    std::optional<net::Endpoint> listen;

private:
    TemporaryFolder folder_;
};

} // namespace

TEST(EmulatorUpstream, GivesTenClientsInParallelTheirOwnAnswersAndTheirOwnPaths)
{
    EchoServer server;
    UpstreamRunning emulator{server, {"--delay", "20ms", "--seed", "3"}};
    std::list<Host> clients(10);
    std::uint64_t number = 0;
    for (Host& client : clients) client.send(*emulator.listen, number++);
    server.answer(10);
    number = 0;
    for (Host& client : clients) {
        EXPECT_EQ(numbers_of(client.receive(1, 2s)), std::vector<std::uint64_t>{number++});
        EXPECT_GE(client.arrivals()[0].delay, 40ms - 4us);
    }
    const auto statistics = emulator.stop();
    EXPECT_EQ(statistics["clients"].size(), 10U);
    EXPECT_EQ(statistics["clients_seen"], 10);
    EXPECT_EQ(statistics["up"]["received"], 10);
    EXPECT_EQ(statistics["down"]["delivered"], 10);
    EXPECT_EQ(statistics["clients"][4]["client"], 5);
    EXPECT_EQ(statistics["clients"][4]["up"]["delivered"], 1);
    EXPECT_EQ(statistics["clients"][4]["address"],
              std::next(clients.begin(), 4)->endpoint().to_text());
}

TEST(EmulatorUpstream, TurnsAwayWhoIsNotAllowedAndWhoIsOneTooManyAndSaysSoOnce)
{
    EchoServer server;
    Host inside;
    Host outside;
    {
        UpstreamRunning emulator{server, {"--allow", inside.endpoint().to_text()}};
        for (std::uint64_t i = 0; i < 5; ++i) outside.send(*emulator.listen, i);
        inside.send(*emulator.listen, 7);
        server.answer(1);
        EXPECT_EQ(numbers_of(inside.receive(1, 2s)), std::vector<std::uint64_t>{7});
        EXPECT_TRUE(emulator.process->wait_for_err("as --allow does not name it", 5s));
        const auto statistics = emulator.stop();
        EXPECT_EQ(statistics["up"]["strangers"], 5);
        EXPECT_EQ(statistics["up"]["received"], 1);
    }
    UpstreamRunning emulator{server, {"--clients", "1", "--idle", "1s"}};
    inside.send(*emulator.listen, 1);
    server.answer(1);
    outside.send(*emulator.listen, 2);
    EXPECT_TRUE(emulator.process->wait_for_err("as there are 1 clients already", 5s));
    EXPECT_FALSE(emulator.process->wait_exit(1500ms)); // the first one is forgotten
    outside.send(*emulator.listen, 3);
    server.answer(1);
    EXPECT_EQ(numbers_of(outside.receive(1, 2s)), std::vector<std::uint64_t>{3});
    const auto statistics = emulator.stop();
    EXPECT_EQ(statistics["refused"], 1);
    EXPECT_EQ(statistics["clients_forgotten"], 1);
    EXPECT_EQ(statistics["clients_seen"], 2);
    EXPECT_EQ(statistics["up"]["received"], 2);
}

TEST(EmulatorUpstream, ChangesTheConditionsOfAllClientsOrOfOneAlsoBeforeItComes)
{
    EchoServer server;
    TemporaryFolder folder;
    const auto control = folder.file("s");
    UpstreamRunning emulator{server, {"--delay", "5ms", "--control", control}};
    const auto ctl = [&](std::vector<std::string> words) {
        words.insert(words.begin(), {"--json", control});
        return nlohmann::json::parse(run("hapnet-ctl", words).out, nullptr, false);
    };
    EXPECT_EQ(ctl({"set", "client.2.up.delay", "80ms", "down.delay", "20ms"})["generation"], 2);
    std::list<Host> clients(2);
    for (Host& client : clients) {
        client.send(*emulator.listen, 1);
        server.answer(1);
        ASSERT_EQ(client.receive(1, 2s).size(), 1U);
    }
    EXPECT_GE(clients.front().arrivals()[0].delay, 25ms - 4us);
    EXPECT_GE(clients.back().arrivals()[0].delay, 100ms - 4us);
    EXPECT_EQ(ctl({"set", "client.1.up.loss", "100%"})["effective_at"]["client.1"]["up"], 1);
    for (Host& client : clients) client.send(*emulator.listen, 2);
    server.answer(1);
    EXPECT_EQ(numbers_of(clients.back().receive(2, 2s)), (std::vector<std::uint64_t>{1, 2}));
    const auto statistics = emulator.stop();
    EXPECT_EQ(statistics["clients"][0]["up"]["dropped"]["random_loss"], 1);
    EXPECT_EQ(statistics["generation"], 3);
    // The conditions of future clients, and of each present client.
    EXPECT_EQ(statistics["configuration_at_end"]["down"]["delay"], "20ms");
    EXPECT_EQ(statistics["configuration_at_end"]["up"]["delay"], "5ms");
    const auto& second = statistics["clients"][1];
    EXPECT_EQ(second["name"], "client.2");
    EXPECT_EQ(second["configuration_at_end"]["up"]["delay"], "80ms");
    EXPECT_TRUE(second["changes"].empty()); // the client came after the changes
    EXPECT_EQ(statistics["clients"][0]["changes"][0]["settings"],
              (nlohmann::json{{"client.1.up.loss", "100%"}}));
}

TEST(EmulatorUpstream, RecordsTheFatesOfEachClientAndReplaysThem)
{
    TemporaryFolder folder;
    const auto fates_of = [&](std::vector<std::string> options, const char* name) {
        EchoServer server; // receives, but does not answer
        options.insert(options.end(),
                       {"--fates", folder.file(name), "--pcap", folder.file("run.pcapng")});
        UpstreamRunning emulator{server, options};
        std::list<Host> clients(3);
        for (Host& client : clients) { // one after the other: their order is their number
            for (std::uint64_t n = 0; n < 20; ++n) client.send(*emulator.listen, n);
        }
        net::sleep_until(net::monotonic_now() + 200ms);
        EXPECT_EQ(emulator.stop()["up"]["received"], 60);
        return text_of(folder.file(name));
    };
    const auto first = fates_of({"--loss", "50%", "--seed", "3"}, "first.csv");
    const auto fates = emulator::parse_fates_of_paths(first);
    ASSERT_TRUE(fates) << fates.error().message;
    EXPECT_EQ(fates->size(), 3U);
    EXPECT_EQ(fates->at("client.2").up.size(), 20U);
    EXPECT_NE(fates->at("client.1").up, fates->at("client.3").up);
    EXPECT_EQ(fates_of({"--replay", folder.file("first.csv")}, "again.csv"), first);
    EXPECT_GT(text_of(folder.file("run.pcapng")).size(), 60U * 100U);
}

TEST(EmulatorUpstream, GivesClientsTheSameFatesHoweverManyThreadsRelayThem)
{
    TemporaryFolder folder;
    constexpr std::size_t count = 12;
    const auto fates_with = [&](const char* threads) {
        EchoServer server;
        const auto file = folder.file(std::string{threads} + ".csv");
        UpstreamRunning emulator{server,
                                 {"--loss", "30%", "--delay", "1ms", "--clients", "12", "--seed",
                                  "3", "--set", "client.4.loss=100%", "--threads", threads,
                                  "--control", folder.file("s"), "--fates", file}};
        const auto wait_for = [&](const std::string& condition) {
            const auto waited = run(
                "hapnet-ctl", {folder.file("s"), "wait", "--until", condition, "--timeout", "10s"});
            EXPECT_EQ(waited.exit, 0) << waited.err;
        };
        std::list<Host> clients(count);
        std::size_t come = 0;
        for (Host& client : clients) {
            client.send(*emulator.listen, 0);
            wait_for(fmt::format("clients_seen>={}", ++come)); // that is their number
        }
        for (std::uint64_t n = 1; n < 50; ++n) {
            for (Host& client : clients) client.send(*emulator.listen, n);
        }
        wait_for("up.received>=600");
        Host late;
        late.send(*emulator.listen, 1);
        EXPECT_TRUE(emulator.process->wait_for_err("as there are 12 clients already", 5s));
        const auto statistics = emulator.stop();
        EXPECT_EQ(statistics["clients_seen"], count);
        EXPECT_EQ(statistics["refused"], 1);
        EXPECT_EQ(statistics["clients"].size(), count);
        EXPECT_EQ(statistics["clients"][3]["client"], 4);
        EXPECT_EQ(statistics["clients"][3]["up"]["dropped"]["random_loss"], 50);
        return text_of(file);
    };
    const auto alone = fates_with("1");
    EXPECT_EQ(fates_with("2"), alone);
    EXPECT_EQ(fates_with("4"), alone);
}

TEST(EmulatorUpstream, OnSeveralThreadsHasItsPlaceAlone)
{
    EchoServer server;
    UpstreamRunning emulator{server, {"--threads", "2"}};
    for (const char* threads : {"1", "2"}) {
        const auto second =
            run("hapnet-emulator", {"--listen", emulator.listen->to_text(), "--upstream",
                                    server.address(), "--threads", threads});
        EXPECT_EQ(second.exit, 3) << second.err;
        EXPECT_NE(second.err.find("cannot bind to"), std::string::npos) << second.err;
    }
    std::ignore = emulator.stop();
}

TEST(EmulatorUpstream, CountsAnswersThatNoProgramListensAndNamesTheCure)
{
    std::optional<EchoServer> gone{std::in_place};
    UpstreamRunning emulator{*gone, {}};
    gone.reset();
    Host client;
    constexpr std::uint64_t count = 20;
    stream(client, *emulator.listen, count, 5ms);
    net::sleep_until(net::monotonic_now() + 100ms);
    const auto statistics = emulator.stop();
    EXPECT_EQ(statistics["up"]["unreachable"], count);
    EXPECT_EQ(statistics["up"]["delivered"], count); // the answers fail no other datagram
    EXPECT_EQ(statistics["down"]["unreachable"], 0);
    EXPECT_EQ(statistics["clients"][0]["up"]["unreachable"], count);
    EXPECT_NE(emulator.process->err().find("20 answers that no program listens"), std::string::npos)
        << emulator.process->err();
}

TEST(EmulatorUpstream, IsNeverAnOpenRelayAndNeverItsOwnServer)
{
    const auto said = [](const std::vector<std::string>& words) {
        Process process{"hapnet-emulator", words};
        EXPECT_EQ(process.wait_exit(10s), 2);
        return process.err();
    };
    EXPECT_NE(said({"--listen", "0.0.0.0:0", "--upstream", "127.0.0.1:9"}).find("--allow"),
              std::string::npos);
    EXPECT_NE(said({"--listen", "127.0.0.1:9001", "--upstream", "127.0.0.1:9001"})
                  .find("where the emulator itself listens"),
              std::string::npos);
}

} // namespace hapnet::e2e
