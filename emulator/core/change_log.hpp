// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "proto/base/names.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace hapnet::emulator {

/// The cause of a change of conditions. `hand`: a setting made by hand, or its end; `timeline`: the
/// profile's timeline; `reload`: the profile was read again.
enum class ChangeCause : std::uint8_t { hand, timeline, reload };
constexpr auto names_of(base::Tag<ChangeCause>)
{
    return base::names("hand", "timeline", "reload");
}

/// A change of the conditions of a path while it runs.
struct ConditionChange {
    std::uint64_t generation = 0;
    base::Duration elapsed{};         // time since the start of the run
    std::uint64_t effective_up = 0;   // number of the first datagram that it affects
    std::uint64_t effective_down = 0; // the corresponding number in direction down
    ChangeCause by = ChangeCause::hand;
    std::shared_ptr<const Path> from{}; // conditions before the change; never null
    std::shared_ptr<const Path> to{};   // conditions after the change; never null

    /// Returns the settings that changed, with their new values.
    [[nodiscard]] Patch patch(Direction direction) const;
};

/// The changes of a path, in their order. A ramp changes the conditions a thousand times a second:
/// of its consecutive steps only the first and the last are kept. The log is bounded: it keeps the
/// first `room` changes and only counts later ones.
class ChangeLog {
public:
    static constexpr std::size_t entries_max = 1000;

    explicit ChangeLog(std::size_t room = entries_max) : room_{room} {}

    void add(const ConditionChange& change, bool is_step_of_ramp);

    [[nodiscard]] const std::vector<ConditionChange>& entries() const { return entries_; }
    /// Returns the number of changes that were not kept for lack of room.
    [[nodiscard]] std::uint64_t omitted() const { return omitted_; }

private:
    std::size_t room_;
    std::vector<ConditionChange> entries_;
    std::uint64_t omitted_ = 0;
    std::uint8_t ramp_entries_ = 0; // last entries that belong to the ramp in progress: at most 2
};

} // namespace hapnet::emulator
