// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/batch_sender.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <netinet/udp.h>

namespace hapnet::net {

namespace {

constexpr std::size_t payload_bytes_max = 65'507; // of UDP over IPv4, cut or not

SendOutcome outcome_of(int error)
{
    switch (error) {
    case EAGAIN:
    case ENOBUFS: return SendOutcome::buffer_full;
    case ENETUNREACH:
    case EHOSTUNREACH: return SendOutcome::no_route;
    case EMSGSIZE: return SendOutcome::too_big;
    case ECONNREFUSED: return SendOutcome::refused;
    default: return SendOutcome::failed;
    }
}

/// Whether the kernel says that it will not cut this message: EINVAL or EMSGSIZE for a segment
/// that is larger than the MTU, EIO for a device that computes no checksums, the others for a
/// kernel without UDP_SEGMENT.
bool is_refusal(int error)
{
    return error == EINVAL || error == EMSGSIZE || error == EIO || error == ENOPROTOOPT ||
           error == EOPNOTSUPP;
}

/// What msghdr wants of what it only reads when it sends.
template <typename T>
T* writable(const T* read_only)
{
    return const_cast<T*>(read_only); // NOLINT(*-const-cast)
}

} // namespace

SendOutcome send_one(int descriptor, const Endpoint& to, std::span<const std::byte> bytes)
{
    const auto sent = sendto(descriptor, bytes.data(), bytes.size(), 0, to.address(), to.length());
    return sent >= 0 ? SendOutcome::sent : outcome_of(errno);
}

BatchSender::BatchSender()
{
    for (Control& control : controls_) {
        cmsghdr header{};
        header.cmsg_level = SOL_UDP;
        header.cmsg_type = UDP_SEGMENT;
        header.cmsg_len = CMSG_LEN(sizeof(std::uint16_t));
        std::memcpy(control.bytes.data(), &header, sizeof header);
    }
}

std::span<const SendOutcome>
BatchSender::send(int descriptor, const Endpoint& to,
                  std::span<const std::span<const std::byte>> datagrams)
{
    base::ensure(datagrams.size() <= batch_max);
    if (datagrams.size() == 1) {
        outcomes_[0] = send_one(descriptor, to, datagrams[0]);
        return {outcomes_.data(), 1};
    }
    std::size_t messages = 0;
    for (std::size_t first = 0; first < datagrams.size(); ++messages) {
        const Train train{first, train_length(datagrams.subspan(first))};
        for (std::size_t i = first; i < first + train.count; ++i) {
            vectors_[i] = {.iov_base = writable(datagrams[i].data()),
                           .iov_len = datagrams[i].size()};
        }
        trains_[messages] = train;
        write_message(messages, train, to);
        first += train.count;
    }
    for (std::size_t next = 0; next < messages;) {
        const int sent =
            sendmmsg(descriptor, &headers_[next], static_cast<unsigned int>(messages - next), 0);
        if (sent <= 0) {
            on_error(descriptor, trains_[next], to);
            ++next;
            continue;
        }
        for (const auto end = next + static_cast<std::size_t>(sent); next < end; ++next) {
            std::fill_n(outcomes_.begin() + static_cast<std::ptrdiff_t>(trains_[next].first),
                        trains_[next].count, SendOutcome::sent);
        }
    }
    return {outcomes_.data(), datagrams.size()};
}

/// How many of the datagrams, from the first on, can leave as one message.
std::size_t BatchSender::train_length(std::span<const std::span<const std::byte>> neighbours) const
{
    const std::size_t segment = neighbours.front().size();
    if (segment == 0 || segment >= refused_bytes_) return 1;
    std::size_t count = 1;
    std::size_t total = segment;
    while (count < neighbours.size() && neighbours[count - 1].size() == segment) {
        const std::size_t size = neighbours[count].size();
        if (size == 0 || size > segment || total + size > payload_bytes_max) break;
        total += size;
        ++count;
    }
    return count;
}

void BatchSender::write_message(std::size_t index, const Train& train, const Endpoint& to)
{
    msghdr& header = headers_[index].msg_hdr;
    header = {};
    header.msg_name = writable(to.address());
    header.msg_namelen = to.length();
    header.msg_iov = &vectors_[train.first];
    header.msg_iovlen = train.count;
    if (train.count == 1) return;
    const auto segment = static_cast<std::uint16_t>(vectors_[train.first].iov_len);
    Control& control = controls_[index];
    std::memcpy(control.bytes.data() + CMSG_LEN(0), &segment, sizeof segment);
    header.msg_control = control.bytes.data();
    header.msg_controllen = control.bytes.size();
}

void BatchSender::on_error(int descriptor, const Train& train, const Endpoint& to)
{
    const int error = errno;
    const bool is_uncut = train.count > 1 && is_refusal(error);
    if (is_uncut) refused_bytes_ = std::min(refused_bytes_, vectors_[train.first].iov_len);
    for (std::size_t i = train.first; i < train.first + train.count; ++i) {
        const iovec& one = vectors_[i];
        outcomes_[i] = is_uncut
                           ? send_one(descriptor, to,
                                      {static_cast<const std::byte*>(one.iov_base), one.iov_len})
                           : outcome_of(error);
    }
}

} // namespace hapnet::net
