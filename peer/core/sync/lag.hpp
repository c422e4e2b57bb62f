// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/age_quantile.hpp"
#include "peer/core/sync/base_options.hpp"
#include "peer/core/sync/energy_at_an_omni.hpp"
#include "peer/core/sync/hand_history.hpp"

#include <chrono>
#include <cmath>
#include <cstdint>
#include <vector>

namespace hapnet::peer {

struct LagOptions {
    double quantile = 0.99;
    base::Duration memory{std::chrono::seconds{5}};
    double catch_up = 0.01;
    base::Duration lag_max{std::chrono::milliseconds{800}};

    friend bool operator==(const LagOptions&, const LagOptions&) = default;
};
constexpr auto fields_of(base::Tag<LagOptions> /*struct*/)
{
    using Options = LagOptions;
    return base::fields(
        "lag",
        base::field("quantile", &Options::quantile, base::Number{0.5, 1.0},
                    "share of the messages' ages that the common lag covers"),
        base::field("memory", &Options::memory, parameter_time, "over what time ages are kept"),
        base::field("catch_up", &Options::catch_up, base::Number{0.0, 1.0},
                    "by which share time runs faster while the lag decreases"),
        base::field("lag_max", &Options::lag_max, parameter_time,
                    "the greatest lag; at most 1000 ticks count"));
}

/// Local lag (Mauve et al. 2004): every copy plays the session with such a delay that the messages
/// of all hands arrive in time, and delays its own hand equally. Each tick of the session is
/// computed once, from the hands of that tick. If no message is missing, all copies compute
/// identical bits. The hand feels its contact late, and therefore softly. docs/design/algorithms.md
/// has the equations.
class Lag {
public:
    /// The energy that the algorithm may bring into a hand at an Omni.
    static constexpr auto energy_limits = energy_at_an_omni(0.25);

    Lag() : Lag(LagOptions{}) {}
    explicit Lag(const LagOptions& options) : options_{options} {}

    /// Allocates the memory for this number of other peers.
    void prepare(std::size_t others) { hands_.resize(others); }
    void hear(const ReceivedState& received);
    [[nodiscard]] Outcome tick(scene::World& world, const Situation& situation);
    void forget(std::size_t of = 0);

    [[nodiscard]] const LagOptions& options() const { return options_; }
    /// Returns the lag in ticks.
    [[nodiscard]] double lag() const { return lag_; }
    /// Returns the tick of the session that this copy has played last; -1: none.
    [[nodiscard]] std::int64_t played() const { return played_; }

    /// The time for which the copy waits for a peer that has never been heard.
    static constexpr base::Duration waits_for{std::chrono::seconds{1}};
    /// The greatest number of ticks of the session that one tick plays.
    static constexpr int together_max = 2;

private:
    struct RemoteHand {
        HeardHand heard;
        AgeQuantile ages;       // ages of its newest message at this peer
        AgeQuantile ages_there; // ages of this peer's newest message at the other peer
    };

    void note_ages(const Situation& situation, std::int64_t now);
    void follow(const Situation& situation);
    [[nodiscard]] bool is_ready(const Situation& situation) const;
    void play(scene::World& world, const Situation& situation);
    void rest(const Situation& situation);
    [[nodiscard]] std::int64_t lag_ticks() const
    {
        return static_cast<std::int64_t>(std::ceil(lag_));
    }
    [[nodiscard]] Outcome outcome_of(scene::World& world, const Situation& situation,
                                     std::int64_t now);

    LagOptions options_;
    std::vector<RemoteHand> hands_;
    HandHistory own_;
    SessionTicks ticks_;
    double lag_ = 0.0; // ticks
    std::int64_t played_ = -1;
    std::optional<std::int64_t> first_; // session number of this peer's first tick
    bool has_begun_ = false;
    RestAgreement rest_;
    base::Displacement way_a_tick_; // step per tick toward the other copy at rest
    std::int64_t way_ticks_ = 0;    // ticks left until the body has arrived
};

} // namespace hapnet::peer
