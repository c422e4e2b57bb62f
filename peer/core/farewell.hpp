// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/wire/message.hpp"

#include <chrono>
#include <cstdint>
#include <optional>

namespace hapnet::peer {

/// Ends a peer's session with goodbyes, because it is over, because the peer was asked to leave, or
/// because it cannot play with another peer.
class Farewell {
public:
    static constexpr int byes = 5;
    static constexpr base::Duration bye_every{std::chrono::milliseconds{5}};
    /// The number of times that a refusal must occur before it takes effect, at least
    /// `refusal_every` apart. A single damaged datagram must not end a session.
    static constexpr int refusals_needed = 3;
    static constexpr base::Duration refusal_every{std::chrono::milliseconds{4}};

    /// A reason why two peers cannot play together.
    struct Refusal {
        wire::ByeReason reason = wire::ByeReason::finished;
        std::uint32_t about = 0; // the refused nonce or version

        friend bool operator==(const Refusal&, const Refusal&) = default;
    };
    /// Notes a refusal. Returns true when it has occurred often enough.
    [[nodiscard]] bool refuse(const Refusal& refusal, base::TimePoint now);
    /// Forgets the refusals, because the two can play together after all.
    void forget_refusals() { times_ = 0; }
    [[nodiscard]] std::optional<wire::ByeReason> refusal() const { return refusal_; }

    /// Begins to leave. Goodbyes follow if another peer can receive them. The first reason is kept.
    void leave(wire::ByeReason reason, bool has_audience);
    [[nodiscard]] bool is_leaving() const { return because_.has_value(); }
    /// True if a goodbye is due. It then counts as sent.
    [[nodiscard]] bool says_bye(base::TimePoint now);
    /// Returns the reason that the goodbye gives.
    [[nodiscard]] wire::ByeReason because() const
    {
        return because_.value_or(wire::ByeReason::finished);
    }
    /// True if all goodbyes have been sent.
    [[nodiscard]] bool is_finished() const { return is_leaving() && byes_left_ == 0; }

private:
    Refusal pending_; // a refusal that has not occurred often enough yet
    int times_ = 0;   // number of occurrences of pending_
    base::TimePoint last_refusal_;
    std::optional<wire::ByeReason> refusal_;
    std::optional<wire::ByeReason> because_;
    int byes_left_ = byes;
    std::optional<base::TimePoint> last_bye_;
};

} // namespace hapnet::peer
