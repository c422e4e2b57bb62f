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

constexpr std::size_t payload_bytes_max = 65'507; // largest UDP payload over IPv4, segmented or not

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

/// True if the kernel refuses to split this message: EINVAL or EMSGSIZE for a segment larger than
/// the MTU, EIO for a device that computes no checksums, the others for a kernel without
/// UDP_SEGMENT.
bool is_refusal(int error)
{
    return error == EINVAL || error == EMSGSIZE || error == EIO || error == ENOPROTOOPT ||
           error == EOPNOTSUPP;
}

/// True if datagrams to this endpoint are sent as IPv4, which includes IPv4-mapped IPv6 addresses.
bool goes_as_v4(const Endpoint& to)
{
    if (to.family() == AF_INET) return true;
    sockaddr_in6 address{};
    std::memcpy(&address, to.address(), sizeof address);
    return IN6_IS_ADDR_V4MAPPED(&address.sin6_addr);
}

/// Writes the items of a message's control data, one after the other.
class ControlWriter {
public:
    explicit ControlWriter(std::span<std::byte> bytes) : bytes_{bytes} {}

    template <typename T>
    void put(int level, int type, T value)
    {
        cmsghdr header{};
        header.cmsg_level = level;
        header.cmsg_type = type;
        header.cmsg_len = CMSG_LEN(sizeof value);
        std::memcpy(&bytes_[used_], &header, sizeof header);
        std::memcpy(&bytes_[used_ + CMSG_LEN(0)], &value, sizeof value);
        used_ += CMSG_SPACE(sizeof value);
    }
    [[nodiscard]] std::size_t used() const { return used_; }

private:
    std::span<std::byte> bytes_;
    std::size_t used_ = 0;
};

void put_marks(ControlWriter& control, base::IpMarks marks, bool as_v4)
{
    control.put(as_v4 ? IPPROTO_IP : IPPROTO_IPV6, as_v4 ? IP_TOS : IPV6_TCLASS,
                int{marks.traffic_class});
    if (marks.hop_limit == 0) return;
    control.put(as_v4 ? IPPROTO_IP : IPPROTO_IPV6, as_v4 ? IP_TTL : IPV6_HOPLIMIT,
                int{marks.hop_limit});
}

/// True if a call that has just failed may have failed because of an ICMP answer to an earlier
/// datagram. Takes that answer. Answers may arrive as fast as datagrams are sent.
bool may_try_again(int descriptor, ErrorQueue* answers, int trial)
{
    constexpr int trials_max = 4;
    return answers != nullptr && trial < trials_max && answers->drain(descriptor);
}

/// Removes const from a pointer: msghdr takes pointers to mutable data, although sending only reads
/// the data.
template <typename T>
T* writable(const T* read_only)
{
    return const_cast<T*>(read_only); // NOLINT(*-const-cast)
}

} // namespace

SendOutcome send_one(int descriptor, const Endpoint& to, std::span<const std::byte> bytes,
                     ErrorQueue* answers)
{
    for (int trial = 1;; ++trial) {
        const auto sent =
            sendto(descriptor, bytes.data(), bytes.size(), 0, to.address(), to.length());
        if (sent >= 0) return SendOutcome::sent;
        const int error = errno;
        if (!may_try_again(descriptor, answers, trial)) return outcome_of(error);
    }
}

BatchSender::BatchSender(base::IpMarks usual, ErrorQueue* answers)
    : usual_{usual}, answers_{answers}
{}

