// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/at_rest.hpp"
#include "peer/core/sync/combined_remote.hpp"
#include "peer/core/sync/energy_at_an_omni.hpp"

#include <optional>

namespace hapnet::peer {

/// The paper's hybrid algorithm, without any compensation of delay. With the default options:
/// - This hand touches the body at some time of the tick: the body moves by this copy's own
///   dynamics. The force on it is the sum of the local contact force and the remote one as last
///   received (the stronger decides the direction).
/// - Only the other hand touches: the body is at the position last received from the remote. It is
///   absolute, so that no error accumulates.
/// - No hand touches: the body coasts. After 200 ms, the copy with the higher id blends to the pose
///   of the lower id within 100 ms, so that the copies agree again.
class BaseAlgorithm {
public:
    /// The energy that the algorithm may bring into a hand at an Omni.
    static constexpr auto energy_limits = energy_at_an_omni(0.46);

    BaseAlgorithm() = default;
    explicit BaseAlgorithm(const BaseOptions& options) : options_{options} {}

    /// Takes every state of the session, in the order of arrival.
    void hear(const ReceivedState& received);
    /// Advances the world by one tick.
    [[nodiscard]] Outcome tick(scene::World& world, const Situation& situation);
    /// Advances the world by one tick, with `remote` as the state of the other hands.
    [[nodiscard]] Outcome tick(scene::World& world, const Situation& situation,
                               const CombinedRemote& remote);
    /// Forgets the remote's run, which has ended. Its next state is from a new run.
    void forget();

    [[nodiscard]] const BaseOptions& options() const { return options_; }

private:
    [[nodiscard]] bool remote_leads(const Situation& situation, const CombinedRemote& remote);
    [[nodiscard]] base::Displacement remote_displacement(const CombinedRemote& remote);
    void follow(scene::World& world, const Situation& situation, const CombinedRemote& remote);
    void settle(scene::World& world, const Situation& situation, const CombinedRemote& remote);
    void put_there(scene::World& world, scene::BodyId body, CombinedRemote::Pose there) const;

    struct Lead {
        bool is_remote = false;
        base::TimePoint since;
    };
    BaseOptions options_;
    AtRest at_rest_;
    std::optional<Lead> lead_;                    // which hand leads, and since when
    double own_force_n_ = 0.0;                    // force of this hand on the body in the last tick
    std::optional<base::Position> remote_before_; // the remote's body a tick ago
    base::Displacement increments_;               // sum of the increments heard since the last tick
    base::Displacement remote_moved_;             // remote displacement since the last tick
    base::Position place_before_;                 // place of the body before this tick
};

} // namespace hapnet::peer
