// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/at_rest.hpp"
#include "peer/core/sync/energy_at_an_omni.hpp"

#include <glm/vec3.hpp>
#include <vector>

namespace hapnet::peer {

struct WaveOptions {
    double impedance_ns_per_m = 10.0; // equal to the drag of the paper's cube

    friend bool operator==(const WaveOptions&, const WaveOptions&) = default;
};
constexpr auto fields_of(base::Tag<WaveOptions> /*struct*/)
{
    return base::fields("wave",
                        base::field("impedance", &WaveOptions::impedance_ns_per_m,
                                    base::Quantity{base::damping_kind, 0.1, 1000.0},
                                    "b, of the channel between two copies; over a delay D it "
                                    "renders a stiffness of b/D"));
}

/// Joins the copies of the body, pair by pair, by a channel of waves (Niemeyer and Slotine 1991,
/// 2004). The channel is passive for any delay. A wave acts once, for one tick. In a tick without a
/// wave, the channel is a damper, so that loss and jitter weaken it but bring in no energy (Hirche
/// and Buss). Messages do not contain the waves: a receiver computes them from the sender's
/// velocity and from the waves that the sender had received, which the echo shows. So both sides
/// must use this algorithm, with the same impedance. docs/design/algorithms.md has the equations.
class Wave {
public:
    /// The energy that the algorithm may bring into a hand at an Omni.
    static constexpr auto energy_limits = energy_at_an_omni(1.2);

    Wave() : Wave(WaveOptions{}) {}
    explicit Wave(const WaveOptions& options);

    /// Allocates the memory for this number of other peers.
    void prepare(std::size_t others);
    void hear(const ReceivedState& received);
    [[nodiscard]] Outcome tick(scene::World& world, const Situation& situation);
    void forget(std::size_t of = 0);

    [[nodiscard]] const WaveOptions& options() const { return options_; }

private:
    struct Sent {
        base::TimePoint at;
        glm::dvec3 wave{0.0};
    };
    /// The channel to the copy of one of the others.
    struct Channel {
        bool is_open = false;               // the other peer has been heard
        std::optional<glm::dvec3> incoming; // wave that acts in the next tick
        std::vector<Sent> ring;             // sent waves, one per tick
        std::uint64_t sent = 0;             // number of waves sent so far
        std::uint64_t oldest_of_use = 0;    // oldest wave that an echo may refer to
    };
    [[nodiscard]] glm::dvec3 sent_at(Channel& channel, base::TimePoint at) const;
    /// Returns the wave that leaves a copy with this velocity and incoming wave. It is limited to
    /// the wave of twice the greatest force of a contact. Both ends compute it in the same way.
    [[nodiscard]] glm::dvec3 outgoing(const glm::dvec3& velocity, const glm::dvec3& incoming) const;

    static constexpr std::size_t ring_max = 4096; // ticks

    WaveOptions options_;
    double root_;     // square root of twice the impedance
    double wave_max_; // greatest wave, in sqrt(W)
    std::vector<Channel> channels_;
    AtRest at_rest_;
};

} // namespace hapnet::peer
