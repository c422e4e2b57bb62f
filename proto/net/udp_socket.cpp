// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/udp_socket.hpp"

#include "proto/net/cure.hpp"

#include "proto/base/ensure.hpp"
#include "proto/net/clock.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <netinet/in.h>
#include <netinet/udp.h>
#include <optional>
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

void set_option(int descriptor, int level, int name, int value)
{
    setsockopt(descriptor, level, name, &value, sizeof value);
}

/// Requests a buffer of up to `bytes`. SO_RCVBUF alone is limited by net.core.rmem_max.
void set_receive_buffer(int descriptor, int bytes)
{
    const bool is_forced =
        setsockopt(descriptor, SOL_SOCKET, SO_RCVBUFFORCE, &bytes, sizeof bytes) == 0;
    if (!is_forced) set_option(descriptor, SOL_SOCKET, SO_RCVBUF, bytes);
}

/// The data about a message from the kernel, without its bytes.
struct Label {
    std::optional<base::Duration> stamp; // CLOCK_REALTIME
    std::optional<std::uint32_t> overflowed;
    std::size_t segment_bytes = 0; // 0: one datagram
    base::IpMarks marks{};
};

template <typename T>
T value_of(const cmsghdr& control)
{
    T value{};
    std::memcpy(&value, CMSG_DATA(&control), sizeof value);
    return value;
}

constexpr std::uint64_t kind_of_control(int level, int type)
{
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(level)) << 32U |
           static_cast<std::uint32_t>(type);
}

void read_control(const cmsghdr& control, Label& label)
{
    switch (kind_of_control(control.cmsg_level, control.cmsg_type)) {
    case kind_of_control(SOL_SOCKET, SO_TIMESTAMPNS):
        label.stamp = to_duration(value_of<timespec>(control));
        break;
    case kind_of_control(SOL_SOCKET, SO_RXQ_OVFL):
        label.overflowed = value_of<std::uint32_t>(control);
        break;
    case kind_of_control(SOL_UDP, UDP_GRO):
        label.segment_bytes = static_cast<std::size_t>(value_of<int>(control));
        break;
    case kind_of_control(IPPROTO_IP, IP_TOS): // a byte; the others are ints
        label.marks.traffic_class = value_of<std::uint8_t>(control);
        break;
    case kind_of_control(IPPROTO_IPV6, IPV6_TCLASS):
        label.marks.traffic_class = static_cast<std::uint8_t>(value_of<int>(control));
        break;
    case kind_of_control(IPPROTO_IP, IP_TTL):
    case kind_of_control(IPPROTO_IPV6, IPV6_HOPLIMIT):
        label.marks.hop_limit = static_cast<std::uint8_t>(value_of<int>(control));
        break;
    default: break;
    }
}

/// Reads the control data of a message. CMSG_NXTHDR would cost a call for each item.
Label label_of(const msghdr& header)
{
    Label label;
    const auto* const all = static_cast<const std::byte*>(header.msg_control);
    for (std::size_t at = 0; at + sizeof(cmsghdr) <= header.msg_controllen;) {
        const auto& control =
            *reinterpret_cast<const cmsghdr*>(all + at); // NOLINT(*-reinterpret-*)
        read_control(control, label);
        at += std::max(CMSG_ALIGN(control.cmsg_len), sizeof(cmsghdr));
    }
    return label;
}

/// Asks the kernel for the marks of arriving datagrams. Returns the marks of outgoing datagrams
/// without marks of their own. For IPv6, this also fixes a default that routers could change later.
base::IpMarks ask_for_marks(int descriptor, int family)
{
    set_option(descriptor, IPPROTO_IP, IP_RECVTOS, 1); // also on an IPv6 socket that receives IPv4
    set_option(descriptor, IPPROTO_IP, IP_RECVTTL, 1);
    int hops = 0;
    socklen_t length = sizeof hops;
    if (family == AF_INET) {
        getsockopt(descriptor, IPPROTO_IP, IP_TTL, &hops, &length);
    } else {
        set_option(descriptor, IPPROTO_IPV6, IPV6_RECVTCLASS, 1);
        set_option(descriptor, IPPROTO_IPV6, IPV6_RECVHOPLIMIT, 1);
        getsockopt(descriptor, IPPROTO_IPV6, IPV6_UNICAST_HOPS, &hops, &length);
        set_option(descriptor, IPPROTO_IPV6, IPV6_UNICAST_HOPS, hops);
        set_option(descriptor, IPPROTO_IP, IP_TTL, hops);
    }
    return {.traffic_class = 0, .hop_limit = static_cast<std::uint8_t>(hops)};
}

} // namespace

