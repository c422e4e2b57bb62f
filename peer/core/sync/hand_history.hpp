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

/// A hand at a tick of the session, with the precision of a message: four bytes a coordinate. So
/// the sender and the receivers use exactly the same bits in their copies.
struct HandSample {
    glm::dvec3 place{0.0};
    glm::dvec3 velocity{0.0};
    bool present = false;
    bool gripping = false;

    [[nodiscard]] static HandSample of(const scene::HandInput& input);
    /// Returns the sample in a message. Its `holding` means that the hand grips: see says_grip(). A
    /// hand without a usable sample is sent as at rest at the origin.
    [[nodiscard]] static HandSample of(const wire::State& state);
    [[nodiscard]] scene::HandInput input() const;
};

/// The known positions of a hand, tick by tick, during the last second. All memory is allocated at
/// construction.
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
    /// Returns the hand at a tick. `length` is the length of a tick. A missing sample between two
    /// known ones is interpolated by the cubic with the positions and velocities of both (Hermite).
    /// After the newest sample the hand rests there. Before the first one it is not present.
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

/// Sets what the message tells of the grip: `holding` means that this hand grips, because the
/// receivers find out themselves if it holds a body. A message can have `holding` only with
/// `touching`, so a hand that grips counts as touching.
inline void says_grip(scene::HandTouch& touched, const HandSample& own)
{
    touched.holding = own.present && own.gripping;
    touched.touching = touched.touching || touched.holding;
}

/// The hand of another peer, by ticks of the session, with the state of that peer's copy from its
/// newest message.
struct HeardHand {
    HandHistory history;
    SessionTicks ticks;
    /// The body as the peer has last sent it. `knows` covers only this peer's hand.
    std::optional<RestAgreement::Word> told;

    /// Takes a message and returns the tick that it describes; nullopt while the clocks are
    /// unknown, or if that tick is in the future.
    [[nodiscard]] std::optional<std::int64_t> hear(const ReceivedState& received);
    void forget();
};

/// Returns the tick of this peer's newest message that the sender had received; nullopt if it had
/// none of the session.
[[nodiscard]] std::optional<std::int64_t> answered_tick(const ReceivedState& received);

/// Return the indices of hands in the scene by the ranks of their peers. All copies then have the
/// hands in the same order, so that equal inputs give equal bits.
[[nodiscard]] inline std::uint32_t own_hand_by_rank(const Situation& situation)
{
    return static_cast<std::uint32_t>(situation.lower_ids);
}
[[nodiscard]] inline std::uint32_t hand_by_rank(std::size_t other, const Situation& situation)
{
    return static_cast<std::uint32_t>(other < situation.lower_ids ? other : other + 1);
}

} // namespace hapnet::peer
