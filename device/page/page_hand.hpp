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

/// Carries wishes to the haptic loop; nullopt: the person releases the hand.
using HandWishes = TripleBuffer<std::optional<HandWish>>;

/// The largest absolute coordinate that a page may request, m. The live page applies the same
/// limit.
inline constexpr double page_reach_m = 0.25;

/// Returns the position that a page requests. Returns an error for a coordinate that is not a
/// number or out of reach.
[[nodiscard]] base::Result<base::Position> parse_page_place(double x, double y, double z);

/// A simulated hand that a person moves on a page. It moves to the requested position. The person
/// sees the force and does not feel it. Wishes arrive a few times in a tenth of a second. Between
/// wishes the hand moves at constant speed, at most speed_max_m_per_s. Times are those of the loop:
/// a wish counts from the tick that takes it. The hand is released, like a stylus in its holder,
/// before a session has a start, when the person releases it, and when no wish has arrived for
/// lets_go_after.
class PageHand final : public Device {
public:
    static constexpr base::Duration lets_go_after{std::chrono::milliseconds{250}};
    static constexpr double speed_max_m_per_s = 1.0;
    /// The longest time that the hand takes from one position to the next.
    static constexpr base::Duration goes_for_max{std::chrono::milliseconds{50}};
    /// The greatest time step by which the hand moves, even after a longer stall of the loop.
    static constexpr base::Duration step_max{std::chrono::milliseconds{20}};
    /// Position of the hand until a person moves it, m: left of the paper's cube.
    static constexpr glm::dvec3 rest_m{-0.06, 0.0, 0.0};

    explicit PageHand(std::shared_ptr<HandWishes> wishes);

    [[nodiscard]] const Identity& identity() const override { return identity_; }
    [[nodiscard]] const Capabilities& capabilities() const override { return capabilities_; }
    [[nodiscard]] Sample read(base::TimePoint now) override;
    /// Does nothing: the page draws the force, and this device has no motors.
    void apply(const GovernedForce& /*force*/) override {}
    void halt() noexcept override {} // it has no motors
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
    // Time of arrival at the goal, unless the goal is too far
    base::TimePoint arrives_{};
    std::optional<base::TimePoint> heard_; // time of the newest wish; nullopt: the hand is released
    std::optional<base::TimePoint> last_;  // time of the last read()
};

} // namespace hapnet::device