struct UdpSocket::Inbox {
    static constexpr std::size_t control_bytes = 256;
    /// UDP_MAX_SEGMENTS of Linux 6.9 and later; it was 64 before.
    static constexpr std::size_t segments_max = 128;
    /// The number of datagrams to take at a time when messages contain many. Their processing takes
    /// a relay a third of a millisecond.
    static constexpr std::size_t datagrams_wanted = 512;

    explicit Inbox(Load load)
    {
        for (std::size_t i = 0; i < batch_max; ++i) {
            vectors[i] = {.iov_base = payload.get() + i * payload_bytes_max,
                          .iov_len = payload_bytes_max};
            msghdr& header = headers[i].msg_hdr;
            header.msg_name = &senders[i];
            header.msg_iov = &vectors[i];
            header.msg_iovlen = 1;
            header.msg_control = controls[i].bytes.data();
        }
        make_ready(batch_max);
        received.reserve(load == Load::bulk ? batch_max * segments_max : batch_max);
    }

    /// Resets the lengths of the messages, which the kernel overwrites.
    void make_ready(std::size_t count)
    {
        for (std::size_t i = 0; i < count; ++i) {
            headers[i].msg_hdr.msg_namelen = sizeof(sockaddr_storage);
            headers[i].msg_hdr.msg_controllen = control_bytes;
        }
    }

    /// Splits a message into its datagrams.
    void put(std::size_t index, const Label& label, base::TimePoint at)
    {
        const std::span<const std::byte> bytes{payload.get() + index * payload_bytes_max,
                                               headers[index].msg_len};
        const Endpoint from{senders[index], headers[index].msg_hdr.msg_namelen};
        const std::size_t step = label.segment_bytes == 0 ? payload_bytes_max : label.segment_bytes;
        std::size_t begin = 0;
        do {
            base::ensure(received.size() < received.capacity());
            received.push_back({bytes.subspan(begin, std::min(step, bytes.size() - begin)), from,
                                at, label.marks});
            begin += step;
        } while (begin < bytes.size());
    }

    void count_overflow(std::uint32_t total)
    {
        overflowed += static_cast<std::uint32_t>(total - overflowed_last);
        overflowed_last = total;
    }

    // The memory is not zeroed, because most of it is never used.
    std::unique_ptr<std::byte[]> payload = // NOLINT(*-avoid-c-arrays)
        std::make_unique_for_overwrite<std::byte[]>(batch_max * payload_bytes_max);
    std::array<iovec, batch_max> vectors{};
    std::array<mmsghdr, batch_max> headers{};
    std::array<sockaddr_storage, batch_max> senders{};
    struct alignas(cmsghdr) Control {
        std::array<std::byte, control_bytes> bytes;
    };
    std::array<Control, batch_max> controls{};
    std::vector<Received> received; // datagrams of the last batch
    std::size_t messages_next = batch_max;
    ErrorQueue answers;                // answers by ICMP
    std::uint32_t overflowed_last = 0; // last count of the kernel: 32 bits, wraps around
    std::uint64_t overflowed = 0;
};

UdpSocket::UdpSocket(const Endpoint& local, Load load) : UdpSocket{local, load, Place::alone} {}

UdpSocket UdpSocket::beside(UdpSocket& first, Load load)
{
    // The option is set after the first bind, so that any other program that uses the address, or
    // tries to, is refused.
    set_option(first.descriptor_, SOL_SOCKET, SO_REUSEPORT, 1);
    return UdpSocket{first.local(), load, Place::shared};
}

