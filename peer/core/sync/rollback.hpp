// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/energy_at_an_omni.hpp"
#include "peer/core/sync/hand_history.hpp"
#include "peer/core/sync/proxy_hand.hpp"
#include "proto/base/ensure.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

namespace hapnet::peer {

struct RollbackOptions {
    HandDynamics hand{.friction_n = 0.26}; // if the hello gives no values; friction of an Omni
    double velocity_filter = 0.15;
    base::Duration velocity_filter_min{std::chrono::milliseconds{20}};
    double believed_above_m_per_s = 0.015;
    base::Duration memory{std::chrono::seconds{2}};
    base::Duration ahead_max{std::chrono::milliseconds{250}};
    base::Duration smoothing{std::chrono::milliseconds{50}};
    base::Duration patience{std::chrono::milliseconds{60}};
    base::Duration silence_max{std::chrono::milliseconds{300}};

    friend bool operator==(const RollbackOptions&, const RollbackOptions&) = default;
};
constexpr auto fields_of(base::Tag<RollbackOptions> /*struct*/)
{
    using Options = RollbackOptions;
    return base::fields(
        "rollback", base::part(&Options::hand),
        base::field("velocity_filter", &Options::velocity_filter, base::Number{0.0, 10.0},
                    "time constant of the intention's velocity, as a share of its age"),
        base::field("velocity_filter_min", &Options::velocity_filter_min, parameter_time,
                    "the least time constant of the intention's velocity"),
        base::field("believed_above", &Options::believed_above_m_per_s,
                    base::Quantity{base::speed_kind, 0.0, 10.0},
                    "a hand that is slower is not projected"),
        base::field("memory", &Options::memory, parameter_time, "over what time eta is learnt"),
        base::field("ahead_max", &Options::ahead_max, parameter_time,
                    "the farthest that an intention is projected"),
        base::field("smoothing", &Options::smoothing, parameter_time,
                    "time constant with which a corrected prediction takes the old one's place"),
        base::field("patience", &Options::patience, parameter_time,
                    "so long the past waits for a message that others have overtaken"),
        base::field("silence_max", &Options::silence_max, parameter_time,
                    "so long the past waits for a silent peer"));
}

/// Each copy has two worlds (rollback and resimulation, as in games). The world of the past is
/// moved by the hands as they were. The world of the present is computed again from the past with
/// every message; in it, a hand that touched continues according to its intention. If no message is
/// missing, all pasts are equal to the bit. The energy of the present is not bounded: this
/// algorithm is a reference to compare the others with. docs/design/algorithms.md has the
/// equations.
class Rollback {
public:
    /// The energy that the algorithm may bring into a hand at an Omni.
    static constexpr auto energy_limits = energy_at_an_omni(0.25);

    Rollback() : Rollback(RollbackOptions{}) {}
    explicit Rollback(const RollbackOptions& options) : options_{options} {}

    /// Allocates the memory for this number of other peers and for two copies of the world.
    void prepare(std::size_t others, const scene::World& world);
    void hear(const ReceivedState& received);
    [[nodiscard]] Outcome tick(scene::World& world, const Situation& situation);
    void forget(std::size_t of = 0);

    [[nodiscard]] const RollbackOptions& options() const { return options_; }
    /// Returns the tick of the session that the past has reached; -1: none.
    [[nodiscard]] std::int64_t confirmed() const { return confirmed_; }
    /// Returns the world of the past. Ensures that prepare() was called.
    [[nodiscard]] const scene::World& past() const
    {
        base::ensure(past_.has_value());
        return *past_;
    }

    /// The time for which the past waits for a peer that has never been heard.
    static constexpr base::Duration waits_for{std::chrono::seconds{1}};
    /// The greatest number of ticks that are computed again.
    static constexpr std::int64_t resimulated_max = 1000;
    /// The least time for which a body must rest before its places are compared.
    static constexpr base::Duration rests_for{std::chrono::milliseconds{100}};

private:
    struct RemoteHand {
        explicit RemoteHand(const ProxyHandOptions& options) : learnt{options} {}

        HeardHand heard;
        ProxyHand learnt;        // model of the owner's intention
        std::int64_t whole = -1; // last tick up to which no sample is missing
        bool touches = false;    // it touches a body in its newest message
        HandMotion motion{};     // motion of its model in the present world
    };

    void begin(const scene::World& world, std::int64_t now);
    void set_past_hands(scene::World& world, const Situation& situation, std::int64_t tick) const;
    void set_present_hands(scene::World& world, const Situation& situation, std::int64_t tick);
    void move_models(const scene::World& world, const Situation& situation, std::int64_t tick);
    [[nodiscard]] static bool is_modelled(const RemoteHand& hand, std::int64_t tick);
    [[nodiscard]] std::int64_t known_until(const Situation& situation, std::int64_t now);
    [[nodiscard]] bool confirm(const Situation& situation, std::int64_t now);
    void step_present(const Situation& situation, std::int64_t tick);
    void predict(const Situation& situation, std::int64_t now);
    [[nodiscard]] Outcome feel(scene::World& world, const Situation& situation, std::int64_t now);
    void smooth(const glm::dvec3& jump, double tick_s);
    base::Displacement rest(const Situation& situation, const Outcome& outcome);
    void show(scene::World& world, const Situation& situation);

    RollbackOptions options_;
    std::vector<RemoteHand> hands_;
    HandHistory own_;
    SessionTicks ticks_;
    std::optional<scene::World> past_;
    std::optional<scene::World> present_;
    std::int64_t confirmed_ = -1;
    bool has_news_ = false;
    glm::dvec3 offset_{0.0}; // from the body in the present world to where it is shown
    glm::dvec3 offset_speed_{0.0};
    std::optional<base::Position> shown_;
    RestAgreement rest_;
};

} // namespace hapnet::peer
