// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/packet_socket.hpp"

#include "proto/base/ensure.hpp"
#include "proto/net/clock.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <linux/if_ether.h>
#include <linux/if_packet.h>
#include <net/if.h>
#include <netinet/in.h>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <system_error>
#include <unistd.h>
#include <vector>

namespace hapnet::net {

namespace {

constexpr std::size_t frame_bytes_max = 65'536 + ETH_HLEN + 4; // 4: a VLAN tag
constexpr std::size_t tag_bytes = 4;
constexpr std::size_t addresses_bytes = 12; // two Ethernet addresses; a VLAN tag follows them

void set_packet_option(int descriptor, int level, int name, int value)
{
    setsockopt(descriptor, level, name, &value, sizeof value);
}

/// The data about a frame from the kernel, without its bytes.
struct FrameLabel {
    std::optional<base::Duration> stamp; // CLOCK_REALTIME
    tpacket_auxdata auxiliary{};
};

FrameLabel frame_label_of(msghdr& header)
{
    FrameLabel label;
    for (cmsghdr* c = CMSG_FIRSTHDR(&header); c != nullptr; c = CMSG_NXTHDR(&header, c)) {
        if (c->cmsg_level == SOL_SOCKET && c->cmsg_type == SO_TIMESTAMPNS) {
            timespec time{};
            std::memcpy(&time, CMSG_DATA(c), sizeof time);
            label.stamp =
                std::chrono::seconds{time.tv_sec} + std::chrono::nanoseconds{time.tv_nsec};
        } else if (c->cmsg_level == SOL_PACKET && c->cmsg_type == PACKET_AUXDATA) {
            std::memcpy(&label.auxiliary, CMSG_DATA(c), sizeof label.auxiliary);
        }
    }
    return label;
}

SendOutcome frame_outcome_of(int error)
{
    switch (error) {
    case EAGAIN:
    case ENOBUFS: return SendOutcome::buffer_full;
    case EMSGSIZE: return SendOutcome::too_big;
    case ENETDOWN:
    case ENXIO: return SendOutcome::no_route;
    default: return SendOutcome::failed;
    }
}

} // namespace

struct PacketSocket::Inbox {
    Inbox()
    {
        for (std::size_t i = 0; i < batch_max; ++i) {
            // Leaves room before the frame, to which the addresses are moved when a VLAN tag is
            // inserted.
            vectors[i] = {.iov_base = room(i) + tag_bytes, .iov_len = frame_bytes_max - tag_bytes};
            msghdr& header = headers[i].msg_hdr;
            header.msg_iov = &vectors[i];
            header.msg_iovlen = 1;
            header.msg_control = controls[i].bytes.data();
            out_headers[i].msg_hdr.msg_iov = &out_vectors[i];
            out_headers[i].msg_hdr.msg_iovlen = 1;
        }
        received.reserve(batch_max);
    }

    [[nodiscard]] std::byte* room(std::size_t i) { return bytes.get() + i * frame_bytes_max; }

    /// The kernel removes the first VLAN tag from the frame and passes it separately.
    [[nodiscard]] std::span<std::byte> whole(std::size_t i, std::size_t length,
                                             const tpacket_auxdata& auxiliary)
    {
        std::byte* frame = room(i) + tag_bytes;
        if ((auxiliary.tp_status & TP_STATUS_VLAN_VALID) == 0 || length < addresses_bytes) {
            return {frame, length};
        }
        const bool has_protocol = (auxiliary.tp_status & TP_STATUS_VLAN_TPID_VALID) != 0;
        const std::uint16_t protocol = has_protocol ? auxiliary.tp_vlan_tpid : ETH_P_8021Q;
        std::memmove(room(i), frame, addresses_bytes);
        const std::array words{htons(protocol), htons(auxiliary.tp_vlan_tci)};
        std::memcpy(room(i) + addresses_bytes, words.data(), tag_bytes);
        return {room(i), length + tag_bytes};
    }

    struct alignas(cmsghdr) Control {
        std::array<std::byte, 128> bytes;
    };