std::span<const SendOutcome>
BatchSender::send(int descriptor, const Endpoint& to,
                  std::span<const std::span<const std::byte>> datagrams,
                  std::span<const base::IpMarks> marks)
{
    base::ensure(datagrams.size() <= batch_max);
    base::ensure(marks.empty() || marks.size() == datagrams.size());
    const auto is_usual = [this](base::IpMarks one) { return one == usual_; };
    if (std::ranges::all_of(marks, is_usual)) marks = {}; // without control data, which costs least
    if (datagrams.size() == 1 && marks.empty()) {
        outcomes_[0] = send_one(descriptor, to, datagrams[0], answers_);
        return {outcomes_.data(), 1};
    }
    std::size_t messages = 0;
    for (std::size_t first = 0; first < datagrams.size(); ++messages) {
        const Train train{first, train_length(datagrams.subspan(first),
                                              marks.empty() ? marks : marks.subspan(first))};
        for (std::size_t i = first; i < first + train.count; ++i) {
            vectors_[i] = {.iov_base = writable(datagrams[i].data()),
                           .iov_len = datagrams[i].size()};
        }
        trains_[messages] = train;
        write_message(messages, train, to,
                      marks.empty() ? std::nullopt : std::optional{marks[first]});
        first += train.count;
    }
    int trial = 1;
    for (std::size_t next = 0; next < messages;) {
        const int sent =
            sendmmsg(descriptor, &headers_[next], static_cast<unsigned int>(messages - next), 0);
        if (sent <= 0) {
            const int error = errno;
            if (may_try_again(descriptor, answers_, trial++)) continue;
            on_error(descriptor, trains_[next], {next, error});
            ++next;
            trial = 1;
            continue;
        }
        trial = 1;
        const bool is_part = static_cast<std::size_t>(sent) < messages - next;
        if (is_part && answers_ != nullptr) answers_->suspect();
        for (const auto end = next + static_cast<std::size_t>(sent); next < end; ++next) {
            std::fill_n(outcomes_.begin() + static_cast<std::ptrdiff_t>(trains_[next].first),
                        trains_[next].count, SendOutcome::sent);
        }
    }
    return {outcomes_.data(), datagrams.size()};
}

/// Returns the number of datagrams, counted from the first, that can be sent as one message.
std::size_t BatchSender::train_length(std::span<const std::span<const std::byte>> neighbours,
                                      std::span<const base::IpMarks> marks) const
{
    const std::size_t segment = neighbours.front().size();
    if (segment == 0 || segment >= refused_bytes_) return 1;
    std::size_t count = 1;
    std::size_t total = segment;
    while (count < neighbours.size() && neighbours[count - 1].size() == segment) {
        const std::size_t size = neighbours[count].size();
        if (size == 0 || size > segment || total + size > payload_bytes_max) break;
        if (!marks.empty() && marks[count] != marks.front()) break;
        total += size;
        ++count;
    }
    return count;
}

void BatchSender::write_message(std::size_t index, const Train& train, const Endpoint& to,
                                std::optional<base::IpMarks> marks)
{
    msghdr& header = headers_[index].msg_hdr;
    header = {};
    header.msg_name = writable(to.address());
    header.msg_namelen = to.length();
    header.msg_iov = &vectors_[train.first];
    header.msg_iovlen = train.count;
    if (train.count == 1 && !marks) return;
    ControlWriter control{controls_[index].bytes};
    if (marks) put_marks(control, *marks, goes_as_v4(to));
    if (train.count > 1) { // last, so that it can be left out
        control.put(SOL_UDP, UDP_SEGMENT,
                    static_cast<std::uint16_t>(vectors_[train.first].iov_len));
    }
    header.msg_control = controls_[index].bytes.data();
    header.msg_controllen = control.used();
}

void BatchSender::on_error(int descriptor, const Train& train, const Failure& failure)
{
    const auto [index, error] = failure;
    const bool is_uncut = train.count > 1 && is_refusal(error);
    if (is_uncut) refused_bytes_ = std::min(refused_bytes_, vectors_[train.first].iov_len);
    msghdr one = headers_[index].msg_hdr;
    one.msg_iovlen = 1;
    if (is_uncut) one.msg_controllen -= CMSG_SPACE(sizeof(std::uint16_t));
    for (std::size_t i = train.first; i < train.first + train.count; ++i) {
        one.msg_iov = &vectors_[i];
        const bool is_sent = is_uncut && sendmsg(descriptor, &one, 0) >= 0;
        outcomes_[i] = is_sent ? SendOutcome::sent : outcome_of(is_uncut ? errno : error);
    }
}

} // namespace hapnet::net
