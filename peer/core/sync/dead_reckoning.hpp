// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/base_algorithm.hpp"
#include "peer/core/sync/energy_at_an_omni.hpp"
#include "peer/core/sync/one_way_delay.hpp"

#include <optional>

namespace hapnet::peer {

/// The time between two consecutive states that the velocity is computed with. Nominal: one tick,
/// even if messages between them were lost (the paper). Otherwise it is the time between their
/// arrivals, or between their stamps.
enum class VelocityRule : std::uint8_t { nominal, arrival, sender };
constexpr auto names_of(base::Tag<VelocityRule> /*enum*/)
{
    return base::names("nominal", "arrival", "sender");
}

/// The assumed age of a body's position when its message arrives. None: its age counts as zero.
/// Otherwise it is the path's mean one-way delay, which varies slowly; the age by the stamp of this
/// message; or a fixed time.
struct Horizon {
    enum class Law : std::uint8_t { none, one_way, packet_age, fixed };

    Law law = Law::one_way;
    base::Duration fixed{}; // horizon of Law::fixed

    friend bool operator==(const Horizon&, const Horizon&) = default;
};
/// The names of the laws. A fixed horizon has no name and is written as its time.
inline constexpr auto horizon_names = base::names("none", "one-way", "packet-age");

/// The format of a horizon: "one-way", or a time.
struct HorizonFormat {
    void read(const base::Node& node, Horizon& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(const Horizon& horizon) const;
    [[nodiscard]] std::string describe() const;
};

struct DeadReckoningOptions {
    VelocityRule velocity = VelocityRule::nominal;
    Horizon horizon{};
    std::uint32_t horizon_memory = 500; // messages in the mean delay
    /// The time in which a new prediction replaces the last one (projective velocity blending; E.
    /// Murphy: Believable dead reckoning for networked games, 2011); nullopt: at once.
    std::optional<base::Duration> blend_within{};
    /// The longest time of a prediction, measured from the sending of a message; nullopt: no limit.
    std::optional<base::Duration> ahead_max{};
    /// The limit of the estimated velocity. A hand reaches 0.3 m/s in the paper's task, which the
    /// nominal rule multiplies by the number of ticks between two messages: 60 at 80 % loss.
    double speed_max_m_per_s = 100.0;
    double lead_max_m = 1.0; // greatest distance of a prediction from the received place
    /// The gap between two messages, by the sender's stamps, above which no velocity is computed.
    base::Duration gap_max{std::chrono::milliseconds{250}};
    BaseOptions base{};

    friend bool operator==(const DeadReckoningOptions&, const DeadReckoningOptions&) = default;
};
constexpr auto fields_of(base::Tag<DeadReckoningOptions> /*struct*/)
{
    using Options = DeadReckoningOptions;
    return base::fields(
        "dead-reckoning",
        base::field("velocity", &Options::velocity,
                    "dt: one tick regardless of losses in between, the difference of the arrivals, "
                    "or of the sender's stamps"),
        base::field("horizon", &Options::horizon, HorizonFormat{},
                    "H: zero, the path's mean delay, this message's own delay, or a time"),
        base::field("horizon_memory", &Options::horizon_memory, base::Count{1, 1'000'000},
                    "messages in the mean delay: arithmetic at first, exponential afterwards"),
        base::field("blend_within", &Options::blend_within, parameter_time,
                    "time in which a new prediction takes over from the last one (projective "
                    "velocity blending, Murphy 2011)")
            .absent_as("none"),
        base::field("ahead_max", &Options::ahead_max, parameter_time,
                    "longest prediction, counted from sending")
            .absent_as("none"),
        base::field("speed_max", &Options::speed_max_m_per_s,
                    base::Quantity{base::speed_kind, 0.0, 1000.0},
                    "limit of the estimated velocity"),
        base::field("lead_max", &Options::lead_max_m, base::Quantity{base::length_kind, 0.0, 100.0},
                    "farthest a prediction may lie from the received place"),
        base::field("gap_max", &Options::gap_max, parameter_time,
                    "gap between two messages, by the sender's stamps; across a longer one v is 0"),
        base::part(&Options::base));
}

/// The paper's dead reckoning: the base algorithm with a first-order prediction of the remote's
/// body from its last two positions,
///     x^ = x_k + v (t - t_arrived,k + H),  v = (x_k - x_k-1) / dt.
/// The prediction replaces the received position wherever that is used: while only the other hand
/// touches, and as the place where a body at rest settles. Forces and velocities are used as
/// received.
class DeadReckoning {
public:
    /// The energy that the algorithm may bring into a hand at an Omni.
    static constexpr auto energy_limits = energy_at_an_omni(1.1);

    DeadReckoning() : DeadReckoning(DeadReckoningOptions{}) {}
    explicit DeadReckoning(const DeadReckoningOptions& options);

    void hear(const ReceivedState& received);
    [[nodiscard]] Outcome tick(scene::World& world, const Situation& situation);
    void forget();

    [[nodiscard]] const DeadReckoningOptions& options() const { return options_; }
    /// Returns the position of the remote's body, extrapolated to `now`; nullopt before its first
    /// state.
    [[nodiscard]] std::optional<base::Position> predicted(base::TimePoint now) const;
    /// Returns H for the newest message.
    [[nodiscard]] base::Duration horizon() const;

private:
    /// A position from a message, with the times of that message.
    struct Fix {
        base::Position place;
        base::TimePoint arrived;
        base::TimePoint sent;
        base::Duration age{}; // age at arrival; 0 while the clocks are unknown
    };
    /// A prediction, which is kept while a newer one replaces it.
    struct Course {
        base::Position from;
        base::Velocity velocity;
        base::TimePoint start;
    };

    [[nodiscard]] base::Velocity velocity_to(const Fix& next, base::Duration span) const;
    [[nodiscard]] base::Position blended(base::Position target, const scene::World& world,
                                         const Situation& situation);

    DeadReckoningOptions options_;
    BaseAlgorithm base_;
    OneWayDelay delay_;
    bool is_clock_known_ = false; // the clock was known when the newest message arrived
    std::optional<Fix> newest_;
    base::Velocity velocity_;
    std::optional<Course> course_; // replaced prediction, while the body follows with a blend
    Course shown_;                 // blended prediction of the last tick
    bool has_news_ = false;        // a message was used since the last tick
};

} // namespace hapnet::peer
