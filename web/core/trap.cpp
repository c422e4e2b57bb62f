// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/core/trap.hpp"

#include "proto/base/reading.hpp"
#include "proto/base/text.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>

namespace hapnet::web {

base::Result<void> Trap::arm(const std::string& when, base::Duration last,
                             std::span<const std::string> names)
{
    const auto condition = base::parse_condition(when, "apart_mm>30");
    if (!condition) return tl::unexpected{condition.error()};
    if (std::ranges::find(names, condition->path) == names.end()) {
        const std::vector<std::string_view> all{names.begin(), names.end()};
        return base::fail(fmt::format("no figure is called '{}': {}", condition->path,
                                      base::suggestion(condition->path, all)));
    }
    if (last < last_min || last > last_max) {
        return base::fail(fmt::format("\"last\" must be from {} to {}", base::bound_text(last_min),
                                      base::bound_text(last_max)));
    }
    when_ = *condition;
    last_ = last;
    state_ = State::armed;
    return {};
}

Trap::News Trap::step(const Figures& figures, base::TimePoint now)
{
    switch (state_) {
    case State::disarmed: return News::none;
    case State::armed: {
        const auto figure = figures.find(when_->path);
        if (figure == figures.end() || !base::holds(*when_, figure->second)) return News::none;
        state_ = State::fired;
        next_ = now + aftermath;
        ++fired_;
        return News::fired;
    }
    case State::fired:
        if (!base::is_due(next_, now)) return News::none;
        state_ = State::resting;
        next_ = now + rest;
        return News::wants_keep;
    case State::resting:
        if (!base::is_due(next_, now)) return News::none;
        state_ = State::armed;
        return News::armed_again;
    }
    return News::none;
}

std::string Trap::when() const { return when_ ? base::to_text(*when_) : ""; }

nlohmann::ordered_json Trap::json() const
{
    std::string_view name = "disarmed";
    std::string says = "waits for nothing";
    switch (state_) {
    case State::disarmed: break;
    case State::armed:
        name = "armed";
        says = fmt::format("waits for {}", when());
        break;
    case State::fired:
        name = "fired";
        says = fmt::format("{} came true; 2 s of what follows are awaited", when());
        break;
    case State::resting:
        name = "resting";
        says = "waits again in 30 s at most";
        break;
    }
    return {{"state", name},
            {"when", when_ ? nlohmann::ordered_json(when()) : nlohmann::ordered_json(nullptr)},
            {"last", base::to_text(last_)},
            {"fired", fired_},
            {"says", says}};
}

} // namespace hapnet::web
