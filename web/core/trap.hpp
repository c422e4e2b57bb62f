// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/condition.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"
#include "web/core/feed.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>

namespace hapnet::web {

/// Waits for a condition on the live figures. When the condition is true, the trap waits for a
/// short aftermath and then requests once that the last seconds are saved. After a rest it is armed
/// again. It does no I/O and reads no clock.
class Trap {
public:
    static constexpr base::Duration aftermath{std::chrono::seconds{2}};
    static constexpr base::Duration rest{std::chrono::seconds{30}};
    static constexpr base::Duration last_min{std::chrono::seconds{1}};
    static constexpr base::Duration last_max{std::chrono::seconds{20}};
    static constexpr base::Duration last_usual{std::chrono::seconds{10}};

    /// Arms the trap. `names` are the names of all figures that are possible. The error says which
    /// names are allowed.
    [[nodiscard]] base::Result<void> arm(const std::string& when, base::Duration last,
                                         std::span<const std::string> names);
    void disarm() { state_ = State::disarmed; }

    /// The result of one step.
    enum class News : std::uint8_t { none, fired, wants_keep, armed_again };
    /// Checks the newest figures.
    [[nodiscard]] News step(const Figures& figures, base::TimePoint now);

    [[nodiscard]] base::Duration last() const { return last_; }
    [[nodiscard]] std::uint64_t fired() const { return fired_; }
    [[nodiscard]] std::string when() const;
    /// Returns `state`, `when`, `last`, `fired`, `says`.
    [[nodiscard]] nlohmann::ordered_json json() const;

private:
    enum class State : std::uint8_t { disarmed, armed, fired, resting };

    State state_ = State::disarmed;
    std::optional<base::Condition> when_;
    base::Duration last_ = last_usual;
    std::optional<base::TimePoint> next_; // end of the states fired and resting
    std::uint64_t fired_ = 0;
};

} // namespace hapnet::web
