// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "device/governor/limits.hpp"
#include "device/governor/trip.hpp"

#include <chrono>
#include <optional>

namespace hapnet::device {

/// The result of checking a sample: whether it permits a force, and the reason if it does not.
enum class Finding : std::uint8_t {
    usable,
    unheard,      // no report from the device yet
    silent,       // no new sample for stall_max: the last one may be outdated
    docked,       // the stylus is in its holder
    uncalibrated, // positions are meaningless
    too_fast,     // too fast to begin a force: wait until the device is slower
    tripped,      // a fault, which must be latched
};

/// Checks one sample after the other.
class SampleCheck {
public:
    struct Result {
        Finding finding = Finding::usable;
        Latched fault{}; // the fault if the finding is `tripped`
    };

    /// The force that the device gives until this sample.
    struct Push {
        bool may_be_felt = false;
        base::Force force{};
    };

    /// Checks one sample. `passed` is the time since the last sample, or zero after a stall of the
    /// loop, in which the device was not asked.
    [[nodiscard]] Result look(const GovernorLimits& limits, const Sample& sample,
                              base::Duration passed, const Push& push);

    /// The time without any change of the position, under at least a certain force, after which
    /// there is a fault: a hand trembles by more than one count of any encoder.
    static constexpr base::Duration frozen_after{std::chrono::seconds{3}};
    static constexpr double frozen_force_n = 0.5;
    /// The increase of speed against at least a certain force, within 25 to 50 ms, that is a fault.
    /// It is 8 m/s2, which a hand's push in contact does not reach, and motors with the wrong sign
    /// do.
    static constexpr double runaway_m_per_s = 0.4;
    static constexpr double runaway_force_n = 1.0;

private:
    [[nodiscard]] Trip too_fast(const GovernorLimits& limits, const Sample& sample,
                                base::Duration since_last) const;

    [[nodiscard]] Trip misfit(const Sample& sample, base::Duration passed, const Push& push,
                              bool is_new);

    bool heard_ = false;
    bool placed_ = false; // place_ is valid
    std::uint64_t sequence_ = 0;
    base::Duration silence_{}; // time since the last new sample
    base::Position place_;     // position in the last new sample
    base::Duration frozen_{};  // time without a change of place_ under force
    /// The slowest motion against the force in the current and the previous piece of 25 ms.
    struct Slowest {
        double now = 0.0;
        double before = 0.0;
        base::Duration into_piece{};
    };
    std::optional<Slowest> slowest_; // nullopt: too little force
};

} // namespace hapnet::device
