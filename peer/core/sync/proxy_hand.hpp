// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/finger_friction.hpp"
#include "peer/core/intention.hpp"
#include "peer/core/sync/base_options.hpp"
#include "peer/core/sync/recent_age.hpp"
#include "peer/core/sync/situation.hpp"
#include "proto/base/describe.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

namespace hapnet::peer {

/// The options of a proxy, which represents another hand. docs/design/remote-proxy.md has the
/// equations.
struct ProxyHandOptions {
    HandDynamics hand{}; // used if the hello gives no values
    base::Duration anchor_filter{std::chrono::milliseconds{20}};
    double anchor_speed_m_per_s = 0.4;
    /// The velocity of the intention is smoothed over this share of its age, because the age
    /// multiplies its noise, and over at least velocity_filter_min.
    double velocity_filter = 0.15;
    base::Duration velocity_filter_min{std::chrono::milliseconds{20}}; // shortest smoothing time
    /// The speed of an intention below which its extrapolation gets less weight. A resting hand
    /// wanders at 5 to 7 mm/s, a carrying one moves at 67 mm/s.
    double believed_above_m_per_s = 0.015;
    base::Duration memory{std::chrono::seconds{2}};
    base::Duration ahead_max{std::chrono::milliseconds{250}};
    double unsure_by_m = 0.003;
    double soft_by_m = 0.005;

    friend bool operator==(const ProxyHandOptions&, const ProxyHandOptions&) = default;
};

constexpr auto fields_of(base::Tag<HandDynamics> /*struct*/)
{
    return base::fields(
        "hand-dynamics",
        base::field("mass", &HandDynamics::mass_kg, base::Quantity{base::mass_kind, 0.02, 10.0},
                    "mass of a hand whose peer does not tell it"),
        base::field("damping", &HandDynamics::damping_ns_per_m,
                    base::Quantity{base::damping_kind, 0.0, 100.0}, "damping of such a hand"),
        base::field("stiffness", &HandDynamics::stiffness_n_per_m,
                    base::Quantity{base::stiffness_kind, 10.0, 5000.0},
                    "stiffness of such a grip, to where the hand means to be"),
        base::field("friction", &HandDynamics::friction_n,
                    base::Quantity{base::force_kind, 0.0, 10.0},
                    "friction of such a device, to be right within 0.05 N"));
}
constexpr auto fields_of(base::Tag<ProxyHandOptions> /*struct*/)
{
    using Options = ProxyHandOptions;
    constexpr base::Quantity length{base::length_kind, 1e-6, 1.0};
    constexpr base::Quantity speed{base::speed_kind, 0.0, 10.0};
    return base::fields(
        "proxy-hand", base::part(&Options::hand),
        base::field("anchor_filter", &Options::anchor_filter, parameter_time,
                    "time constant with which the anchor goes to the projected intention"),
        base::field("anchor_speed", &Options::anchor_speed_m_per_s, speed,
                    "greatest speed of the anchor"),
        base::field("velocity_filter", &Options::velocity_filter, base::Number{0.0, 10.0},
                    "time constant of the intention's velocity, as a share of its age"),
        base::field("velocity_filter_min", &Options::velocity_filter_min, parameter_time,
                    "the least time constant of the intention's velocity"),
        base::field("believed_above", &Options::believed_above_m_per_s, speed,
                    "a hand that is slower is not projected"),
        base::field("memory", &Options::memory, parameter_time,
                    "over what time eta and g are learnt"),
        base::field("ahead_max", &Options::ahead_max, parameter_time,
                    "the farthest that an intention is projected"),
        base::field("unsure_by", &Options::unsure_by_m, length,
                    "error of the projection at which half of the spring becomes a force"),
        base::field("soft_by", &Options::soft_by_m, length,
                    "length of the projection at which half of the spring becomes a force"));
}

/// The motion of a hand, which is a mass.
struct HandMotion {
    glm::dvec3 place{0.0};
    glm::dvec3 speed{0.0};

    /// Advances the motion by a short time under a constant force, with the hand's damping and
    /// friction (Karnopp 1985). Each axis is independent.
    void step(const HandDynamics& hand, double friction_n, const glm::dvec3& force, double seconds);
};
/// The number of steps in a tick. A step is short compared to the period of any hand, even with the
/// stiffest contact.
inline constexpr int hand_steps_per_tick = 4;

/// The hand of another peer in this copy of the scene: a mass with damping and friction, drawn by a
/// spring to the place where its owner intends to be at present. Two parameters are learnt. eta is
/// the degree to which the received intention is extrapolated to the present, from the success of
/// past extrapolations. g is the degree to which the hand is modelled as a spring and not as a mere
/// force, from the errors that the spring would have made.
class ProxyHand {
public:
    explicit ProxyHand(const ProxyHandOptions& options);

