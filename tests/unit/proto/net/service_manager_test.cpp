// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/service_manager.hpp"

#include <array>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace hapnet::net {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{1000s};

/// A socket like that of systemd, at a path or, after '@', at a name in no folder.
class Manager {
public:
    explicit Manager(const std::string& place) : socket_{socket(AF_UNIX, SOCK_DGRAM, 0)}
    {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        std::memcpy(address.sun_path, place.data(), place.size());
        if (place.front() == '@') address.sun_path[0] = '\0';
        const auto length = offsetof(sockaddr_un, sun_path) + place.size();
        EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&address),
                       static_cast<socklen_t>(length)),
                  0);
    }
    ~Manager() { close(socket_); }
    Manager(const Manager&) = delete;
    Manager& operator=(const Manager&) = delete;

    /// The next message; "" when there is none.
    [[nodiscard]] std::string heard() const
    {
        std::array<char, 256> bytes{};
        const auto count = recv(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT);
        return {bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0))};
    }

private:
    int socket_;
};

struct ToldManager : testing::Test {
    ToldManager()
    {
        for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) unsetenv(name);
        std::string pattern = std::filesystem::temp_directory_path() / "hapnet-XXXXXX";
        folder = mkdtemp(pattern.data());
    }
    ~ToldManager() override { std::filesystem::remove_all(folder); }
    ToldManager(const ToldManager&) = delete;
    ToldManager& operator=(const ToldManager&) = delete;

    [[nodiscard]] std::string path() const { return folder + "/notify"; }
    /// A program that has to report there, and to show signs of life at this interval.
    static ServiceManager told(const std::string& place, const char* watchdog_us = nullptr)
    {
        setenv("NOTIFY_SOCKET", place.c_str(), 1);
        if (watchdog_us != nullptr) setenv("WATCHDOG_USEC", watchdog_us, 1);
        return {};
    }

    std::string folder;
};

} // namespace

TEST_F(ToldManager, HearsWhenAProgramIsReadyAndWhenItStops)
{
    for (const std::string& place : {path(), "@hapnet-test-" + std::to_string(getpid())}) {
        const Manager manager{place};
        const ServiceManager program = told(place);
        EXPECT_EQ(manager.heard(), "");
        program.tell_ready();
        EXPECT_EQ(manager.heard(), "READY=1");
        program.tell_stopping();
        EXPECT_EQ(manager.heard(), "STOPPING=1");
        EXPECT_EQ(manager.heard(), "");
    }
}

TEST_F(ToldManager, GetsSignsOfLifeTwiceAsOftenAsItAsksFor)
{
    const Manager manager{path()};
    ServiceManager program = told(path(), "10000000");
    EXPECT_TRUE(base::is_due(program.next_deadline(), start));
    program.tell_alive(start);
    EXPECT_EQ(manager.heard(), "WATCHDOG=1");
    EXPECT_EQ(program.next_deadline(), start + 5s);
    program.tell_alive(start + 5s - 1ns);
    EXPECT_EQ(manager.heard(), "");
    program.tell_alive(start + 5s);
    EXPECT_EQ(manager.heard(), "WATCHDOG=1");
    EXPECT_EQ(program.next_deadline(), start + 10s);
}

TEST_F(ToldManager, GetsNoSignsOfLifeThatItDoesNotAskFor)
{
    const Manager manager{path()};
    for (const char* microseconds :
         {static_cast<const char*>(nullptr), "0", "-1", "soon", "99999999999999999999"}) {
        ServiceManager program = told(path(), microseconds);
        EXPECT_EQ(program.next_deadline(), std::nullopt);
        program.tell_alive(start);
    }
    setenv("WATCHDOG_PID", "1", 1); // concerns another process
    ServiceManager program = told(path(), "10000000");
    EXPECT_EQ(program.next_deadline(), std::nullopt);
    program.tell_alive(start);
    EXPECT_EQ(manager.heard(), "");

    setenv("WATCHDOG_PID", std::to_string(getpid()).c_str(), 1);
    EXPECT_NE(told(path(), "10000000").next_deadline(), std::nullopt);
}

TEST_F(ToldManager, IsNotForProgramsThatThisOneStarts)
{
    const Manager manager{path()};
    setenv("WATCHDOG_PID", std::to_string(getpid()).c_str(), 1);
    const ServiceManager program = told(path(), "10000000");
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"})
        EXPECT_EQ(std::getenv(name), nullptr) << name;
    program.tell_ready();
    EXPECT_EQ(manager.heard(), "READY=1");
}

TEST_F(ToldManager, IsNeverWaitedFor)
{
    const Manager manager{path()};
    const ServiceManager program = told(path());
    for (int i = 0; i < 5000; ++i) program.tell_ready(); // more than its queue takes
    EXPECT_EQ(manager.heard(), "READY=1");
}

TEST_F(ToldManager, MayBeMissing)
{
    ServiceManager program = told(path(), "10000000"); // no listener
    program.tell_ready();
    program.tell_alive(start);
    program.tell_stopping();
    EXPECT_EQ(program.next_deadline(), start + 5s);
    for (const std::string& place : {std::string{}, std::string{"@"}, std::string{"vsock:2:1"},
                                     path() + std::string(200, 'x')}) {
        const ServiceManager alone = told(place, "10000000");
        alone.tell_ready();
        EXPECT_EQ(alone.next_deadline(), std::nullopt) << place;
    }
}

} // namespace hapnet::net
