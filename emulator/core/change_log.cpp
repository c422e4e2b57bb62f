// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/change_log.hpp"

#include "emulator/core/profile/paths.hpp"

#include <utility>

namespace hapnet::emulator {

Patch ConditionChange::patch(Direction direction) const
{
    const bool is_up = direction == Direction::up;
    return difference(is_up ? from->up : from->down, is_up ? to->up : to->down);
}

void ChangeLog::add(const ConditionChange& change, bool is_step_of_ramp)
{
    constexpr std::uint8_t first_and_last = 2;
    if (!is_step_of_ramp) ramp_entries_ = 0;
    if (ramp_entries_ == first_and_last) {
        ConditionChange last = change;
        last.from = std::move(entries_.back().from);
        entries_.back() = std::move(last);
        return;
    }
    if (entries_.size() >= room_) {
        ++omitted_;
        return;
    }
    entries_.push_back(change);
    if (is_step_of_ramp) ++ramp_entries_;
}

} // namespace hapnet::emulator
