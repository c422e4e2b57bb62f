// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/ip_marks.hpp"
#include "proto/net/endpoint.hpp"
#include "proto/net/error_queue.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <netinet/in.h>
#include <optional>
#include <span>
#include <sys/socket.h>
#include <sys/uio.h>

namespace hapnet::net {

enum class SendOutcome : std::uint8_t { sent, buffer_full, no_route, too_big, refused, failed };

/// Sends one datagram. Never blocks. `answers` is the queue of ICMP answers to earlier datagrams of
/// the socket, which can make a call fail. nullptr: the socket does not keep them.
[[nodiscard]] SendOutcome send_one(int descriptor, const Endpoint& to,
                                   std::span<const std::byte> bytes, ErrorQueue* answers = nullptr);

/// Sends many datagrams to one place with few system calls. Neighbours of one size (the last may be
/// shorter) are passed to the kernel as one message, which it splits again (UDP_SEGMENT). Only this
/// makes loopback and most network cards faster; fewer system calls alone hardly matter. The
/// receiver gets the same datagrams. Never allocates after construction.
class BatchSender {
public:
    static constexpr std::size_t batch_max = 64; // datagrams per send(); segments per message

    /// `usual` are the marks that the socket gives to a datagram without marks of its own.
    /// `answers` is the same as in send_one().
    explicit BatchSender(base::IpMarks usual = {}, ErrorQueue* answers = nullptr);

    /// Sends datagrams and returns their outcomes in order, valid until the next send(). Ensures
    /// that there are at most batch_max. Never blocks. `marks` has the marks of each datagram; if
    /// it is empty, all get the marks of the socket.
    std::span<const SendOutcome> send(int descriptor, const Endpoint& to,
                                      std::span<const std::span<const std::byte>> datagrams,
                                      std::span<const base::IpMarks> marks = {});

private:
    /// Consecutive datagrams that are sent as one message.
    struct Train {
        std::size_t first = 0;
        std::size_t count = 0;
    };
    /// The control data of a message: the size of its segments, and its two marks.
    struct alignas(cmsghdr) Control {
        std::array<std::byte, CMSG_SPACE(sizeof(std::uint16_t)) + 2 * CMSG_SPACE(sizeof(int))>
            bytes{};
    };

    [[nodiscard]] std::size_t train_length(std::span<const std::span<const std::byte>> neighbours,
                                           std::span<const base::IpMarks> marks) const;
    void write_message(std::size_t index, const Train& train, const Endpoint& to,
                       std::optional<base::IpMarks> marks);
    /// A message that was not sent, and the reason.
    struct Failure {
        std::size_t index = 0;
        int error = 0;
    };
    void on_error(int descriptor, const Train& train, const Failure& failure);

    /// The smallest segment size that the kernel has refused to split, because the device's MTU is
    /// smaller or it cannot split at all. Datagrams of this size and larger ones are sent one by
    /// one.
    std::size_t refused_bytes_ = 65'536;
    base::IpMarks usual_;
    ErrorQueue* answers_;
    std::array<iovec, batch_max> vectors_{};
    std::array<Train, batch_max> trains_{};
    std::array<mmsghdr, batch_max> headers_{};
    std::array<Control, batch_max> controls_{};
    std::array<SendOutcome, batch_max> outcomes_{};
};

} // namespace hapnet::net
