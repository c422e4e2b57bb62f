// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/wire/message.hpp"

#include <chrono>
#include <cstdint>
#include <optional>

namespace hapnet::peer {

/// Ends a peer's session with goodbyes: because it is over, because the peer is asked to leave, or
/// because it cannot play with another.
class Farewell {
public:
    static constexpr int byes = 5;
    static constexpr base::Duration bye_every{std::chrono::milliseconds{5}};
    /// A refusal counts when it came three times, at least this far apart: one damaged datagram
    /// must not end a session.
    static constexpr int refusals_needed = 3;
    static constexpr base::Duration refusal_every{std::chrono::milliseconds{4}};

    /// A reason why two peers cannot play together.
    struct Refusal {
        wire::ByeReason reason = wire::ByeReason::finished;
        std::uint32_t about = 0; // the nonce or version that is refused

        friend bool operator==(const Refusal&, const Refusal&) = default;
    };
    /// Notes another reason for a refusal. Returns true when it has now come often enough.
    [[nodiscard]] bool refuse(const Refusal& refusal, base::TimePoint now);
    /// The two can play together after all.
    void forget_refusals() { times_ = 0; }
    [[nodiscard]] std::optional<wire::ByeReason> refusal() const { return refusal_; }

    /// Goodbyes follow, if there is a peer to hear them. The first reason counts.
    void leave(wire::ByeReason reason, bool has_audience);
    [[nodiscard]] bool is_leaving() const { return because_.has_value(); }
    /// True if a goodbye is due; it then counts as said.
    [[nodiscard]] bool says_bye(base::TimePoint now);
    /// The reason that the message gives.
    [[nodiscard]] wire::ByeReason because() const
    {
        return because_.value_or(wire::ByeReason::finished);
    }
    /// True if all goodbyes are said.
    [[nodiscard]] bool is_finished() const { return is_leaving() && byes_left_ == 0; }

private:
    Refusal pending_; // refusal that has not come often enough yet
    int times_ = 0;   // number of times that pending_ has come
    base::TimePoint last_refusal_;
    std::optional<wire::ByeReason> refusal_;
    std::optional<wire::ByeReason> because_;
    int byes_left_ = byes;
    std::optional<base::TimePoint> last_bye_;
};

} // namespace hapnet::peer
