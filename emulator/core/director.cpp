// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/director.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

namespace {

/// Removes from `patch` the settings that `later` sets.
void strip(Patch& patch, const Patch& later)
{
    for_each_setting([&](const auto& slot) {
        if (later.*slot.patch) (patch.*slot.patch).reset();
    });
}

/// Returns the settings that `patch` sets, with their values in `conditions`.
Patch picked(const Conditions& conditions, const Patch& patch)
{
    Patch picked;
    for_each_setting([&](const auto& slot) {
        if (patch.*slot.patch) picked.*slot.patch = conditions.*slot.value;
    });
    return picked;
}

/// Returns the settings that both patches set, with their values in `conditions`.
Patch common(const Patch& a, const Patch& b, const Conditions& conditions)
{
    Patch only_in_a = a;
    strip(only_in_a, b);
    Patch in_both = a;
    strip(in_both, only_in_a);
    return picked(conditions, in_both);
}

using Steps = std::vector<Change>;

/// Returns the first step after `time`.
Steps::const_iterator after(const Steps& steps, base::Duration time)
{
    return std::upper_bound(steps.begin(), steps.end(), time,
                            [](base::Duration t, const Change& step) { return t < step.time; });
}

void strip(Director::Override& one, const Patch& up, const Patch& down)
{
    strip(one.up, up);
    strip(one.down, down);
}

/// True if there is a setting that both patches set.
bool meets(const Patch& patch, const Patch& later)
{
    bool does = false;
    for_each_setting(
        [&](const auto& slot) { does = does || (patch.*slot.patch && later.*slot.patch); });
    return does;
}

/// Removes the settings of both patches from an override. Other directors that share the override
/// keep theirs.
void strip(std::shared_ptr<const Director::Override>& one, const Patch& up, const Patch& down)
{
    if (!meets(one->up, up) && !meets(one->down, down)) return;
    Director::Override rest = *one;
    strip(rest, up, down);
    one = std::make_shared<const Director::Override>(std::move(rest));
}

bool sets_nothing(const Patch& patch)
{
    bool does = false;
    for_each_setting([&](const auto& slot) { does = does || (patch.*slot.patch).has_value(); });
    return !does;
}

bool sets_nothing(const Director::Override& one)
{
    return sets_nothing(one.up) && sets_nothing(one.down);
}

/// True if an override that ends at `until` ends no later than one that ends at `other`.
bool ends_within(std::optional<base::TimePoint> until, std::optional<base::TimePoint> other)
{
    return !other || (until && *until <= *other);
}

} // namespace

Director::~Director() = default;
Director::Director(Director&&) noexcept = default;
Director& Director::operator=(Director&&) noexcept = default;
Director::Director(const Director&) = default;
Director& Director::operator=(const Director&) = default;

Director::Director(Profile profile, base::TimePoint start)
    : Director{std::make_shared<const Script>(std::move(profile)), start}
{}

Director::Director(std::shared_ptr<const Script> script, base::TimePoint start)
    : started_with_{std::move(script)},
      start_{start},
      script_{started_with_},
      begin_{start},
      now_{start},
      path_{std::make_shared<const Path>(script_->timeline().at(base::Duration{0}))},
      next_change_{find_next_change()}
{}

/// Applies everything that has become due since `before`.
bool Director::change_after(base::TimePoint before)
{
    const bool has_step = let_later_steps_win(before - begin_);
    const auto ended =
        std::erase_if(overrides_, [&](const auto& one) { return base::is_due(one->until, now_); });
    last_reason_ = has_step ? Reason::step : ended > 0 ? Reason::hand : Reason::ramp;
    return update();
}

base::Result<void> Director::apply(const Command& command, base::TimePoint now)
{
    advance(now);
    if (const auto* set = std::get_if<Set>(&command)) {
        auto overrides = overrides_with(*set);
        if (!overrides) return tl::unexpected{overrides.error()};
        last_reason_ = Reason::hand;
        overrides_ = *std::move(overrides);
        update();
        return {};
    }
    last_reason_ = Reason::hand;
    if (const auto* other = std::get_if<Apply>(&command)) {
        follow(other->script, now_);
    } else {
        follow(started_with_, start_);
    }
    return {};
}

