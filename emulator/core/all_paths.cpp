// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/all_paths.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <utility>

namespace hapnet::emulator {

AllPaths::AllPaths(std::vector<Paths*> parts) : parts_{std::move(parts)}
{
    base::ensure(!parts_.empty());
}

base::Result<void> AllPaths::apply(const Paths::CommandFor& command,
                                   std::span<const std::string> mentioned, base::TimePoint now,
                                   ChangeCause by)
{
    // The time of a part is that of its last arrival. All parts must get the command at the same
    // time.
    for (const Paths* part : parts_) now = std::max(now, part->now());
    for (Paths* part : parts_) part->catch_up(now);
    for (Paths* part : parts_) part->count_from(generation());
    auto done = parts_.front()->apply(command, mentioned, now, by);
    if (!done) return done;
    // The other parts decide in the same way.
    for (Paths* part : std::span{parts_}.subspan(1)) {
        base::ensure(part->apply(command, mentioned, now, by).has_value());
    }
    return done;
}

void AllPaths::catch_up(base::TimePoint now)
{
    for (Paths* part : parts_) part->catch_up(now);
}

std::uint64_t AllPaths::generation() const
{
    std::uint64_t most = 0;
    for (const Paths* part : parts_) most = std::max(most, part->generation());
    return most;
}

base::Duration AllPaths::elapsed() const
{
    base::Duration most{};
    for (const Paths* part : parts_) most = std::max(most, part->elapsed());
    return most;
}

base::TimePoint AllPaths::latest_now() const
{
    base::TimePoint latest = parts_.front()->now();
    for (const Paths* part : parts_) latest = std::max(latest, part->now());
    return latest;
}

std::optional<base::TimePoint> AllPaths::next_change() const
{
    std::optional<base::TimePoint> next;
    for (const Paths* part : parts_) next = base::earlier(next, part->next_change());
    return next;
}

std::vector<const Paths::Named*> AllPaths::all() const
{
    std::vector<const Paths::Named*> all;
    for (const Paths* part : parts_) {
        for (const Paths::Named& one : part->all()) all.push_back(&one);
    }
    return all;
}

std::vector<Paths::Decider> AllPaths::deciders() const
{
    std::vector<Paths::Decider> all;
    for (const Paths::Named* one : this->all()) all.push_back({one->name, &one->path->director()});
    // Adds the paths that do not exist in any part.
    for (const Paths::Decider& one : parts_.front()->deciders()) {
        if (std::ranges::find(all, one.name, &Paths::Decider::name) == all.end()) {
            all.push_back(one);
        }
    }
    return all;
}

} // namespace hapnet::emulator
