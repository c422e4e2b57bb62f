// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/control/server.hpp"

#include <array>
#include <chrono>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <unistd.h>
#include <vector>

namespace hapnet::control {
namespace {

using namespace std::chrono_literals;

/// A program that answers every line with a long one.
struct Talker {
    int asked = 0;
    Subject subject{.answer = [this](std::string_view, base::TimePoint) -> Answer {
                        ++asked;
                        return std::string(5000, 'x');
                    },
                    .statistics = [] { return nlohmann::ordered_json::object(); }};
};

class ControlServer : public testing::Test {
protected:
    ~ControlServer() override { std::filesystem::remove(path); }

    void serve(int times)
    {
        for (int i = 0; i < times; ++i) server.serve(talker.subject, now += 1ms);
    }

    std::string path = (std::filesystem::temp_directory_path() /
                        ("hapnet-server-test-" + std::to_string(getpid())))
                           .string();
    Server server{path};
    Talker talker;
    base::TimePoint now{1h};
};

std::string all_of(net::UnixStream& stream)
{
    std::string text;
    std::array<char, 4096> buffer{};
    for (;;) {
        const auto taken = stream.read(buffer);
        if (taken.state != net::Transfer::State::moved) return text;
        text.append(buffer.data(), taken.bytes);
    }
}

TEST_F(ControlServer, GivesThePlaceOfAClientThatHasHungUpToTheNextOneAtOnce)
{
    std::vector<net::UnixStream> clients;
    std::string many;
    for (int i = 0; i < 2000; ++i) many += "stats\n";
    for (std::size_t i = 0; i < Server::clients_max; ++i) {
        clients.push_back(net::UnixStream::connect(path));
        EXPECT_EQ(clients.back().write(many).bytes, many.size());
        serve(20);
    }
    auto refused = net::UnixStream::connect(path);
    serve(20);
    EXPECT_NE(all_of(refused).find("too many clients"), std::string::npos);
    clients.clear(); // with replies unread and requests unanswered
    serve(20);
    auto next = net::UnixStream::connect(path);
    EXPECT_EQ(next.write("stats\n").bytes, 6U);
    serve(20);
    EXPECT_EQ(all_of(next), std::string(5000, 'x') + "\n");
}

TEST_F(ControlServer, FreesThePlacesOfThoseWhoHaveHungUpBeforeItAdmitsAnyone)
{
    std::vector<net::UnixStream> clients;
    for (std::size_t i = 0; i < Server::clients_max; ++i) {
        clients.push_back(net::UnixStream::connect(path));
        serve(1);
    }
    clients.clear();
    auto next = net::UnixStream::connect(path);
    EXPECT_EQ(next.write("stats\n").bytes, 6U);
    serve(2); // one to admit it, one to answer it
    EXPECT_EQ(all_of(next), std::string(5000, 'x') + "\n");
}

TEST_F(ControlServer, FreesThePlaceOfAClientThatHangsUpWhileItWaits)
{
    talker.subject.answer = [](std::string_view, base::TimePoint) -> Answer {
        return WatchRequest{.every = 1h};
    };
    std::vector<net::UnixStream> clients;
    for (std::size_t i = 0; i < Server::clients_max; ++i) {
        clients.push_back(net::UnixStream::connect(path));
        EXPECT_EQ(clients.back().write("watch\n").bytes, 6U);
        serve(3);
    }
    clients.clear();
    auto next = net::UnixStream::connect(path);
    serve(1);
    EXPECT_EQ(all_of(next), "");
}

TEST_F(ControlServer, DoesWhatAClientAskedBeforeItHungUp)
{
    {
        auto client = net::UnixStream::connect(path);
        EXPECT_EQ(client.write("set\nset\nset\n").bytes, 12U);
    }
    serve(20);
    EXPECT_EQ(talker.asked, 3);
}

} // namespace
} // namespace hapnet::control
