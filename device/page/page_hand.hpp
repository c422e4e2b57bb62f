// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "device/replay/given_hand.hpp"
#include "device/triple_buffer.hpp"
#include "proto/base/result.hpp"

#include <chrono>
#include <memory>
#include <optional>

namespace hapnet::device {

/// A visitor's request for the hand of the page.
struct HandWish {
    base::Position place;
    bool grips = false; // the hand grips what is within its reach

    friend bool operator==(const HandWish&, const HandWish&) = default;
};

/// Carries wishes to the haptic loop; nullopt: the person lets the hand go.
using HandWishes = TripleBuffer<std::optional<HandWish>>;

/// Largest absolute coordinate that a page may ask for, m. The live page keeps to the same limit.
inline constexpr double page_reach_m = 0.25;

/// The place that a page asks for. An error for a coordinate that is no number or out of reach.
[[nodiscard]] base::Result<base::Position> parse_page_place(double x, double y, double z);

/// A simulated hand that a person moves on a page: it goes where it is told. The person who moves
/// it sees the force and does not feel it. Wishes come a few times in a tenth of a second; in
/// between the hand goes evenly, at most as fast as speed_max_m_per_s. Times are those of the loop:
/// a wish counts from the tick that takes it. The hand is let go, as a stylus in its holder, before
/// a session has a start, when the person lets it go, and when nothing has come for lets_go_after.
class PageHand final : public Device {
public:
    static constexpr base::Duration lets_go_after{std::chrono::milliseconds{250}};
    static constexpr double speed_max_m_per_s = 1.0;
    /// Longest time that the hand takes from one place to the next.
    static constexpr base::Duration goes_for_max{std::chrono::milliseconds{50}};
    /// A loop that stood still for longer moves the hand no farther than in this time.
    static constexpr base::Duration step_max{std::chrono::milliseconds{20}};
    /// Position of the hand until a person moves it, m: left of the paper's cube.
    static constexpr glm::dvec3 rest_m{-0.06, 0.0, 0.0};

    explicit PageHand(std::shared_ptr<HandWishes> wishes);

    [[nodiscard]] const Identity& identity() const override { return identity_; }
    [[nodiscard]] const Capabilities& capabilities() const override { return capabilities_; }
    [[nodiscard]] Sample read(base::TimePoint now) override;
    void apply(const GovernedForce& /*force*/) override {} // drawn by the page, not felt
    void halt() noexcept override {}                       // it has no motors
    void on_cue(const Cue& /*cue*/) override { has_start_ = true; }

private:
    void hear(const std::optional<HandWish>& wish, base::TimePoint now);
    void go(base::TimePoint now);

    std::shared_ptr<HandWishes> wishes_;
    Identity identity_;
    Capabilities capabilities_ = GivenHand::capabilities();
    GivenHand hand_;
    bool has_start_ = false;
    base::Position hip_{rest_m};
    base::Position goal_{rest_m};
    bool grips_ = false;
    base::TimePoint arrives_{};            // time of arrival at the goal, unless it is too far
    std::optional<base::TimePoint> heard_; // time of the newest wish; nullopt: the hand is let go
    std::optional<base::TimePoint> last_;  // time of the last read()
};

} // namespace hapnet::device
