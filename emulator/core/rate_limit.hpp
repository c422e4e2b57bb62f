// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <chrono>
#include <optional>

namespace hapnet::emulator {

/// Lets the first of many equal messages pass, and then one in ten seconds, so that traffic from
/// strangers cannot fill a log.
class RateLimit {
public:
    static constexpr base::Duration every = std::chrono::seconds{10};

    [[nodiscard]] bool permits(base::TimePoint now)
    {
        if (last_ && now - *last_ < every) return false;
        last_ = now;
        return true;
    }

private:
    std::optional<base::TimePoint> last_;
};

} // namespace hapnet::emulator
