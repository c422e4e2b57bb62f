// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "device/replay/given_hand.hpp"
#include "device/replay/hand_trace.hpp"

#include <optional>
#include <string>

namespace hapnet::device {

/// The behaviour of a hand after the last moment of its trace.
enum class AfterTheEnd : std::uint8_t {
    stays,        // the hand stays at the last place and lets go
    begins_again, // the trace repeats, with a jump unless it ends where it began
};

/// A hand that follows a recorded path, whatever the force is. Between recorded moments it moves at
/// constant speed. The trace's time counts from the session's start; before its first moment the
/// hand waits at that position. The velocity is like that of a device: the path's differences,
/// low-passed at 30 Hz.
class Replay final : public Device {
public:
    /// `trace` has at least one moment, in the order of time. `source` is for the description.
    Replay(HandTrace trace, std::string source, AfterTheEnd after = AfterTheEnd::stays);

    [[nodiscard]] const Identity& identity() const override { return identity_; }
    [[nodiscard]] const Capabilities& capabilities() const override { return capabilities_; }
    [[nodiscard]] Sample read(base::TimePoint now) override;
    void apply(const GovernedForce& force) override;
    void halt() noexcept override {} // it has no motors
    void on_cue(const Cue& cue) override;

private:
    [[nodiscard]] HandMoment at(double seconds) const;

    HandTrace trace_;
    AfterTheEnd after_;
    Identity identity_;
    Capabilities capabilities_ = GivenHand::capabilities();
    std::optional<base::TimePoint> start_;
    GivenHand hand_;
};

} // namespace hapnet::device
