// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace hapnet::net {

/// The ICMP answers of other hosts to datagrams of a socket. The kernel returns such an answer as
/// the error of the socket's next call, and also keeps it in a queue of its own.
class ErrorQueue {
public:
    /// Has the kernel keep the answers to datagrams that this socket sends from now on.
    static void ask_for(int descriptor, int family);

    /// Takes the answers that are there, at most 256 of them. True if there was one: then a call
    /// that has just failed may have failed for it, and can be made again.
    bool drain(int descriptor);

    /// A call told of less than it was asked for: answers may wait.
    void suspect() { is_suspected_ = true; }
    [[nodiscard]] bool is_suspected() const { return is_suspected_; }

    /// Answers "port unreachable" so far: the host is there, and no program listens. Hosts limit
    /// how many they send.
    [[nodiscard]] std::uint64_t unreachable() const { return unreachable_; }

private:
    std::uint64_t unreachable_ = 0;
    bool is_suspected_ = false;
};

} // namespace hapnet::net
