// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace hapnet::peer {

/// A measurement of the remote's clock by one echoed message.
struct ClockSample {
    base::TimePoint sent;         // by us, our clock
    base::TimePoint heard;        // by them, their clock
    base::TimePoint answered;     // by them, their clock
    base::TimePoint answer_heard; // by us, our clock
};

/// The relation of the remote's clock to ours.
struct ClockEstimate {
    base::Duration offset{};      // their clock minus ours, now
    base::Duration uncertainty{}; // half the least round trip, which bounds what asymmetry can
                                  // hide, and what the fit may err by
    double skew_ppm = 0.0;        // how much faster their clock runs than ours
};

/// Estimates the remote's clock from echoes (NTP's offset, RFC 5905 section 8). Queueing delays
/// both lengthen a round trip and spoil its offset, so of each second only the sample with the
/// shortest round trip is kept, 64 seconds of them, and of these only those that are about as short
/// as the shortest. A straight line through them, the shorter the weightier, gives offset and skew.
///
/// What it says never steps once it has settled, in the first two seconds: it follows by 500 us a
/// second at most. A clock that jumps (a machine that slept, a virtual one that was moved) makes it
/// doubt at the first sample, is recognised after eight seconds, and then it steps once.
///
/// Sides that name the same boot share a clock, so their offset is zero. That is believed from the
/// first sample that allows it on. Samples that rule it out end the belief: the first one at once,
/// later eight in a row, as one may be damaged.
class ClockSync {
public:
    static constexpr base::Duration window{std::chrono::seconds{1}};
    static constexpr std::size_t windows_max = 64;
    static constexpr base::Duration settles_within{std::chrono::seconds{2}};
    static constexpr double slew_max = 500e-6;
    static constexpr double skew_max_ppm = 200.0; // crystals differ by about a tenth of this
    static constexpr std::size_t windows_for_skew = 8;
    static constexpr std::size_t windows_for_jump = 8;
    /// Beyond half the round trip, which bounds what queues and asymmetry can do to an offset.
    static constexpr base::Duration jump_least{std::chrono::milliseconds{50}};
    static constexpr std::uint32_t samples_needed = 8; // consecutive samples that must agree

    /// Ignores samples with a negative round trip or an offset of more than ten years.
    void add(const ClockSample& sample);
    /// The two name the same boot: their clocks are one, unless samples rule that out.
    void set_same_clock() { same_clock_ = SameClock::claimed; }

    /// Returns nullopt before the first sample.
    [[nodiscard]] std::optional<ClockEstimate> estimate() const;
    /// The number of jumps of the remote's clock.
    [[nodiscard]] std::uint32_t jumps() const { return jumps_; }
    /// True from a sample that no queue explains, or a jump, until enough samples agree. Do not
    /// predict from the estimate in this time.
    [[nodiscard]] bool is_in_doubt() const { return agreeing_left_ > 0; }
    /// The estimate to predict from: nullopt before the first sample, and while in doubt.
    [[nodiscard]] std::optional<ClockEstimate> trusted() const
    {
        return is_in_doubt() ? std::nullopt : estimate();
    }

    void reset() { *this = ClockSync{}; }

private:
    struct Window {
        base::TimePoint at; // when its sample arrived
        base::Duration offset;
        base::Duration round_trip;
    };
    /// The line through the windows.
    struct Fit {
        base::TimePoint when{};
        base::Duration offset{}; // offset at the time `when`
        base::Duration uncertainty{};
        double skew = 0.0;

        [[nodiscard]] base::Duration at_time(base::TimePoint now) const
        {
            if (skew == 0.0) return offset;
            return offset + std::chrono::duration_cast<base::Duration>(skew * (now - when));
        }
    };

    /// Says if both sides have one clock: they do not, they claim to, or a sample has shown it.
    enum class SameClock : std::uint8_t { no, claimed, seen };

    [[nodiscard]] bool shows_same_clock(const Window& sample);
    void close_window();
    [[nodiscard]] base::Duration unexplained(const Window& sample) const;
    void consider(const Window& sample);
    [[nodiscard]] bool has_jumped() const;
    [[nodiscard]] Fit fit(base::TimePoint now) const;
    void follow(base::TimePoint now);

    SameClock same_clock_ = SameClock::no;
    std::uint32_t ruled_out_ = 0; // consecutive samples that rule out a shared clock
    std::optional<base::TimePoint> first_;
    std::optional<Window> open_; // window of the current second
    base::TimePoint open_since_;
    std::array<Window, windows_max> closed_{}; // the newest last
    std::size_t count_ = 0;
    Fit fit_;
    base::Duration said_{}; // offset that estimate() gives
    base::TimePoint said_at_;
    std::uint32_t jumps_ = 0;
    std::uint32_t agreeing_left_ = 0;
};

} // namespace hapnet::peer
