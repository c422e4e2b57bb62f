// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/monitor/plot_stream.hpp"

#include "proto/net/clock.hpp"
#include "proto/net/wait.hpp"

#include <array>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hapnet::peer::monitor {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{81'230s};

/// A listener, and the datagrams of a stream to it.
class PlotStreamTest : public ::testing::Test {
protected:
    [[nodiscard]] std::vector<nlohmann::json> received()
    {
        const std::array descriptors{socket_.descriptor()};
        net::wait_readable(descriptors, net::monotonic_now() + 1s);
        std::vector<nlohmann::json> all;
        for (const net::Received& one : socket_.receive()) {
            all.push_back(nlohmann::json::parse(
                std::string{reinterpret_cast<const char*>(one.bytes.data()), one.bytes.size()}));
        }
        return all;
    }

    net::UdpSocket socket_{net::resolve({"127.0.0.1", 0})};
    std::string frame_ = R"({"ok":true,"frame":7,"cube":[0.02,0,0]})";
    PlotStream stream_{socket_.local(), 2,
                       [this](std::string& text, std::uint64_t /*left_out*/) { text += frame_; }};
};

TEST_F(PlotStreamTest, SendsOneObjectWithATimeAndTheFrameOfThePeer)
{
    stream_.serve(start + 250ms);
    const auto all = received();
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].at("timestamp"), 81'230.25);
    EXPECT_EQ(all[0].at("peer_2"), nlohmann::json::parse(frame_));
    EXPECT_EQ(all[0].size(), 2U);
}

TEST_F(PlotStreamTest, SendsNoMoreThanFiftyASecond)
{
    for (int i = 0; i < 100; ++i) stream_.serve(start + i * 1ms);
    EXPECT_EQ(received().size(), 5U);
}

TEST_F(PlotStreamTest, SendsNothingWhereThereIsNoFrame)
{
    frame_.clear();
    stream_.serve(start);
    frame_ = "{}\n";
    stream_.serve(start + PlotStream::every);
    const auto all = received();
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].at("peer_2"), nlohmann::json::object());
}

} // namespace
} // namespace hapnet::peer::monitor
