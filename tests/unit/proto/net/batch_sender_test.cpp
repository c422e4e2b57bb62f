// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/ipv6.hpp"
#include "tests/unit/proto/net/datagrams.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>
#include <sys/socket.h>
#include <tuple>

namespace hapnet::net {
namespace {

using Datagrams = std::vector<std::vector<std::byte>>;

/// One datagram of each size, each filled with its place in the list.
Datagrams of_sizes(const std::vector<std::size_t>& sizes)
{
    Datagrams all;
    for (const std::size_t size : sizes)
        all.push_back(datagram(size, static_cast<int>(all.size())));
    return all;
}

std::vector<SendOutcome> send_batch(UdpSocket& from, const Endpoint& to, const Datagrams& datagrams,
                                    const std::vector<base::IpMarks>& marks = {})
{
    const std::vector<std::span<const std::byte>> views(datagrams.begin(), datagrams.end());
    const auto outcomes = from.send_batch(to, views, marks);
    return {outcomes.begin(), outcomes.end()};
}

Datagrams bytes_of(const std::vector<Arrived>& arrived)
{
    Datagrams all;
    for (const Arrived& one : arrived) all.push_back(one.bytes);
    return all;
}

std::vector<SendOutcome> all_sent(std::size_t count) { return {count, SendOutcome::sent}; }

/// Both kinds of socket: the kernel gives merged datagrams to only one of them.
class SendBatch : public testing::TestWithParam<std::tuple<const char*, Load>> {
protected:
    void SetUp() override
    {
        if (here().family() == AF_INET6 && !test::has_ipv6()) GTEST_SKIP() << "no IPv6 here";
    }

    static Endpoint here() { return endpoint(std::get<0>(GetParam())); }
    static Load load() { return std::get<1>(GetParam()); }

