// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/udp_socket.hpp"

#include "proto/base/ensure.hpp"
#include "proto/net/clock.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <spdlog/fmt/fmt.h>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

namespace hapnet::net {

namespace {

base::Duration to_duration(const timespec& time)
{
    return std::chrono::seconds{time.tv_sec} + std::chrono::nanoseconds{time.tv_nsec};
}

/// CLOCK_MONOTONIC minus CLOCK_REALTIME. Being interrupted between the readings would shift the
/// stamps by as much, so the closest of a few readings counts; the first usually does.
base::Duration monotonic_minus_real()
{
    constexpr int readings_max = 4;
    constexpr base::Duration close_enough = std::chrono::microseconds{1};
    auto closest = base::Duration::max();
    base::Duration offset{};
    for (int i = 0; i < readings_max && closest > close_enough; ++i) {
        timespec real{};
        const auto before = monotonic_now().time_since_epoch();
        base::ensure(clock_gettime(CLOCK_REALTIME, &real) == 0);
        const auto took = monotonic_now().time_since_epoch() - before;
        if (took >= closest) continue;
        closest = took;
        offset = before + took / 2 - to_duration(real);
    }
    return offset;
}

void set_option(int descriptor, int name, int value)
{
    setsockopt(descriptor, SOL_SOCKET, name, &value, sizeof value);
}

} // namespace

struct UdpSocket::Buffers {
    static constexpr std::size_t control_bytes = 128;

    Buffers()
    {
        for (std::size_t i = 0; i < batch_max; ++i) {
            vectors[i] = {.iov_base = payload.data() + i * payload_bytes_max,
                          .iov_len = payload_bytes_max};
            received.push_back({{}, nowhere(), {}});
        }
    }

    static Endpoint nowhere()
    {
        sockaddr_storage none{};
        none.ss_family = AF_INET;
        return Endpoint{none, sizeof(sockaddr_storage)};
    }

    std::vector<std::byte> payload = std::vector<std::byte>(batch_max * payload_bytes_max);
    std::array<iovec, batch_max> vectors{};
    std::array<mmsghdr, batch_max> headers{};
    std::array<sockaddr_storage, batch_max> senders{};
    struct alignas(cmsghdr) Control {
        std::array<std::byte, control_bytes> bytes;
    };
    std::array<Control, batch_max> controls{};
    std::vector<Received> received;
    std::uint32_t overflowed_last = 0; // as the kernel says it: 32 bits, wrapping
    std::uint64_t overflowed = 0;
};

UdpSocket::UdpSocket(const Endpoint& local)
    : descriptor_{socket(local.family(), SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)},
      buffers_{std::make_unique<Buffers>()}
{
    if (descriptor_ < 0) throw std::system_error{errno, std::generic_category(), "socket"};
    set_option(descriptor_, SO_TIMESTAMPNS, 1);
    set_option(descriptor_, SO_RXQ_OVFL, 1);
    // About 4 MB where the system allows it: a second of a busy link while we are not running.
    set_option(descriptor_, SO_RCVBUF, 4 << 20);
    set_option(descriptor_, SO_SNDBUF, 4 << 20);
    if (bind(descriptor_, local.address(), local.length()) != 0) {
        const int error = errno;
        close(descriptor_);
        throw std::system_error{error, std::generic_category(),
                                fmt::format("cannot bind to {}", local.to_text())};
    }
}

UdpSocket::~UdpSocket()
{
    if (descriptor_ >= 0) close(descriptor_);
}

UdpSocket::UdpSocket(UdpSocket&& other) noexcept
    : descriptor_{std::exchange(other.descriptor_, -1)}, buffers_{std::move(other.buffers_)}
{}

std::span<const Received> UdpSocket::receive()
{
    Buffers& b = *buffers_;
    for (std::size_t i = 0; i < batch_max; ++i) {
        msghdr& header = b.headers[i].msg_hdr;
        header = {};
        header.msg_name = &b.senders[i];
        header.msg_namelen = sizeof(sockaddr_storage);
        header.msg_iov = &b.vectors[i];
        header.msg_iovlen = 1;
        header.msg_control = b.controls[i].bytes.data();
        header.msg_controllen = Buffers::control_bytes;
    }
    const int count = recvmmsg(descriptor_, b.headers.data(), batch_max, 0, nullptr);
    if (count <= 0) return {}; // nothing there, or an error report that is of no use to us
    const auto to_monotonic = monotonic_minus_real();
    const auto now = monotonic_now();
    const auto taken = static_cast<std::size_t>(count);
    for (std::size_t i = 0; i < taken; ++i) {
        msghdr& header = b.headers[i].msg_hdr;
        auto at = now;
        for (cmsghdr* c = CMSG_FIRSTHDR(&header); c != nullptr; c = CMSG_NXTHDR(&header, c)) {
            if (c->cmsg_level != SOL_SOCKET) continue;
            if (c->cmsg_type == SO_TIMESTAMPNS) {
                timespec stamp{};
                std::memcpy(&stamp, CMSG_DATA(c), sizeof stamp);
                at = std::min(now, base::TimePoint{to_duration(stamp) + to_monotonic});
            } else if (c->cmsg_type == SO_RXQ_OVFL) {
                std::uint32_t total = 0;
                std::memcpy(&total, CMSG_DATA(c), sizeof total);
                b.overflowed += static_cast<std::uint32_t>(total - b.overflowed_last);
                b.overflowed_last = total;
            }
        }
        b.received[i] = {{b.payload.data() + i * payload_bytes_max, b.headers[i].msg_len},
                         Endpoint{b.senders[i], header.msg_namelen},
                         at};
    }
    return {b.received.data(), taken};
}

SendOutcome UdpSocket::send(const Endpoint& to, std::span<const std::byte> bytes)
{
    const auto sent = sendto(descriptor_, bytes.data(), bytes.size(), 0, to.address(), to.length());
    if (sent >= 0) return SendOutcome::sent;
    switch (errno) {
    case EAGAIN:
    case ENOBUFS: return SendOutcome::buffer_full;
    case ENETUNREACH:
    case EHOSTUNREACH: return SendOutcome::no_route;
    case EMSGSIZE: return SendOutcome::too_big;
    case ECONNREFUSED: return SendOutcome::refused;
    default: return SendOutcome::failed;
    }
}

Endpoint UdpSocket::local() const
{
    sockaddr_storage address{};
    socklen_t length = sizeof address;
    base::ensure(getsockname(descriptor_, reinterpret_cast<sockaddr*>(&address), &length) == 0);
    return Endpoint{address, length};
}

std::uint64_t UdpSocket::overflowed() const { return buffers_->overflowed; }

} // namespace hapnet::net
