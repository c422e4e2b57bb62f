// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/error_queue.hpp"

#include <array>
#include <cstddef>
#include <cstring>
#include <ctime>
#include <linux/errqueue.h>
#include <netinet/in.h>
#include <optional>
#include <sys/socket.h>

namespace hapnet::net {

namespace {

struct alignas(cmsghdr) Control {
    std::array<std::byte, 512> bytes{};
};

/// Returns the next answer or error report; nullopt if there is none.
std::optional<sock_extended_err> next_report(int descriptor)
{
    Control control;
    msghdr header{};
    header.msg_control = control.bytes.data();
    header.msg_controllen = control.bytes.size();
    if (recvmsg(descriptor, &header, MSG_ERRQUEUE | MSG_DONTWAIT) < 0) return std::nullopt;
    sock_extended_err report{};
    for (cmsghdr* one = CMSG_FIRSTHDR(&header); one != nullptr; one = CMSG_NXTHDR(&header, one)) {
        const bool is_report = (one->cmsg_level == IPPROTO_IP && one->cmsg_type == IP_RECVERR) ||
                               (one->cmsg_level == IPPROTO_IPV6 && one->cmsg_type == IPV6_RECVERR);
        if (is_report) std::memcpy(&report, CMSG_DATA(one), sizeof report);
    }
    return report;
}

bool is_port_unreachable(const sock_extended_err& report)
{
    // The type and code for an unreachable port: RFC 792 for IPv4, RFC 4443 for IPv6.
    const bool is_v4 =
        report.ee_origin == SO_EE_ORIGIN_ICMP && report.ee_type == 3 && report.ee_code == 3;
    const bool is_v6 =
        report.ee_origin == SO_EE_ORIGIN_ICMP6 && report.ee_type == 1 && report.ee_code == 4;
    return is_v4 || is_v6;
}

} // namespace

void ErrorQueue::ask_for(int descriptor, int family)
{
    const int yes = 1;
    setsockopt(descriptor, IPPROTO_IP, IP_RECVERR, &yes, sizeof yes);
    if (family == AF_INET6) setsockopt(descriptor, IPPROTO_IPV6, IPV6_RECVERR, &yes, sizeof yes);
}

bool ErrorQueue::drain(int descriptor)
{
    constexpr int most = 256;
    bool has_found = false;
    is_suspected_ = false;
    for (int i = 0; i < most; ++i) {
        const auto report = next_report(descriptor);
        if (!report) return has_found;
        const bool is_answer =
            report->ee_origin == SO_EE_ORIGIN_ICMP || report->ee_origin == SO_EE_ORIGIN_ICMP6;
        has_found = has_found || is_answer;
        if (is_port_unreachable(*report)) ++unreachable_;
    }
    is_suspected_ = true; // there may be more answers
    return has_found;
}

} // namespace hapnet::net
