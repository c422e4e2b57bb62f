// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>
#include <cstdint>
#include <poll.h>
#include <sys/eventfd.h>
#include <system_error>
#include <tuple>
#include <unistd.h>

namespace hapnet::net {

/// Wakes a thread that waits for descriptors. Any other thread can signal it, without a lock.
class WakeEvent {
public:
    /// Throws std::system_error.
    WakeEvent() : descriptor_{eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)}
    {
        if (descriptor_ < 0) throw std::system_error{errno, std::generic_category(), "eventfd"};
    }
    ~WakeEvent() { close(descriptor_); }
    WakeEvent(const WakeEvent&) = delete;
    WakeEvent& operator=(const WakeEvent&) = delete;

    /// Readable from signal() to clear().
    [[nodiscard]] int descriptor() const { return descriptor_; }

    void signal() const noexcept
    {
        const std::uint64_t one = 1;
        // The write fails only after 2^64 signals that were not cleared.
        std::ignore = ::write(descriptor_, &one, sizeof one);
    }
    void clear() const noexcept
    {
        std::uint64_t signals = 0;
        std::ignore = ::read(descriptor_, &signals, sizeof signals);
    }

    /// Sleeps until it is signalled, and clears it. It may return early, so check if there is
    /// something to do.
    void wait() const noexcept
    {
        pollfd waiting{.fd = descriptor_, .events = POLLIN, .revents = 0};
        std::ignore = ::poll(&waiting, 1, -1);
        clear();
    }

private:
    int descriptor_;
};

} // namespace hapnet::net
