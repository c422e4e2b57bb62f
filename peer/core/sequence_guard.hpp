// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/wire/message.hpp"

#include <optional>

namespace hapnet::peer {

/// Tells states that claim to be newer than they can be: one that was believed would make all true
/// ones look outdated until they catch up. The sender numbers at most one state per tick of its
/// clock, and stamps it; a path that becomes faster brings later stamps, but not by more than it
/// was slow. So a sequence may not run ahead of its own stamp, nor the stamp of the arrival. Both
/// leads are followed by small steps, as medians are: a few forged states do not move them.
class SequenceGuard {
public:
    /// The most by which a sequence may be ahead of its stamp: ticks that were made up for.
    static constexpr base::Duration numbered_ahead_max{std::chrono::milliseconds{50}};
    /// The most by which a state may be faster than those before: the greatest sudden drop of a
    /// path's delay.
    static constexpr base::Duration faster_max{std::chrono::milliseconds{500}};
    /// The silence after which the next state is accepted, whatever it claims, because no state is
    /// held any more.
    static constexpr base::Duration forgotten_after{std::chrono::milliseconds{300}};

    /// One state is numbered per `tick`.
    explicit SequenceGuard(base::Duration tick) : tick_{tick} {}

    [[nodiscard]] bool admits(const wire::State& state, base::TimePoint arrived) const;
    /// A state that was admitted counts as the newest.
    void on_taken(const wire::State& state, base::TimePoint arrived);
    void forget() { usual_.reset(); }

private:
    struct Usual {
        base::Duration lead;    // sequence times tick, minus the stamp on their clock
        base::Duration transit; // arrival on our clock minus stamp on their clock
        base::TimePoint last;   // arrival of the newest state
    };
    [[nodiscard]] Usual of(const wire::State& state, base::TimePoint arrived) const;

    base::Duration tick_;
    std::optional<Usual> usual_;
};

} // namespace hapnet::peer
