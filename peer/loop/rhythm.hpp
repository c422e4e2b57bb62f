// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <cstdint>
#include <optional>

namespace hapnet::peer {

/// A turn of the loop: when it was due, how much later it came, and how many were skipped since the
/// one before because it was too late for them.
struct Beat {
    base::TimePoint due;
    base::Duration late{};
    std::uint32_t missed_before = 0;
};

/// When turns are due at the host's own pace: every tick, by absolute time.
class OwnRhythm {
public:
    /// The first turn is a tick after `now`.
    OwnRhythm(base::TimePoint now, base::Duration tick) : tick_{tick}, due_{now + tick} {}

    [[nodiscard]] base::TimePoint next() const { return due_; }
    /// A turn that begins at `now`, after next().
    [[nodiscard]] Beat begin(base::TimePoint now) const { return {due_, now - due_, missed_}; }
    /// It ended at `now`: turns whose whole period has passed by then are skipped.
    void end(base::TimePoint now);

private:
    base::Duration tick_;
    base::TimePoint due_;
    std::uint32_t missed_ = 0;
};

/// When turns are due at the pace of a device: at its cycles, of which some are skipped where they
/// come more often than turns. A turn is late by the device's own measure: the due times follow
/// its cycles slowly (a 32nd of what they are off), so that another clock's drift is none of its
/// lateness, and jitter is.
class DeviceRhythm {
public:
    explicit DeviceRhythm(base::Duration tick) : tick_{tick} {}

    /// A cycle at `now`; nullopt where it is too early for a turn.
    [[nodiscard]] std::optional<Beat> at(base::TimePoint now);

private:
    base::Duration tick_;
    std::optional<base::TimePoint> due_;
    std::optional<base::TimePoint> last_; // cycle
};

} // namespace hapnet::peer
