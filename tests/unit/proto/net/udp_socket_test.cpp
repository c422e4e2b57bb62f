// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/clock.hpp"
#include "proto/net/udp_socket.hpp"
#include "tests/support/ipv6.hpp"
#include "tests/unit/proto/net/datagrams.hpp"

#include <gtest/gtest.h>
#include <system_error>
#include <utility>
#include <vector>

namespace hapnet::net {
namespace {

using namespace std::chrono_literals;

/// The largest error of a stamp within one test: CLOCK_REALTIME is slewed against CLOCK_MONOTONIC
/// by at most 500 ppm, and the two are read one after the other.
constexpr auto stamp_tolerance = 1ms;

/// Waits until the kernel stamps what arrives at `b`. It begins a moment after the first socket of
/// the machine asks for it; until then a stamp is the time of receiving.
void wait_for_stamps(UdpSocket& a, UdpSocket& b)
{
    constexpr int tries_max = 100;
    for (int i = 0; i < tries_max; ++i) {
        ASSERT_EQ(a.send(b.local(), datagram(96, 1)), SendOutcome::sent);
        wait_readable(std::array{a.descriptor()}, monotonic_now() + 2 * stamp_tolerance);
        const auto asked = monotonic_now();
        const auto arrived = receive(b, 1);
        ASSERT_EQ(arrived.size(), 1U);
        if (arrived.front().at < asked - stamp_tolerance) return;
    }
    FAIL() << "the kernel stamps no arrival";
}

class UdpSocketOn : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override
    {
        if (GetParam()[0] == '[' && !test::has_ipv6()) GTEST_SKIP() << "no IPv6 here";
    }
};

TEST_P(UdpSocketOn, CarriesDatagramsWholeInOrderAndWithTheirSender)
{
    UdpSocket a{endpoint(GetParam())};
    UdpSocket b{endpoint(GetParam())};
    EXPECT_NE(a.local().port(), 0);
    const std::vector<std::size_t> sizes{0, 1, 160, 1472, 9000, 60000};
    for (const std::size_t size : sizes) {
        ASSERT_EQ(a.send(b.local(), datagram(size, static_cast<int>(size % 251))),
                  SendOutcome::sent);
    }
    const auto arrived = receive(b, sizes.size());
    ASSERT_EQ(arrived.size(), sizes.size());
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        EXPECT_EQ(arrived[i].bytes, datagram(sizes[i], static_cast<int>(sizes[i] % 251)));
        EXPECT_EQ(arrived[i].from, a.local());
    }
}

TEST_P(UdpSocketOn, StampsArrivalsBetweenSendingAndReceivingAndInOrder)
{
    UdpSocket a{endpoint(GetParam())};
    UdpSocket b{endpoint(GetParam())};
    wait_for_stamps(a, b);
    const auto before = monotonic_now();
    constexpr std::size_t count = 100; // more than one batch
    for (std::size_t i = 0; i < count; ++i) {
        ASSERT_EQ(a.send(b.local(), datagram(96, 1)), SendOutcome::sent);
    }
    const auto arrived = receive(b, count);
    const auto after = monotonic_now();
    ASSERT_EQ(arrived.size(), count);
    EXPECT_GE(arrived.front().at, before - stamp_tolerance);
    EXPECT_LE(arrived.back().at, after + stamp_tolerance);
    for (std::size_t i = 1; i < count; ++i) {
        EXPECT_GE(arrived[i].at, arrived[i - 1].at - stamp_tolerance);
    }
}

INSTANTIATE_TEST_SUITE_P(Loopback, UdpSocketOn, testing::Values("127.0.0.1:0", "[::1]:0"),
                         [](const auto& family) {
                             return std::string{family.param[0] == '[' ? "IPv6" : "IPv4"};
                         });

TEST(UdpSocket, ReceivesNothingWithoutWaitingWhenNothingHasCome)
{
    UdpSocket socket{endpoint("127.0.0.1:0")};
    EXPECT_TRUE(socket.receive().empty());
}