bool Director::is_twin_of(const Director& other) const
{
    return script_ == other.script_ && path_ == other.path_ && overrides_ == other.overrides_ &&
           started_with_ == other.started_with_ && start_ == other.start_ &&
           begin_ == other.begin_ && generation_ == other.generation_ &&
           last_reason_ == other.last_reason_ && next_change_ == other.next_change_;
}

base::Result<Director::Overrides> Director::overrides_with(const Set& set) const
{
    std::optional<base::TimePoint> until;
    if (set.lasting) {
        base::ensure(set.lasting->count() > 0);
        until = now_ + *set.lasting;
    }
    Overrides overrides = overrides_;
    for (auto& one : overrides) {
        if (ends_within(one->until, until)) strip(one, set.up, set.down);
    }
    overrides.push_back(std::make_shared<const Override>(Override{set.up, set.down, until}));
    std::erase_if(overrides, [](const auto& one) { return sets_nothing(*one); });
    if (overrides.size() > overrides_max) {
        return base::fail(fmt::format("{} temporary settings are already active; wait for one to "
                                      "expire, or run reset",
                                      overrides_max));
    }
    return overrides;
}

void Director::follow(std::shared_ptr<const Script> script, base::TimePoint begin)
{
    const bool is_the_same = script->says_the_same_as(*script_) &&
                             (script->profile().timeline.empty() || begin == begin_);
    script_ = std::move(script);
    begin_ = begin;
    overrides_.clear();
    if (!update() && !is_the_same) ++generation_;
}

/// Removes the settings of the steps since `before` from the overrides. Returns true if there were
/// steps.
bool Director::let_later_steps_win(base::Duration before)
{
    const auto begin = after(script_->profile().timeline, before);
    const auto end = after(script_->profile().timeline, position());
    for (auto step = begin; step < end; ++step) {
        for (auto& one : overrides_) strip(one, step->up, step->down);
    }
    std::erase_if(overrides_, [](const auto& one) { return sets_nothing(*one); });
    return begin < end;
}

bool Director::update()
{
    Path path = script_->timeline().at(position());
    for (const auto& one : overrides_) {
        path.up = patched(std::move(path.up), one->up);
        path.down = patched(std::move(path.down), one->down);
    }
    next_change_ = find_next_change();
    if (path == *path_) return false;
    path_ = std::make_shared<const Path>(std::move(path));
    ++generation_;
    return true;
}

std::optional<base::TimePoint> Director::find_next_change() const
{
    std::optional<base::TimePoint> next;
    if (const auto at = script_->timeline().next_change(position())) next = begin_ + *at;
    // A step that only repeats the profile's value still ends a setting made by hand.
    const Steps& steps = script_->profile().timeline;
    const auto step = after(steps, position());
    if (step != steps.end()) next = base::earlier(next, begin_ + step->time);
    for (const auto& one : overrides_) next = base::earlier(next, one->until);
    return next;
}

Profile Director::remaining() const
{
    const Profile& all = script_->profile();
    Profile profile{all.name, started_with_->profile().seed, *path_, {}, {}, all.checks};
    Override by_hand; // settings that no step has replaced yet
    for (const auto& one : overrides_) {
        by_hand.up = merged(std::move(by_hand.up), one->up);
        by_hand.down = merged(std::move(by_hand.down), one->down);
    }
    for (Change step : all.timeline) {
        const bool is_past = step.time <= position();
        if (is_past) {
            step.ramp -= position() - step.time;
            strip(step.up, by_hand.up);
            strip(step.down, by_hand.down);
            if (step.ramp.count() <= 0 || sets_nothing({step.up, step.down, {}})) continue;
        } else if (step.ramp.count() > 0) {
            // The ramp does not begin at the value set by hand, but at that of the profile.
            const Path before = script_->timeline().at(step.time);
            Change start{step.time - position(),
                         {},
                         common(step.up, by_hand.up, before.up),
                         common(step.down, by_hand.down, before.down)};
            if (!sets_nothing({start.up, start.down, {}})) profile.timeline.push_back(start);
        }
        if (!is_past) strip(by_hand, step.up, step.down);
        step.time = std::max(step.time - position(), base::Duration{0});
        profile.timeline.push_back(std::move(step));
    }
    return profile;
}

} // namespace hapnet::emulator