    std::unique_ptr<std::byte[]> bytes{new std::byte[batch_max * frame_bytes_max]}; // NOLINT: lazy
    std::array<iovec, batch_max> vectors{};
    std::array<mmsghdr, batch_max> headers{};
    std::array<Control, batch_max> controls{};
    std::vector<ReceivedFrame> received;
    std::array<iovec, batch_max> out_vectors{};
    std::array<mmsghdr, batch_max> out_headers{};
    std::array<SendOutcome, batch_max> outcomes{};
    mutable std::uint64_t overflowed = 0;
};

PacketSocket::PacketSocket(const std::string& interface)
    : descriptor_{socket(AF_PACKET, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)},
      inbox_{std::make_unique<Inbox>()}
{
    const auto fail = [&](int error) {
        if (descriptor_ >= 0) close(descriptor_);
        throw std::system_error{error, std::generic_category(),
                                fmt::format("cannot take the frames of {}", interface)};
    };
    if (descriptor_ < 0) fail(errno);
    const unsigned index = if_nametoindex(interface.c_str());
    if (index == 0) fail(ENODEV);
    set_packet_option(descriptor_, SOL_SOCKET, SO_TIMESTAMPNS, 1);
    set_packet_option(descriptor_, SOL_PACKET, PACKET_AUXDATA, 1);
    set_packet_option(descriptor_, SOL_PACKET, PACKET_IGNORE_OUTGOING, 1);
    set_packet_option(descriptor_, SOL_PACKET, PACKET_QDISC_BYPASS, 1);
    const int wanted = 8 << 20;
    for (const auto& [forced, plain] :
         {std::pair{SO_RCVBUFFORCE, SO_RCVBUF}, std::pair{SO_SNDBUFFORCE, SO_SNDBUF}}) {
        if (setsockopt(descriptor_, SOL_SOCKET, forced, &wanted, sizeof wanted) == 0) continue;
        set_packet_option(descriptor_, SOL_SOCKET, plain, wanted);
    }
    // Also receives frames to other machines, because a bridge forwards those.
    packet_mreq everything{};
    everything.mr_ifindex = static_cast<int>(index);
    everything.mr_type = PACKET_MR_PROMISC;
    setsockopt(descriptor_, SOL_PACKET, PACKET_ADD_MEMBERSHIP, &everything, sizeof everything);
    sockaddr_ll address{};
    address.sll_family = AF_PACKET;
    address.sll_protocol = htons(ETH_P_ALL);
    address.sll_ifindex = static_cast<int>(index);
    if (bind(descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
        fail(errno);
    }
}

PacketSocket::~PacketSocket()
{
    if (descriptor_ >= 0) close(descriptor_);
}

std::span<const ReceivedFrame> PacketSocket::receive()
{
    Inbox& inbox = *inbox_;
    for (std::size_t i = 0; i < batch_max; ++i) {
        inbox.headers[i].msg_hdr.msg_controllen = inbox.controls[i].bytes.size();
    }
    const int count = recvmmsg(descriptor_, inbox.headers.data(), batch_max, 0, nullptr);
    if (count < 0) note_error(errno);
    if (count <= 0) return {};
    const auto to_monotonic = monotonic_minus_real();
    const auto now = monotonic_now();
    inbox.received.clear();
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        const auto label = frame_label_of(inbox.headers[i].msg_hdr);
        const auto at =
            label.stamp ? std::min(now, base::TimePoint{*label.stamp + to_monotonic}) : now;
        inbox.received.push_back(
            {.bytes = inbox.whole(i, inbox.headers[i].msg_len, label.auxiliary),
             .at = at,
             .lacks_checksum = (label.auxiliary.tp_status & TP_STATUS_CSUMNOTREADY) != 0});
    }
    return inbox.received;
}

std::span<const SendOutcome>
PacketSocket::send_batch(std::span<const std::span<const std::byte>> frames)
{
    Inbox& inbox = *inbox_;
    base::ensure(frames.size() <= batch_max);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        // The kernel only reads it.
        inbox.out_vectors[i] = {.iov_base = const_cast<std::byte*>(frames[i].data()), // NOLINT
                                .iov_len = frames[i].size()};
    }
    for (std::size_t next = 0; next < frames.size();) {
        const int sent = sendmmsg(descriptor_, &inbox.out_headers[next],
                                  static_cast<unsigned>(frames.size() - next), 0);
        if (sent <= 0) {
            note_error(errno);
            inbox.outcomes[next] = frame_outcome_of(errno);
            ++next;
            continue;
        }
        for (const auto end = next + static_cast<std::size_t>(sent); next < end; ++next) {
            inbox.outcomes[next] = SendOutcome::sent;
        }
    }
    return {inbox.outcomes.data(), frames.size()};
}

/// Notes errors of the interface. The kernel reports each only once, to the first call after it.
void PacketSocket::note_error(int error)
{
    const bool is_of_interface = error == ENETDOWN || error == ENXIO || error == ENODEV;
    if (is_of_interface && error_ == 0) error_ = error;
}

std::uint64_t PacketSocket::overflowed() const
{
    tpacket_stats counted{};
    socklen_t length = sizeof counted;
    // Reading resets the kernel's count.
    if (getsockopt(descriptor_, SOL_PACKET, PACKET_STATISTICS, &counted, &length) == 0) {
        inbox_->overflowed += counted.tp_drops;
    }
    return inbox_->overflowed;
}

} // namespace hapnet::net