TEST(UdpSocket, HandsOverAtMostOneBatchAtATime)
{
    UdpSocket a{endpoint("127.0.0.1:0")};
    UdpSocket b{endpoint("127.0.0.1:0")};
    for (std::size_t i = 0; i < UdpSocket::batch_max + 1; ++i) {
        ASSERT_EQ(a.send(b.local(), datagram(1, static_cast<int>(i))), SendOutcome::sent);
    }
    EXPECT_EQ(b.receive().size(), UdpSocket::batch_max); // loopback delivers within the send
    const auto last = b.receive();
    ASSERT_EQ(last.size(), 1U);
    EXPECT_EQ(last.front().bytes.front(), std::byte{UdpSocket::batch_max});
}

TEST(UdpSocket, APortInUseIsNamed)
{
    const UdpSocket first{endpoint("127.0.0.1:0")};
    try {
        const UdpSocket second{first.local()};
        FAIL() << "bound twice";
    } catch (const std::system_error& error) {
        EXPECT_EQ(error.code(), std::errc::address_in_use);
        EXPECT_NE(std::string{error.what()}.find(first.local().to_text()), std::string::npos);
    }
}

TEST(UdpSocket, AnAddressThatIsNotOursCannotBeBound)
{
    EXPECT_THROW(UdpSocket{endpoint("192.0.2.1:0")}, std::system_error); // RFC 5737: nobody's
}

TEST(UdpSocket, ADatagramThatIsTooBigIsToldAndNotCut)
{
    UdpSocket a{endpoint("127.0.0.1:0")};
    EXPECT_EQ(a.send(a.local(), datagram(65508, 1)), SendOutcome::too_big);
    EXPECT_EQ(a.send(a.local(), datagram(65507, 1)), SendOutcome::sent);
    EXPECT_EQ(receive(a, 1).front().bytes.size(), 65507U);
}

TEST(UdpSocket, GoesOnReceivingAfterSendingToNobody)
{
    UdpSocket a{endpoint("127.0.0.1:0")};
    UdpSocket b{endpoint("127.0.0.1:0")};
    const auto nobody = UdpSocket{endpoint("127.0.0.1:0")}.local(); // closed again
    std::ignore = a.send(nobody, datagram(1, 1));
    std::ignore = a.send(nobody, datagram(1, 1));
    ASSERT_EQ(b.send(a.local(), datagram(1, 2)), SendOutcome::sent);
    EXPECT_EQ(receive(a, 1).size(), 1U);
}

TEST(UdpSocket, MayMoveAndKeepsItsPort)
{
    UdpSocket first{endpoint("127.0.0.1:0")};
    const auto address = first.local();
    UdpSocket second{std::move(first)};
    EXPECT_EQ(second.local(), address);
    ASSERT_EQ(second.send(address, datagram(1, 1)), SendOutcome::sent);
    EXPECT_EQ(receive(second, 1).size(), 1U);
}

TEST(UdpSocket, CountsWhatTheKernelHadToDrop)
{
    UdpSocket a{endpoint("127.0.0.1:0")};
    UdpSocket b{endpoint("127.0.0.1:0")};
    const auto big = datagram(60000, 1);
    std::uint64_t sent = 0;
    for (int i = 0; i < 400; ++i) { // 24 MB: more than the receive buffer may be
        sent += a.send(b.local(), big) == SendOutcome::sent ? 1U : 0U;
    }
    std::uint64_t received = 0;
    for (auto batch = b.receive(); !batch.empty(); batch = b.receive()) received += batch.size();
    // The kernel reports the count with the next datagram that fits.
    ASSERT_EQ(a.send(b.local(), datagram(1, 1)), SendOutcome::sent);
    ASSERT_EQ(receive(b, 1).size(), 1U);
    EXPECT_GT(b.overflowed(), 0U);
    EXPECT_EQ(b.overflowed() + received, sent);
}

} // namespace
} // namespace hapnet::net
