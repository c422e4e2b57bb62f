// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/names.hpp"
#include "proto/base/time.hpp"
#include "proto/wire/message.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace hapnet::peer {

/// Times for which the newest state of the other side holds and fades, from its arrival.
struct Staleness {
    base::Duration hold{std::chrono::milliseconds{250}};
    base::Duration fade{std::chrono::milliseconds{50}};
};

/// The treatment of a stale state: an older one that was overtaken on its way, or a duplicate.
enum class Stale : std::uint8_t { drop, take };
constexpr auto names_of(base::Tag<Stale> /*enum*/) { return base::names("drop", "take"); }

/// The other side as of its newest state, or of the last to arrive when stale ones are taken.
/// Between states everything is held.
class Remote {
public:
    explicit Remote(Staleness staleness, Stale stale = Stale::drop)
        : staleness_{staleness}, stale_{stale}
    {}

    /// False when the state is stale and dropped.
    bool update(const wire::State& state, base::TimePoint arrived);
    void forget();

    /// nullopt before the first state of the session.
    [[nodiscard]] const std::optional<wire::State>& state() const { return state_; }
    /// A body's state, from the newest message that had it; nullptr: there was none.
    [[nodiscard]] const wire::BodyState* body(std::uint16_t id) const;
    /// The same where there is but one.
    [[nodiscard]] const wire::BodyState* body() const
    {
        return count_ == 0 ? nullptr : &bodies_[0];
    }
    /// How many bodies it has told of.
    [[nodiscard]] std::size_t bodies_known() const { return count_; }
    /// The body that the newest state's hand pushes, by the impulse that it has given last.
    [[nodiscard]] const wire::BodyState* touched() const;
    [[nodiscard]] std::optional<base::TimePoint> arrived() const { return arrived_; }

    /// 1 while fresh, falling to 0 over the fade, 0 when stale or unknown.
    [[nodiscard]] double freshness(base::TimePoint now) const;

private:
    void take(const wire::State& state);

    Staleness staleness_;
    Stale stale_;
    std::optional<wire::State> state_;
    std::array<wire::BodyState, wire::bodies_max> bodies_; // the first count_, as they were told of
    std::size_t count_ = 0;
    std::size_t touched_ = 0; // of these
    std::optional<base::TimePoint> arrived_;
};

} // namespace hapnet::peer
