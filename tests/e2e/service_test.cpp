// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The daemons under a service manager, as systemd is to a unit of Type=notify with WatchdogSec=.
#include "proto/net/clock.hpp"
#include "tests/e2e/peer.hpp"
#include "tests/e2e/recorded_peer.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <gtest/gtest.h>
#include <poll.h>
#include <string>
#include <sys/socket.h>
#include <sys/un.h>
#include <thread>
#include <tuple>
#include <unistd.h>
#include <vector>

namespace hapnet::e2e {

namespace {

using namespace std::chrono_literals;

/// A message to the manager, and when the manager looked.
struct Heard {
    std::string text;
    base::TimePoint at;
};

/// Listens as systemd does, and gives what is started in its lifetime the environment of a service
/// that has to show signs of life every 100 ms.
class Manager {
public:
    Manager() : socket_{socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)}
    {
        const std::string path = folder_.file("notify");
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        std::memcpy(address.sun_path, path.data(), path.size());
        EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
        setenv("NOTIFY_SOCKET", path.c_str(), 1);
        setenv("WATCHDOG_USEC", "100000", 1);
    }
    ~Manager()
    {
        unsetenv("NOTIFY_SOCKET");
        unsetenv("WATCHDOG_USEC");
        close(socket_);
    }
    Manager(const Manager&) = delete;
    Manager& operator=(const Manager&) = delete;

    /// Returns the next message; "" when there is none within 10 s.
    [[nodiscard]] Heard next(std::chrono::milliseconds most = 10s) const
    {
        pollfd polled{socket_, POLLIN, 0};
        if (poll(&polled, 1, static_cast<int>(most.count())) <= 0) return {};
        std::array<char, 256> bytes{};
        const auto count = recv(socket_, bytes.data(), bytes.size(), 0);
        return {{bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0))},
                net::monotonic_now()};
    }
    /// Returns the first message that is not a sign of life.
    [[nodiscard]] std::string next_news() const
    {
        while (true) {
            const std::string text = next().text;
            if (text != "WATCHDOG=1") return text;
        }
    }

private:
    TemporaryFolder folder_;
    int socket_;
};

/// Expects news when the program is ready and when it stops, and signs of life between.
void expect_a_service(const Manager& manager, Process& program, std::string_view line)
{
    EXPECT_EQ(manager.next().text, "READY=1");
    EXPECT_TRUE(program.wait_for_out(line, 1s));
    for (int i = 0; i < 3; ++i) EXPECT_EQ(manager.next().text, "WATCHDOG=1");
    program.signal(SIGTERM);
    EXPECT_EQ(manager.next_news(), "STOPPING=1");
    EXPECT_EQ(program.wait_exit(10s), 0);
    EXPECT_EQ(manager.next(0ms).text, "");
}

} // namespace

TEST(Service, OfTheEmulatorIsReadyWhenItRelays)
{
    const Manager manager;
    Process emulator{"hapnet-emulator", {"--listen-a", "127.0.0.1:0", "--listen-b", "127.0.0.1:0"}};
    expect_a_service(manager, emulator, "ready ");
}

TEST(Service, OfAPeerIsReadyWhenItsLoopRuns)
{
    const Manager manager;
    Process peer{"hapnet-peer", {"--remote", free_place()}};
    expect_a_service(manager, peer, "ready ");
}

TEST(Service, OfThePageIsReadyWhenItListens)
{
    if (!std::filesystem::exists(HAPNET_BIN_DIR "/hapnet-web")) GTEST_SKIP() << "built without it";
    const Manager manager;
    Process page{"hapnet-web", {"--port", "0"}};
    expect_a_service(manager, page, "open ");
}

TEST(Service, OfAPeerShowsNoSignOfLifeWhileItsLoopStandsStill)
{
    TemporaryFolder folder;
    RecordedPlay play;
    play.trouble = Trouble::long_hang; // 200 ms
    play.messages = folder.file("stderr");
    play.listen = free_place();
    Peer other{2, free_place(), play.listen, {"--task", "P1", "--duration", "60s"}};
    play.remote = other.listen();

    const Manager manager; // not the manager of the other test
    RecordedPeer recorded{play};
    std::vector<base::TimePoint> signs;
    std::jthread reader{[&](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
            const Heard heard = manager.next(20ms);
            if (heard.text == "WATCHDOG=1") signs.push_back(heard.at);
        }
    }};
    base::TimePoint hung;
    EXPECT_TRUE(recorded.tells([&](const std::vector<Told>& told) {
        const auto trouble = std::ranges::find_if(told, &Told::is_trouble);
        if (trouble == told.end()) return false;
        hung = base::TimePoint{base::Duration{trouble->at_ns}};
        return net::monotonic_now() > hung + 500ms;
    }));
    reader.request_stop();
    reader.join();
    recorded.signal(SIGTERM);
    const auto between = [&](base::Duration from, base::Duration to) {
        return std::ranges::count_if(
            signs, [&](base::TimePoint at) { return at > hung + from && at < hung + to; });
    };
    EXPECT_GT(between(-500ms, 0ms), 2);
    EXPECT_EQ(between(100ms, 195ms), 0); // one may be on its way at first
    EXPECT_GT(between(200ms, 500ms), 1);
    std::ignore = recorded.wait_end();
}

} // namespace hapnet::e2e
