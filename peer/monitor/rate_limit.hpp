// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <algorithm>
#include <chrono>
#include <optional>

namespace hapnet::peer::monitor {

/// A token bucket: admits a burst, and then one event per `every`.
class RateLimit {
public:
    RateLimit(int at_once, base::Duration every) : room_{at_once * every}, every_{every} {}

    /// True if one more event is admitted at `now`, which must not decrease.
    [[nodiscard]] bool admits(base::TimePoint now)
    {
        if (last_) level_ = std::max(base::Duration{0}, level_ - (now - *last_));
        last_ = now;
        if (level_ + every_ > room_) return false;
        level_ += every_;
        return true;
    }

private:
    base::Duration room_;
    base::Duration every_;
    base::Duration level_{};
    std::optional<base::TimePoint> last_;
};

} // namespace hapnet::peer::monitor
