// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/clock_sync.hpp"
#include "peer/core/remote.hpp"
#include "scene/world.hpp"

#include <cstdint>
#include <optional>
#include <span>

namespace hapnet::peer {

class SharedPoses;

/// The index of this peer's hand in its copy of the scene. Most algorithms represent other hands
/// only by their forces: see has_hands_of_others().
inline constexpr std::uint32_t own_hand = 0;

/// The remote's clock, if it is known. It is computed only on request, because most algorithms
/// never use it.
class RemoteClock {
public:
    RemoteClock() = default; // the clock is unknown
    /// Uses ClockSync::trusted().
    explicit RemoteClock(const ClockSync& sync) : sync_{&sync} {}
    /// Uses an estimate that was computed before.
    explicit RemoteClock(const std::optional<ClockEstimate>& estimate) : estimate_{estimate} {}

    [[nodiscard]] std::optional<ClockEstimate> estimate() const
    {
        return sync_ != nullptr ? sync_->trusted() : estimate_;
    }

private:
    const ClockSync* sync_ = nullptr;
    std::optional<ClockEstimate> estimate_;
};

/// A state of the remote that has arrived. An algorithm receives it once and at once, so several
/// may arrive between two ticks.
struct ReceivedState {
    const wire::State& state;
    base::TimePoint arrived;
    /// The number of the sender's tick that the state describes, from 1 in the session: see
    /// TickCount.
    std::uint32_t tick_number = 0;
    /// The interval between consecutive messages of the sender, including lost ones. It is a tick
    /// if each tick has a message.
    base::Duration span{std::chrono::milliseconds{1}};
    /// False if a newer state was taken before, or if this is a duplicate. Most algorithms then use
    /// it only to measure the network's delay.
    bool taken = true;
    RemoteClock clock{};
    base::Duration tick{std::chrono::milliseconds{1}};
    double force_max_n = scene::force_max_n; // greatest force of a contact in this scene
    std::size_t from = 0;                    // index of the sender among the others
    wire::HandModel hand{};                  // the sender's hand, as its hello describes it
    base::TimePoint start{};                 // session start on this peer's clock
};

/// The input of one tick of an algorithm, except this peer's hand, which is in the world.
struct Situation {
    base::TimePoint now;
    scene::BodyId body = 0;         // the shared body, or the first of several
    std::span<const Remote> others; // at least one, in the order of their ids
    const Remote& remote;           // that of others with the lowest id that is heard
    /// True if a peer with a lower id is heard. This peer then takes over its pose of a body at
    /// rest.
    bool yields = false;
    // The next three members have the meaning that they have in ReceivedState. The clock is that of
    // `remote`.
    base::Duration tick{std::chrono::milliseconds{1}};
    RemoteClock clock{};
    double force_max_n = scene::force_max_n;
    std::size_t lower_ids = 0; // number of the others with a lower id than this peer
    const scene::HandDescription* hands = nullptr; // nullptr: hands without friction
    base::TimePoint start{};                       // session start on this peer's clock
    std::int64_t number = 0;      // number of ticks that this peer has played before in the session
    SharedPoses* poses = nullptr; // nullptr: one shared body that does not turn
};

/// The result of one tick of an algorithm.
struct Outcome {
    scene::HandTouch touched;     // touch of this peer's hand
    base::Force on_hand;          // force for this peer's hand to feel
    base::Duration late{};        // delay of on_hand that the algorithm adds
    bool remote_touching = false; // whether the remote hand counts as touching
    base::Force remote_force;     // force that the remote hand counts as exerting on the body
    std::optional<base::Position> remote_hip; // place of the remote hand, for display only
};

/// Returns the delay of a message from the stamps of both sides; nullopt while the clocks are
/// unknown, or if it is impossible for any network (`believable_delay`). If the two directions have
/// different delays, the result is wrong by half the difference, which cannot be detected here (RFC
/// 5905).
[[nodiscard]] std::optional<base::Duration> one_way_delay(const ReceivedState& received);
inline constexpr base::Duration believable_delay{std::chrono::seconds{5}};

} // namespace hapnet::peer
