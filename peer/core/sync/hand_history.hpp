// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/rest_agreement.hpp"
#include "peer/core/sync/session_ticks.hpp"
#include "peer/core/sync/situation.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace hapnet::peer {

/// A hand at a tick of the session, as a message has it: of four bytes a coordinate. So who sends
/// it and who receives it put the same bits into their copies.
struct HandSample {
    glm::dvec3 place{0.0};
    glm::dvec3 velocity{0.0};
    bool present = false;
    bool gripping = false;

    [[nodiscard]] static HandSample of(const scene::HandInput& input);
    /// Its `holding` is taken to say that the hand grips: see says_grip(). A hand without a usable
    /// sample is said to be at the origin, at rest.
    [[nodiscard]] static HandSample of(const wire::State& state);
    [[nodiscard]] scene::HandInput input() const;
};

/// Where a hand was, tick by tick, as far as it is known: the last second of it. Takes memory when
/// it is made, and none later.
class HandHistory {
public:
    static constexpr std::int64_t ticks_max = 1024;

    HandHistory() : entries_(static_cast<std::size_t>(ticks_max)) {}

    /// Returns false when the sample is already known, or too old to be kept.
    bool add(std::int64_t tick, const HandSample& sample);
    void clear();

    [[nodiscard]] bool is_empty() const { return newest_ == none; }
    [[nodiscard]] std::int64_t newest() const { return newest_; }
    [[nodiscard]] bool knows(std::int64_t tick) const;
    /// Returns the hand at a tick. A missing sample between two known ones lies on the cubic that
    /// has the places and velocities of both (Hermite). After the newest sample the hand stays
    /// there at rest. Before the first one it is not present. `length`: the length of a tick.
    [[nodiscard]] HandSample at(std::int64_t tick, base::Duration length) const;

private:
    static constexpr std::int64_t none = -1;
    struct Entry {
        std::int64_t tick = none;
        HandSample sample;
    };
    [[nodiscard]] const Entry& entry(std::int64_t tick) const
    {
        return entries_[static_cast<std::size_t>(tick % ticks_max)];
    }
    [[nodiscard]] HandSample between(std::int64_t tick, double tick_s) const;

    std::vector<Entry> entries_; // ring: a tick is at index tick % ticks_max
    std::int64_t newest_ = none;
};

/// Says to the others, by what the message has as `holding`, whether this hand grips: they find out
/// themselves whether it holds anything. A message can say so only of a hand that touches: one that
/// grips is said to.
inline void says_grip(scene::HandTouch& touched, const HandSample& own)
{
    touched.holding = own.present && own.gripping;
    touched.touching = touched.touching || touched.holding;
}

/// The hand of another peer, by ticks of the session, and what its newest message tells of its
/// copy.
struct HeardHand {
    HandHistory history;
    SessionTicks ticks;
    /// The body as the peer last told it. `knows` covers only this peer's hand.
    std::optional<RestAgreement::Word> told;

    /// The tick of which a message tells; nullopt while the clocks are unknown, or when that is
    /// still to come.
    [[nodiscard]] std::optional<std::int64_t> hear(const ReceivedState& received);
    void forget();
};

/// The tick of this peer's newest message that the sender of that one had; nullopt: none of the
/// session.
[[nodiscard]] std::optional<std::int64_t> answered_tick(const ReceivedState& received);

/// The scene's hands by the ranks of their peers, so that all copies have them in the same order:
/// equal inputs make equal bits.
[[nodiscard]] inline std::uint32_t own_hand_by_rank(const Situation& situation)
{
    return static_cast<std::uint32_t>(situation.lower_ids);
}
[[nodiscard]] inline std::uint32_t hand_by_rank(std::size_t other, const Situation& situation)
{
    return static_cast<std::uint32_t>(other < situation.lower_ids ? other : other + 1);
}

} // namespace hapnet::peer
