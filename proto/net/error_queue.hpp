// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace hapnet::net {

/// ICMP answers of other hosts to the datagrams of a socket. The kernel returns such an answer as
/// the error of the socket's next call, and also keeps it in a separate queue.
class ErrorQueue {
public:
    /// Makes the kernel keep the answers to datagrams that this socket sends from now on.
    static void ask_for(int descriptor, int family);

    /// Takes the waiting answers, at most 256 of them. Returns true if there was one. A call that
    /// has just failed may then have failed because of it, and can be repeated.
    bool drain(int descriptor);

    /// Notes that answers may be waiting, because a call handled fewer datagrams than it was given.
    void suspect() { is_suspected_ = true; }
    [[nodiscard]] bool is_suspected() const { return is_suspected_; }

    /// Returns the number of "port unreachable" answers so far. They mean that the host is up but
    /// no program listens. Hosts limit the rate of these answers.
    [[nodiscard]] std::uint64_t unreachable() const { return unreachable_; }

private:
    std::uint64_t unreachable_ = 0;
    bool is_suspected_ = false;
};

} // namespace hapnet::net