UdpSocket::UdpSocket(const Endpoint& local, Load load, Place place)
    : descriptor_{socket(local.family(), SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)},
      inbox_{std::make_unique<Inbox>(load)}
{
    if (descriptor_ < 0) throw std::system_error{errno, std::generic_category(), "socket"};
    set_option(descriptor_, SOL_SOCKET, SO_TIMESTAMPNS, 1);
    set_option(descriptor_, SOL_SOCKET, SO_RXQ_OVFL, 1);
    // 4 MB is a second of a busy link while this process does not run.
    set_option(descriptor_, SOL_SOCKET, SO_RCVBUF, 4 << 20);
    set_option(descriptor_, SOL_SOCKET, SO_SNDBUF, 4 << 20);
    base::IpMarks usual;
    if (load == Load::bulk) {
        // The buffer is not larger, because datagrams that wait here at the end of a flood delay
        // later ones. Merged, 4 MB (the kernel doubles it) hold some 60 000 small datagrams, which
        // take a relay 60 ms. With 8 MB, it was late for 160 ms after a flood.
        set_receive_buffer(descriptor_, 4 << 20);
        set_option(descriptor_, SOL_UDP, UDP_GRO, 1);
        usual = ask_for_marks(descriptor_, local.family());
        ErrorQueue::ask_for(descriptor_, local.family());
    }
    sender_ = std::make_unique<BatchSender>(usual, load == Load::bulk ? &inbox_->answers : nullptr);
    if (place == Place::shared) set_option(descriptor_, SOL_SOCKET, SO_REUSEPORT, 1);
    if (bind(descriptor_, local.address(), local.length()) != 0) {
        const int error = errno;
        close(descriptor_);
        throw std::system_error{error, errors_of(AddressUse::bind),
                                fmt::format("cannot bind to {}", local.to_text())};
    }
}

UdpSocket::~UdpSocket()
{
    if (descriptor_ >= 0) close(descriptor_);
}

UdpSocket::UdpSocket(UdpSocket&& other) noexcept
    : descriptor_{std::exchange(other.descriptor_, -1)},
      inbox_{std::move(other.inbox_)},
      sender_{std::move(other.sender_)}
{}

std::span<const Received> UdpSocket::receive()
{
    Inbox& inbox = *inbox_;
    const int count = recvmmsg(descriptor_, inbox.headers.data(),
                               static_cast<unsigned int>(inbox.messages_next), 0, nullptr);
    if (count <= 0) { // nothing there, or an answer to an earlier datagram
        const bool is_answer = errno != EAGAIN || inbox.answers.is_suspected();
        if (is_answer) inbox.answers.drain(descriptor_);
        return {};
    }
    const auto to_monotonic = monotonic_minus_real();
    const auto now = monotonic_now();
    const auto taken = static_cast<std::size_t>(count);
    inbox.received.clear();
    for (std::size_t i = 0; i < taken; ++i) {
        const Label label = label_of(inbox.headers[i].msg_hdr);
        if (label.overflowed) inbox.count_overflow(*label.overflowed);
        const auto at =
            label.stamp ? std::min(now, base::TimePoint{*label.stamp + to_monotonic}) : now;
        inbox.put(i, label, at);
    }
    inbox.make_ready(taken);
    const auto per_message = inbox.received.size() / taken;
    inbox.messages_next =
        std::clamp<std::size_t>(Inbox::datagrams_wanted / per_message, 1, batch_max);
    return inbox.received;
}

SendOutcome UdpSocket::send(const Endpoint& to, std::span<const std::byte> bytes)
{
    return send_one(descriptor_, to, bytes, &inbox_->answers);
}

std::span<const SendOutcome>
UdpSocket::send_batch(const Endpoint& to, std::span<const std::span<const std::byte>> datagrams,
                      std::span<const base::IpMarks> marks)
{
    return sender_->send(descriptor_, to, datagrams, marks);
}

Endpoint UdpSocket::local() const
{
    sockaddr_storage address{};
    socklen_t length = sizeof address;
    base::ensure(getsockname(descriptor_, reinterpret_cast<sockaddr*>(&address), &length) == 0);
    return Endpoint{address, length};
}

std::uint64_t UdpSocket::overflowed() const { return inbox_->overflowed; }

std::uint64_t UdpSocket::unreachable() const { return inbox_->answers.unreachable(); }

} // namespace hapnet::net
