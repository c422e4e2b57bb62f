// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The fields of IP headers pass the emulator unchanged: TOS or traffic class, and TTL or hop limit.
#include "proto/net/clock.hpp"
#include "proto/net/udp_socket.hpp"
#include "proto/net/wait.hpp"
#include "tests/e2e/emulator.hpp"
#include "tests/e2e/udp.hpp"
#include "tests/support/ipv6.hpp"

#include <array>
#include <chrono>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <optional>
#include <string>
#include <sys/socket.h>
#include <vector>

namespace hapnet::e2e {

namespace {

using namespace std::chrono_literals;
using base::IpMarks;

/// A program that sets the marks of its datagrams by socket options, as any program would.
class MarkingHost {
public:
    explicit MarkingHost(const std::string& local) : socket_{endpoint_of(local), net::Load::bulk} {}

    [[nodiscard]] std::string address() const { return socket_.local().to_text(); }

    void send(const net::Endpoint& to, IpMarks marks)
    {
        const bool is_v4 = to.family() == AF_INET;
        set(is_v4 ? IPPROTO_IP : IPPROTO_IPV6, is_v4 ? IP_TOS : IPV6_TCLASS, marks.traffic_class);
        set(is_v4 ? IPPROTO_IP : IPPROTO_IPV6, is_v4 ? IP_TTL : IPV6_UNICAST_HOPS, marks.hop_limit);
        EXPECT_EQ(socket_.send(to, std::array<std::byte, 100>{}), net::SendOutcome::sent);
    }

    /// Returns the marks of the next `count` datagrams, and the sender of the last.
    std::vector<IpMarks> receive(std::size_t count)
    {
        std::vector<IpMarks> marks;
        const auto end = net::monotonic_now() + 10s;
        while (marks.size() < count && net::monotonic_now() < end) {
            net::wait_readable(std::array{socket_.descriptor()}, end);
            for (const net::Received& one : socket_.receive()) {
                marks.push_back(one.marks);
                last_from = one.from;
            }
        }
        return marks;
    }

    std::optional<net::Endpoint> last_from;

private:
    void set(int level, int name, int value) const
    {
        EXPECT_EQ(setsockopt(socket_.descriptor(), level, name, &value, sizeof value), 0);
    }

    net::UdpSocket socket_;
};

/// Every ECN codepoint, some classes, and hop limits that are not the system's own.
std::vector<IpMarks> many_marks()
{
    std::vector<IpMarks> all;
    for (int i = 0; i < 40; ++i) {
        const auto ecn = static_cast<unsigned>(i) % 4;
        const unsigned dscp = i < 20 ? 46 : 0; // EF, and best effort
        all.push_back({static_cast<std::uint8_t>(dscp << 2U | ecn),
                       static_cast<std::uint8_t>(i % 8 < 4 ? 64 : 30 + i)});
    }
    return all;
}

std::uint64_t congested(const std::vector<IpMarks>& marks)
{
    std::uint64_t count = 0;
    for (const IpMarks& one : marks) count += one.is_congested() ? 1U : 0U;
    return count;
}

class EmulatorOn : public testing::TestWithParam<std::string> {
protected:
    void SetUp() override
    {
        if (GetParam().starts_with('[') && !test::has_ipv6()) GTEST_SKIP() << "no IPv6 here";
    }
};

TEST_P(EmulatorOn, PassesTheMarksOfEachDatagramWithAndWithoutDelay)
{
    for (const std::string delay : {"0", "20ms"}) {
        MarkingHost a{GetParam()};
        MarkingHost b{GetParam()};
        Emulator emulator{{"--delay", delay, "--a", a.address(), "--b", b.address()}, GetParam()};
        const auto marks = many_marks();
        for (const IpMarks& one : marks) a.send(emulator.a(), one);
        EXPECT_EQ(b.receive(marks.size()), marks) << delay;
        b.send(emulator.b(), {0xb9, 17});
        EXPECT_EQ(a.receive(1), (std::vector<IpMarks>{{0xb9, 17}}));
        const auto statistics = emulator.stop();
        EXPECT_EQ(statistics["up"]["ce_in"], congested(marks));
        EXPECT_EQ(statistics["up"]["ce_out"], congested(marks));
        EXPECT_EQ(statistics["down"]["ce_in"], 0);
    }
}

TEST_P(EmulatorOn, GivesTheCopyOfADatagramItsMarks)
{
    MarkingHost a{GetParam()};
    MarkingHost b{GetParam()};
    Emulator emulator{{"--duplicate", "100%", "--a", a.address(), "--b", b.address()}, GetParam()};
    a.send(emulator.a(), {0x03, 12});
    EXPECT_EQ(b.receive(2), (std::vector<IpMarks>{{0x03, 12}, {0x03, 12}}));
    const auto statistics = emulator.stop();
    EXPECT_EQ(statistics["up"]["ce_in"], 1);
    EXPECT_EQ(statistics["up"]["ce_out"], 2);
}

INSTANTIATE_TEST_SUITE_P(Loopback, EmulatorOn, testing::Values("127.0.0.1:0", "[::1]:0"),
                         [](const auto& given) {
                             return std::string{given.param.front() == '[' ? "IPv6" : "IPv4"};
                         });

} // namespace

TEST(Upstream, PassesMarksBothWays)
{
    MarkingHost client{"127.0.0.1:0"};
    MarkingHost server{"127.0.0.1:0"};
    Process emulator{"hapnet-emulator",
                     {"--listen", "127.0.0.1:0", "--upstream", server.address(), "--delay", "5ms"}};
    const auto ready = emulator.wait_for_out("ready ", 10s);
    ASSERT_TRUE(ready) << emulator.err();
    const auto marks = many_marks();
    for (const IpMarks& one : marks) client.send(endpoint_in(*ready, "listen"), one);
    EXPECT_EQ(server.receive(marks.size()), marks);
    ASSERT_TRUE(server.last_from);
    server.send(*server.last_from, {0x2b, 99});
    EXPECT_EQ(client.receive(1), (std::vector<IpMarks>{{0x2b, 99}}));
}

} // namespace hapnet::e2e