    static void expect_whole(const std::vector<std::size_t>& sizes)
    {
        UdpSocket from{here()};
        UdpSocket to{here(), load()};
        const auto datagrams = of_sizes(sizes);
        EXPECT_EQ(send_batch(from, to.local(), datagrams), all_sent(sizes.size()));
        const auto arrived = receive(to, sizes.size());
        EXPECT_EQ(bytes_of(arrived), datagrams);
        for (const Arrived& one : arrived) EXPECT_EQ(one.from, from.local());
    }
};

TEST_P(SendBatch, OfEqualSizesArrivesWholeAndInOrder)
{
    expect_whole(std::vector<std::size_t>(BatchSender::batch_max, 96));
}

TEST_P(SendBatch, OfMixedSizesArrivesWholeAndInOrder)
{
    expect_whole({96, 96, 96, 40, 96, 96, 97, 96, 0, 0, 1, 1, 1472, 1472, 1471, 1472, 9000, 60});
}

TEST_P(SendBatch, OfTheLargestDatagramsArrivesWholeAndInOrder)
{
    expect_whole({65507, 65507, 40000, 40000, 32753, 32753, 32754, 32754});
}

TEST_P(SendBatch, OfOneAndOfNone)
{
    expect_whole({160});
    expect_whole({});
}

TEST_P(SendBatch, ArrivesAlsoWhenTheKernelRefusesToCut)
{
    UdpSocket from{here()};
    UdpSocket to{here(), load()};
    const int without_checksum = 1; // then Linux refuses UDP_SEGMENT
    ASSERT_EQ(setsockopt(from.descriptor(), SOL_SOCKET, SO_NO_CHECK, &without_checksum,
                         sizeof without_checksum),
              0);
    for (int round = 0; round < 2; ++round) {
        const auto datagrams = of_sizes({96, 96, 96, 40, 200, 200});
        EXPECT_EQ(send_batch(from, to.local(), datagrams), all_sent(6));
        EXPECT_EQ(bytes_of(receive(to, 6)), datagrams);
    }
}

TEST_P(SendBatch, TellsTheOutcomeOfEachDatagram)
{
    UdpSocket from{here()};
    UdpSocket to{here(), load()};
    const auto datagrams = of_sizes({96, 96, 70000, 70000, 96, 96});
    auto expected = all_sent(6);
    expected[2] = expected[3] = SendOutcome::too_big;
    EXPECT_EQ(send_batch(from, to.local(), datagrams), expected);
    EXPECT_EQ(receive(to, 4).size(), 4U);
}

/// Runs of equal marks of several lengths: the usual ones, others, and a class alone.
std::vector<base::IpMarks> mixed_marks(std::size_t count)
{
    std::vector<base::IpMarks> marks;
    for (std::size_t i = 0; i < count; ++i) {
        const auto kind = i % 7;
        marks.push_back(kind < 3   ? base::IpMarks{0, 64}
                        : kind < 5 ? base::IpMarks{static_cast<std::uint8_t>(0xb8 | i % 4), 64}
                                   : base::IpMarks{1, static_cast<std::uint8_t>(10 + i)});
    }
    return marks;
}

std::vector<base::IpMarks> marks_of(const std::vector<Arrived>& arrived)
{
    std::vector<base::IpMarks> all;
    for (const Arrived& one : arrived) all.push_back(one.marks);
    return all;
}

TEST_P(SendBatch, GivesEachDatagramItsMarksAlsoWhereTheKernelRefusesToCut)
{
    for (const int without_checksum : {0, 1}) { // with it Linux refuses UDP_SEGMENT
        UdpSocket from{here(), load()};
        UdpSocket to{here(), Load::bulk};
        ASSERT_EQ(setsockopt(from.descriptor(), SOL_SOCKET, SO_NO_CHECK, &without_checksum,
                             sizeof without_checksum),
                  0);
        const auto datagrams = of_sizes(std::vector<std::size_t>(BatchSender::batch_max, 96));
        const auto marks = mixed_marks(datagrams.size());
        EXPECT_EQ(send_batch(from, to.local(), datagrams, marks), all_sent(datagrams.size()));
        const auto arrived = receive(to, datagrams.size());
        EXPECT_EQ(bytes_of(arrived), datagrams);
        EXPECT_EQ(marks_of(arrived), marks);
        // A single datagram, and one with unknown hop limit, which leaves with the system's.
        EXPECT_EQ(send_batch(from, to.local(), of_sizes({10}), {{0x2e, 3}}), all_sent(1));
        EXPECT_EQ(send_batch(from, to.local(), of_sizes({10}), {{0x2e, 0}}), all_sent(1));
        EXPECT_EQ(marks_of(receive(to, 2)), (std::vector<base::IpMarks>{{0x2e, 3}, {0x2e, 64}}));
    }
}

TEST(SendBatchToBothFamilies, GivesMarksToAnIpv4AddressInAnIpv6One)
{
    if (!test::has_ipv6()) GTEST_SKIP() << "no IPv6 here";
    UdpSocket from{endpoint("[::ffff:127.0.0.1]:0"), Load::bulk};
    UdpSocket to{endpoint("[::ffff:127.0.0.1]:0"), Load::bulk};
    const auto datagrams = of_sizes(std::vector<std::size_t>(20, 96));
    const auto marks = mixed_marks(datagrams.size());
    EXPECT_EQ(send_batch(from, to.local(), datagrams, marks), all_sent(datagrams.size()));
    const auto arrived = receive(to, datagrams.size());
    EXPECT_EQ(bytes_of(arrived), datagrams);
    EXPECT_EQ(marks_of(arrived), marks);
}

INSTANTIATE_TEST_SUITE_P(Loopback, SendBatch,
                         testing::Combine(testing::Values("127.0.0.1:0", "[::1]:0"),
                                          testing::Values(Load::stream, Load::bulk)),
                         [](const auto& given) {
                             return std::string{std::get<0>(given.param)[0] == '[' ? "IPv6"
                                                                                   : "IPv4"} +
                                    (std::get<1>(given.param) == Load::bulk ? "Bulk" : "Stream");
                         });

TEST(UdpSocketForBulk, TakesMergedDatagramsOfManySendersApart)
{
    UdpSocket a{endpoint("127.0.0.1:0")};
    UdpSocket b{endpoint("127.0.0.1:0")};
    UdpSocket to{endpoint("127.0.0.1:0"), Load::bulk};
    const auto from_a = of_sizes(std::vector<std::size_t>(BatchSender::batch_max, 100));
    const auto from_b = of_sizes({9, 9, 9, 1});
    ASSERT_EQ(send_batch(a, to.local(), from_a), all_sent(from_a.size()));
    ASSERT_EQ(send_batch(b, to.local(), from_b), all_sent(from_b.size()));
    const auto arrived = receive(to, from_a.size() + from_b.size());
    ASSERT_EQ(arrived.size(), from_a.size() + from_b.size());
    for (std::size_t i = 0; i < arrived.size(); ++i) {
        const bool is_of_a = i < from_a.size();
        EXPECT_EQ(arrived[i].bytes, is_of_a ? from_a[i] : from_b[i - from_a.size()]);
        EXPECT_EQ(arrived[i].from, is_of_a ? a.local() : b.local());
    }
}

TEST(UdpSocketForBulk, TakesFewerMessagesAtATimeOnceTheyHoldMany)
{
    UdpSocket from{endpoint("127.0.0.1:0")};
    UdpSocket to{endpoint("127.0.0.1:0"), Load::bulk};
    const auto datagrams = of_sizes(std::vector<std::size_t>(BatchSender::batch_max, 50));
    constexpr std::size_t messages = 100; // more than one batch of them
    for (std::size_t i = 0; i < messages; ++i) {
        ASSERT_EQ(send_batch(from, to.local(), datagrams), all_sent(datagrams.size()));
    }
    std::vector<std::size_t> batches;
    for (auto batch = to.receive(); !batch.empty(); batch = to.receive()) {
        batches.push_back(batch.size());
    }
    EXPECT_EQ(std::accumulate(batches.begin(), batches.end(), std::size_t{0}),
              messages * datagrams.size());
    ASSERT_GE(batches.size(), 2U);
    EXPECT_LE(*std::max_element(batches.begin() + 1, batches.end()), 512U);
}

TEST(UdpSocketForBulk, StillTakesOrdinaryDatagramsAWholeBatchAtATime)
{
    UdpSocket from{endpoint("127.0.0.1:0")};
    UdpSocket to{endpoint("127.0.0.1:0"), Load::bulk};
    for (std::size_t i = 0; i < UdpSocket::batch_max; ++i) {
        ASSERT_EQ(from.send(to.local(), datagram(96, 1)), SendOutcome::sent);
    }
    EXPECT_EQ(to.receive().size(), UdpSocket::batch_max);
}

} // namespace
} // namespace hapnet::net
