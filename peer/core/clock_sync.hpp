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
    base::TimePoint sent;         // by this peer, on its own clock
    base::TimePoint heard;        // by the remote, on its clock
    base::TimePoint answered;     // by the remote, on its clock
    base::TimePoint answer_heard; // by this peer, on its own clock
};

/// The relation of the remote's clock to this peer's clock.
struct ClockEstimate {
    base::Duration offset{};      // the remote's clock minus this peer's, now
    base::Duration uncertainty{}; // half the least round trip, which bounds what asymmetry can
                                  // hide, and what the fit may err by
    double skew_ppm = 0.0;        // how much faster the remote's clock runs
    base::Duration round_trip{};  // the least one where the clocks are one, else 0
};

/// Estimates the remote's clock from echoes (NTP's offset, RFC 5905 section 8). A queueing delay
/// lengthens a round trip and falsifies its offset. So for each second only the sample with the
/// shortest round trip is kept, for the last 64 seconds, and only samples about as short as the
/// shortest are used. A straight line through them, in which shorter round trips have more weight,
/// gives offset and skew.
///
/// The estimate settles in the first two seconds. After that it never steps: it changes by at most
/// 500 us a second. After a jump of a clock (of a machine that slept, or a virtual one that was
/// moved), the estimate is in doubt from the first sample on. The jump is recognised after eight
/// seconds, and then the estimate steps once.
///
/// Two peers that report the same boot share a clock, and two that report synchronised clocks have
/// one up to a stated error. Then their offset is zero. This is assumed from the first sample that
/// is consistent with it. Inconsistent samples end the assumption: at first a single one does;
/// later it takes eight in a row, as one may be damaged. A round trip whose half is below the
/// stated error ends it, too, because echoes are then more exact.
class ClockSync {
public:
    static constexpr base::Duration window{std::chrono::seconds{1}};
    static constexpr std::size_t windows_max = 64;
    static constexpr base::Duration settles_within{std::chrono::seconds{2}};
    static constexpr double slew_max = 500e-6;
    static constexpr double skew_max_ppm = 200.0; // crystals differ by about a tenth of this
    static constexpr std::size_t windows_for_skew = 8;
    static constexpr std::size_t windows_for_jump = 8;
    /// The least jump of a clock that is recognised, in addition to half the round trip, which is
    /// the most that queues and asymmetry can shift an offset.
    static constexpr base::Duration jump_least{std::chrono::milliseconds{50}};
    static constexpr std::uint32_t samples_needed = 8; // consecutive samples that must agree

    /// Adds a sample. Ignores it if the round trip is negative or the offset exceeds ten years.
    void add(const ClockSample& sample);
    /// Notes that both peers report the same clock, with two readings of it at most `within` apart,
    /// so their offset is zero unless samples rule that out.
    void set_same_clock(base::Duration within)
    {
        same_clock_ = SameClock::claimed;
        same_within_ = within;
    }

    /// Returns nullopt before the first sample.
    [[nodiscard]] std::optional<ClockEstimate> estimate() const;
    /// Returns the number of jumps of the remote's clock.
    [[nodiscard]] std::uint32_t jumps() const { return jumps_; }
    /// True from a sample that no queue explains, or from a jump, until enough samples agree. Do
    /// not use the estimate for prediction meanwhile.
    [[nodiscard]] bool is_in_doubt() const { return agreeing_left_ > 0; }
    /// Returns the estimate for prediction; nullopt before the first sample and while in doubt.
    [[nodiscard]] std::optional<ClockEstimate> trusted() const
    {
        return is_in_doubt() ? std::nullopt : estimate();
    }

    void reset() { *this = ClockSync{}; }

private:
    struct Window {
        base::TimePoint at; // arrival of its sample
        base::Duration offset;
        base::Duration round_trip;
    };
    /// The straight line through the windows.
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

    /// The state of knowledge about a shared clock: no shared clock, reported by both peers, or
    /// confirmed by a sample.
    enum class SameClock : std::uint8_t { no, claimed, seen };

    [[nodiscard]] bool shows_same_clock(const Window& sample);
    void close_window();
    [[nodiscard]] base::Duration unexplained(const Window& sample) const;
    void consider(const Window& sample);
    [[nodiscard]] bool has_jumped() const;
    [[nodiscard]] Fit fit(base::TimePoint now) const;
    void follow(base::TimePoint now);

    SameClock same_clock_ = SameClock::no;
    base::Duration same_within_{}; // what two readings of a shared clock may differ by
    base::Duration same_round_trip_{base::Duration::max()}; // the least while the clock is shared
    std::uint32_t ruled_out_ = 0; // consecutive samples that rule out a shared clock
    std::optional<base::TimePoint> first_;
    std::optional<Window> open_; // window of the current second
    base::TimePoint open_since_;
    std::array<Window, windows_max> closed_{}; // the newest is last
    std::size_t count_ = 0;
    Fit fit_;
    base::Duration said_{}; // offset that estimate() returns
    base::TimePoint said_at_;
    std::uint32_t jumps_ = 0;
    std::uint32_t agreeing_left_ = 0;
};

} // namespace hapnet::peer
