// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/wait.hpp"

#include "proto/base/ensure.hpp"
#include "proto/net/clock.hpp"

#include <algorithm>
#include <array>
#include <ctime>
#include <poll.h>

namespace hapnet::net {

bool wait_readable(std::span<const int> descriptors, std::optional<base::TimePoint> deadline)
{
    std::array<pollfd, descriptors_max> polled; // NOLINT(*-member-init): as many as are used
    base::ensure(descriptors.size() <= polled.size());
    for (std::size_t i = 0; i < descriptors.size(); ++i) {
        polled[i] = {.fd = descriptors[i], .events = POLLIN, .revents = 0};
    }
    timespec timeout{};
    if (deadline) {
        const auto left = std::max(base::Duration{0}, *deadline - monotonic_now());
        const auto seconds = std::chrono::floor<std::chrono::seconds>(left);
        timeout.tv_sec = seconds.count();
        timeout.tv_nsec = (left - seconds).count();
    }
    return ppoll(polled.data(), descriptors.size(), deadline ? &timeout : nullptr, nullptr) > 0;
}

} // namespace hapnet::net
