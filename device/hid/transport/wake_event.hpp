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

namespace hapnet::device::hid {

/// A thread sleeps on it, and any other wakes that thread, without a lock.
class WakeEvent {
public:
    WakeEvent() : descriptor_{eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)}
    {
        if (descriptor_ < 0) throw std::system_error{errno, std::generic_category(), "eventfd"};
    }
    ~WakeEvent() { close(descriptor_); }
    WakeEvent(const WakeEvent&) = delete;
    WakeEvent& operator=(const WakeEvent&) = delete;

    void signal() const noexcept
    {
        const std::uint64_t one = 1;
        // It fails only after 2^64 signals without a wait.
        std::ignore = ::write(descriptor_, &one, sizeof one);
    }
    void wait() const
    {
        pollfd waiting{.fd = descriptor_, .events = POLLIN, .revents = 0};
        std::ignore = poll(&waiting, 1, -1);
        std::uint64_t rings = 0;
        std::ignore = ::read(descriptor_, &rings, sizeof rings);
    }

private:
    int descriptor_;
};

} // namespace hapnet::device::hid
