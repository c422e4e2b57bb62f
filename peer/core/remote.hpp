// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/wire/message.hpp"

#include <optional>

namespace hapnet::peer {

/// How long the newest word of the other side holds, counted from its arrival.
struct Staleness {
    base::Duration hold{std::chrono::milliseconds{250}};
    base::Duration fade{std::chrono::milliseconds{50}};
};

/// The other side as its newest state tells. Older states that arrive late are dropped (they
/// are counted), and between states everything is held.
class Remote {
public:
    explicit Remote(Staleness staleness) : staleness_{staleness} {}

    /// False when the state is not newer than what is known.
    bool update(const wire::State& state, base::TimePoint arrived);
    void forget();

    /// nullopt before the first state of the session.
    [[nodiscard]] const std::optional<wire::State>& state() const { return state_; }
    /// Its body's state, from the newest message that had one.
    [[nodiscard]] const std::optional<wire::BodyState>& body() const { return body_; }
    [[nodiscard]] std::optional<base::TimePoint> arrived() const { return arrived_; }

    /// 1 while fresh, falling to 0 over the fade, 0 when stale or unknown.
    [[nodiscard]] double freshness(base::TimePoint now) const;

private:
    Staleness staleness_;
    std::optional<wire::State> state_;
    std::optional<wire::BodyState> body_;
    std::optional<base::TimePoint> arrived_;
};

} // namespace hapnet::peer
