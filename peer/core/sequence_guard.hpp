// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/wire/message.hpp"

#include <optional>

namespace hapnet::peer {

/// Detects states that claim to be newer than possible. If one were accepted, all genuine states
/// would look outdated until they catch up. The sender numbers and stamps at most one state per
/// tick of its clock. If a path becomes faster, later stamps arrive, but the gain cannot exceed the
/// delay that the path had. So the sequence number must not run ahead of its own stamp, and the
/// stamp must not run ahead of its arrival. The usual values of both are updated by small steps, as
/// in a running median, so that a few forged states do not change them.
class SequenceGuard {
public:
    /// The most by which a sequence number may be ahead of its stamp, because of ticks that the
    /// sender made up for.
    static constexpr base::Duration numbered_ahead_max{std::chrono::milliseconds{50}};
    /// The most by which a state may be faster than those before it: the greatest sudden drop of a
    /// path's delay.
    static constexpr base::Duration faster_max{std::chrono::milliseconds{500}};
    /// The silence after which the next state is accepted in any case, because no earlier state is
    /// in use any more.
    static constexpr base::Duration forgotten_after{std::chrono::milliseconds{300}};

    /// At most one state is numbered per `tick`.
    explicit SequenceGuard(base::Duration tick) : tick_{tick} {}

    [[nodiscard]] bool admits(const wire::State& state, base::TimePoint arrived) const;
    /// Makes an admitted state the newest one.
    void on_taken(const wire::State& state, base::TimePoint arrived);
    void forget() { usual_.reset(); }

private:
    struct Usual {
        base::Duration lead;    // sequence times tick, minus the stamp on the remote's clock
        base::Duration transit; // arrival on this clock minus stamp on the remote's clock
        base::TimePoint last;   // arrival of the newest state
    };
    [[nodiscard]] Usual of(const wire::State& state, base::TimePoint arrived) const;

    base::Duration tick_;
    std::optional<Usual> usual_;
};

} // namespace hapnet::peer
