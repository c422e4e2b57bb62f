// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/hand/spring.hpp"
#include "scene/maths/first_root.hpp"

#include <array>

namespace hapnet::scene {

/// One spring on a body along its held normal. A slack spring does not push. It pushes again when
/// it would no longer have to pull, at whatever depth.
struct SpringContact {
    double stiffness = 0.0;
    double damping = 0.0;
    double force_max = 0.0;
    double depth = 0.0;        // > 0: overlap
    double closing = 0.0;      // rate at which the depth grows
    double acceleration = 0.0; // of the depth, without the springs' forces
    SpringPhase phase = SpringPhase::apart;

    [[nodiscard]] double unlimited_force() const { return stiffness * depth + damping * closing; }
    [[nodiscard]] double force() const;
    /// Returns the phase that follows from the depth and the closing speed.
    [[nodiscard]] SpringPhase phase_due() const;
};

/// The response of the depths of up to two springs to the springs' forces: 1/kg.
struct Coupling {
    std::array<double, 2> own{};
    double mutual = 0.0;
};

/// The springs' impulses up to a moment.
template <std::size_t count>
struct PhaseImpulses {
    double time = 0.0;
    std::array<double, count> impulse{}; // impulse of each force, N s
    std::array<double, count> moment{};  // the integral of the impulse, N s^2
};

/// One or two springs on one body with held normals and arms. The motion is in closed form until
/// one of them begins or ceases to act, or reaches its greatest force. One spring is an oscillator
/// with the body's effective mass along its normal. Two springs are two oscillators (the modes of
/// their stiffness), provided that the ratio of damping to stiffness is the same for both.
template <std::size_t count>
class ContactModes {
public:
    /// `time` is the longest time that advance() may simulate.
    ContactModes(std::array<SpringContact, count>& contacts, const Coupling& coupling, double time);
    ContactModes(const ContactModes&) = delete; // the trajectories point to the propagators
    ContactModes& operator=(const ContactModes&) = delete;
    ~ContactModes() = default;

    /// True if there is a closed form.
    [[nodiscard]] bool is_solved() const { return is_solved_; }
    /// Advances depths, speeds and phases to the first moment at which a phase ends, or by the
    /// whole time.
    [[nodiscard]] PhaseImpulses<count> advance();

private:
    /// The end of a phase.
    struct End {
        double time = 0.0;
        std::size_t contact = count; // count: no contact
        SpringPhase then = SpringPhase::apart;
    };

    void solve_parabolas();
    void solve_one(std::size_t pressing);
    void solve_both();
    [[nodiscard]] WatchedQuantity watch(std::size_t i, double level,
                                        const std::array<double, 2>& weights);
    /// True if a bound of the rate at which the force changes rules out that the phase ends.
    [[nodiscard]] bool keeps_phase(std::size_t i) const;
    void find_end(End& end, std::size_t i);
    void add_work(PhaseImpulses<count>& impulses) const;

    std::array<SpringContact, count>& contacts_;
    Coupling coupling_;
    double time_;
    bool is_solved_ = true;

    // Each depth is its start plus the weighted sum of two trajectories.
    std::array<Propagator, count> propagators_;
    Trajectories trajectories_;
    std::array<std::array<double, count>, count> share_{}; // [i][j]: trajectory j in depth i
    // The modes of the springs that press: one alone, or two.
    std::size_t modes_ = 0;
    std::array<double, count> start_{};                     // depth of each mode at the start
    std::array<std::array<double, count>, count> weight_{}; // [i][j]: weight of mode j in force i
    double lag_ = 0.0;                                      // damping over stiffness
};

extern template class ContactModes<1>;
extern template class ContactModes<2>;

} // namespace hapnet::scene
