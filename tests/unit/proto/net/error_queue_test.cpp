// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/error_queue.hpp"

#include "proto/net/clock.hpp"
#include "proto/net/udp_socket.hpp"
#include "tests/support/ipv6.hpp"
#include "tests/unit/proto/net/datagrams.hpp"

#include <gtest/gtest.h>
#include <optional>
#include <span>
#include <vector>

namespace hapnet::net {
namespace {

using namespace std::chrono_literals;

class ErrorQueueOn : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override
    {
        if (GetParam()[0] == '[' && !test::has_ipv6()) GTEST_SKIP() << "no IPv6 here";
    }

    /// An address without a listener.
    [[nodiscard]] static Endpoint silent_place() { return UdpSocket{endpoint(GetParam())}.local(); }

    /// Takes waiting errors for a while.
    static void look(UdpSocket& socket)
    {
        const auto end = monotonic_now() + 100ms;
        while (monotonic_now() < end) {
            EXPECT_TRUE(socket.receive().empty());
            sleep_until(monotonic_now() + 1ms);
        }
    }
};

TEST_P(ErrorQueueOn, CountsEachAnswerOnceAndFailsNoOtherDatagram)
{
    UdpSocket somebody{endpoint(GetParam())};
    UdpSocket socket{endpoint(GetParam()), Load::bulk};
    const auto nobody = silent_place();
    constexpr std::uint64_t rounds = 10;
    for (std::uint64_t i = 0; i < rounds; ++i) {
        EXPECT_EQ(socket.send(nobody, datagram(10, 1)), SendOutcome::sent);
        EXPECT_EQ(socket.send(somebody.local(), datagram(10, 2)), SendOutcome::sent);
    }
    look(socket);
    EXPECT_EQ(socket.unreachable(), rounds);
    EXPECT_EQ(receive(somebody, rounds).size(), rounds);
}

TEST_P(ErrorQueueOn, CountsAnswersToBatchesOfUnequalSizes)
{
    UdpSocket socket{endpoint(GetParam()), Load::bulk};
    const auto nobody = silent_place();
    std::vector<std::vector<std::byte>> datagrams;
    for (std::size_t size = 1; size <= 12; ++size) datagrams.push_back(datagram(size, 1));
    const std::vector<std::span<const std::byte>> batch{datagrams.begin(), datagrams.end()};
    // Larger datagrams follow smaller ones, so that the kernel merges none.
    for (const SendOutcome outcome : socket.send_batch(nobody, batch)) {
        EXPECT_EQ(outcome, SendOutcome::sent);
    }
    look(socket);
    EXPECT_EQ(socket.unreachable(), batch.size());
}

INSTANTIATE_TEST_SUITE_P(Both, ErrorQueueOn, testing::Values("127.0.0.1:0", "[::1]:0"));

} // namespace
} // namespace hapnet::net