    /// Takes a state. Returns the work that its owner has put in since the previous one, in J. It
    /// may be negative.
    [[nodiscard]] double hear(const ReceivedState& received);
    /// Forgets its owner's run, which has ended. The work is counted from the next message on.
    void forget();

    /// Returns the age of the newest message.
    [[nodiscard]] base::Duration age(base::TimePoint now) const;
    /// Returns the largest recent age, at most 400 ms. It is forgotten within some seconds.
    [[nodiscard]] base::Duration usual_age() const { return base::from_seconds(ages_.seconds()); }
    [[nodiscard]] double eta() const { return eta_; }
    /// Returns the time at which the hand last touched a body, on this peer's clock.
    [[nodiscard]] const std::optional<base::TimePoint>& touched_at() const { return touched_at_; }
    /// Returns the time at which the newest message was sent, on this peer's clock.
    [[nodiscard]] base::TimePoint sent_at() const { return sent_at_; }
    [[nodiscard]] const HandDynamics& dynamics() const { return hand_; }
    [[nodiscard]] const glm::dvec3& intention() const { return intention_; } // as last heard
    /// Returns the smoothed velocity of the intention.
    [[nodiscard]] const glm::dvec3& intention_velocity() const { return velocity_; }

    /// The input of look(), which lets the hand appear, stay or disappear as its owner's hand does,
    /// and updates the place that it is drawn to.
    struct View {
        const Remote& other;
        const wire::BodyState* there = nullptr; // the body in the hand, from the last message
        const scene::World& world;              // this copy, with the same body
        base::TimePoint now;
        base::Duration tick{};
        bool own_hand_touches = false;
    };
    void look(const View& view);
    [[nodiscard]] bool is_there() const { return is_there_; }
    [[nodiscard]] scene::HandInput input() const;
    [[nodiscard]] base::Position place() const { return {motion_.place}; }

    [[nodiscard]] double kinetic_energy_j() const;
    /// Returns the energy of the drive, which is a spring and a steady force, at full share.
    [[nodiscard]] double drive_energy_j() const;
    /// Advances the hand by a tick against the force on it. `share` is the share of its spring and
    /// its force that the account and the freshness allow. Returns the work of that force, in J. It
    /// is negative if the hand has given energy to the copy.
    [[nodiscard]] double step(base::Force on_hand, double share, base::Duration tick);

    /// The dry friction of the finger on the body, if the scene's hands have friction.
    std::optional<FingerFriction> finger;

private:
    /// The data from a message of the owner that learning needs.
    struct Heard {
        std::uint32_t tick_number = 0;
        glm::dvec3 place{0.0};
        glm::dvec3 velocity{0.0}; // smoothed velocity of the intention
    };
    void enter(const View& view);
    void take_dynamics(const wire::HandModel& said);
    void learn(const Heard& word, std::uint32_t ticks, double tick_s, double age_s);
    [[nodiscard]] const Heard* heard_at(std::uint32_t tick_number);

    static constexpr std::size_t words_max = 1024; // messages: about a second of them
    static constexpr double trust_filter_s = 0.05;

    ProxyHandOptions options_;
    HandDynamics hand_; // dynamics of the owner's hand

    // Values from the remote's messages.
    bool has_heard_ = false;
    std::uint32_t tick_number_ = 0; // tick of the newest message
    std::uint32_t work_uj_ = 0;
    base::TimePoint sent_at_;
    std::optional<base::TimePoint> touched_at_;
    glm::dvec3 intention_{0.0};
    glm::dvec3 velocity_{0.0}; // smoothed velocity of the intention
    glm::dvec3 contact_force_{0.0};
    RecentAge ages_;
    std::vector<Heard> words_; // ring of words_max messages
    std::uint64_t heard_ = 0;  // number of messages heard so far
    std::uint64_t older_ = 0;  // index of the message where heard_at() last stopped

    // Learnt values: means of products of predicted and true motion.
    double predicted_true_ = 0.0;
    double predicted_ = 0.0;
    double true_ = 0.0;
    double eta_ = 0.0;
    double trust_ = 1.0; // g: degree to which the hand is modelled as a spring

    // The state of the hand in this copy.
    bool is_there_ = false;
    bool gripping_ = false;
    HandMotion motion_;
    glm::dvec3 anchor_{0.0};
};

} // namespace hapnet::peer
