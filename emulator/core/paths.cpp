// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/paths.hpp"

#include "emulator/core/profile/paths.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

Paths::Paths(const Profile& profile, Setup setup)
    : profile_{profile}, setup_{std::move(setup)}, now_{setup_.start}
{
    for (const std::string& name : setup_.elsewhere) {
        absent_.push_back({name, Director{profile_of(profile_, name), setup_.start}});
    }
    find_next_change();
    if (!setup_.takes_newcomers) return;
    newcomers_.emplace(profile_of(profile_, ""), setup_.start);
    mentioned_ = paths_in(profile_);
    for (const std::string& name : mentioned_) {
        absent_.push_back({name, Director{profile_of(profile_, name), setup_.start}});
    }
    find_next_change();
}

/// What decides for a path that comes now.
Director Paths::director_for(const std::string& name)
{
    const auto known = std::ranges::find(absent_, name, &Absent::name);
    if (known != absent_.end()) {
        Director director = std::move(known->director);
        absent_.erase(known);
        return director;
    }
    return newcomers_ ? *newcomers_ : Director{profile_of(profile_, name), setup_.start};
}

EmulatedPath& Paths::add(const std::string& name)
{
    base::ensure(std::ranges::find(paths_, name, &Named::name) == paths_.end());
    EmulatedPath::Setup setup{.seed = setup_.seed,
                              .start = setup_.start,
                              .limits = setup_.limits,
                              .slab = setup_.slab,
                              .has_stream_statistics = setup_.has_stream_statistics,
                              .name = name,
                              .changes_max = setup_.changes_max,
                              .place = due_times_->add()};
    if (setup_.replay) {
        static const Fates none; // whatever comes is dropped as replay_ended
        const auto found = setup_.replay->find(name);
        setup.replay = {setup_.replay, found == setup_.replay->end() ? &none : &found->second};
    }
    auto path = std::make_unique<EmulatedPath>(director_for(name), setup);
    EmulatedPath& added = *paths_.emplace_back(Named{name, std::move(path)}).path;
    by_number_.resize(std::max(by_number_.size(), added.number() + 1));
    by_number_[added.number()] = &added;
    find_next_change();
    return added;
}

void Paths::remove(std::string_view name)
{
    const auto found = std::ranges::find(paths_, name, &Named::name);
    base::ensure(found != paths_.end());
    if (newcomers_ && std::ranges::find(mentioned_, name) != mentioned_.end()) {
        absent_.push_back({found->name, found->path->director()});
    }
    due_times_->remove(found->path->number());
    by_number_[found->path->number()] = nullptr;
    paths_.erase(found);
    find_next_change();
}

void Paths::advance_all(base::TimePoint now)
{
    bool has_changed = false;
    for (const Named& one : paths_) has_changed = one.path->advance(now) || has_changed;
    for (Absent& one : absent_) has_changed = one.director.advance(now) || has_changed;
    if (newcomers_) has_changed = newcomers_->advance(now) || has_changed;
    if (has_changed) ++generation_;
    find_next_change();
}

void Paths::find_next_change()
{
    next_change_ = newcomers_ ? newcomers_->next_change() : std::nullopt;
    for (const Named& one : paths_) {
        next_change_ = base::earlier(next_change_, one.path->director().next_change());
    }
    for (const Absent& one : absent_) {
        next_change_ = base::earlier(next_change_, one.director.next_change());
    }
}

/// Keeps apart those that are told something of their own before they come.
base::Result<void> Paths::expect(std::span<const std::string> mentioned)
{
    if (!newcomers_) return {};
    for (const std::string& name : mentioned) {
        if (std::ranges::find(mentioned_, name) != mentioned_.end()) continue;
        if (mentioned_.size() >= absent_max) {
            return base::fail(fmt::format("{} clients have settings of their own already; run "
                                          "reset to begin again",
                                          absent_max));
        }
        mentioned_.push_back(name);
        const bool is_there = std::ranges::find(paths_, name, &Named::name) != paths_.end();
        if (!is_there) absent_.push_back({name, *newcomers_});
    }
    return {};
}

base::Result<void> Paths::apply(const CommandFor& command, std::span<const std::string> mentioned,
                                base::TimePoint now, ChangeCause by)
{
    // A change is stamped by what arrives on any path: it may come after this moment.
    catch_up(now);
    now = now_;
    if (auto expected = expect(mentioned); !expected) return expected;
    std::vector<Command> commands;
    for (const auto& [name, director] : deciders()) {
        auto own = command(name, director->path());
        if (!own) return tl::unexpected{own.error()};
        if (auto valid = director->check(*own); !valid) return valid;
        commands.push_back(*std::move(own));
    }
    const auto before = generations();
    auto own = commands.begin();
    for (const Named& one : paths_) base::ensure(one.path->apply(*own++, now, by).has_value());
    for (Absent& one : absent_) base::ensure(one.director.apply(*own++, now).has_value());
    if (newcomers_) base::ensure(newcomers_->apply(*own, now).has_value());
    if (generations() != before) ++generation_;
    if (newcomers_) forget_absent(commands.back(), mentioned);
    find_next_change();
    return {};
}

/// After another profile, what was set for those that are not there is gone.
void Paths::forget_absent(const Command& command, std::span<const std::string> mentioned)
{
    if (std::holds_alternative<Set>(command)) return;
    mentioned_ = std::holds_alternative<Reset>(command)
                     ? paths_in(profile_)
                     : std::vector<std::string>{mentioned.begin(), mentioned.end()};
    std::erase_if(absent_, [&](const Absent& one) {
        return std::ranges::find(mentioned_, one.name) == mentioned_.end();
    });
}

std::uint64_t Paths::generations() const
{
    std::uint64_t sum = 0;
    for (const auto& [name, director] : deciders()) sum += director->generation();
    return sum;
}

PathNames Paths::names() const
{
    PathNames names{.links = {}, .clients = setup_.takes_newcomers};
    if (names.clients) return names;
    for (const Named& one : paths_) {
        if (!one.name.empty()) names.links.push_back(one.name);
    }
    names.links.insert(names.links.end(), setup_.elsewhere.begin(), setup_.elsewhere.end());
    return names;
}

std::vector<Paths::Decider> Paths::deciders() const
{
    std::vector<Decider> all;
    for (const Named& one : paths_) all.push_back({one.name, &one.path->director()});
    for (const Absent& one : absent_) all.push_back({one.name, &one.director});
    if (newcomers_) all.push_back({"", &*newcomers_});
    return all;
}

} // namespace hapnet::emulator
