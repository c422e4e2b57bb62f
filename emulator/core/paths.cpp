// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/paths.hpp"

#include "emulator/core/profile/flows.hpp"
#include "emulator/core/profile/paths.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <deque>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

/// Groups directors that are twins, so that their common work is done only once.
class Paths::Twins {
public:
    /// Returns the new state of a director that was a twin of this one before its work was done;
    /// nullptr: there was none.
    [[nodiscard]] const Director* find(const Director& director) const
    {
        const auto found = std::ranges::find_if(
            known_, [&](const Known& one) { return director.is_twin_of(one.before); });
        return found == known_.end() ? nullptr : &found->after;
    }
    const Director& add(const Director& before, Director after)
    {
        return known_.emplace_back(Known{before, std::move(after)}).after;
    }

    /// Returns the director after advance(now), if a change has become due by then.
    const Director& advanced(const Director& director, base::TimePoint now)
    {
        if (const Director* twin = find(director)) return *twin;
        Director after = director;
        after.advance(now);
        return add(director, std::move(after));
    }

private:
    struct Known {
        Director before;
        Director after;
    };
    std::deque<Known> known_;
};

namespace {

/// True if it is the name of a single path, not of a flow on all paths.
bool is_of_one(std::string_view name) { return common_name(name) != name; }

std::shared_ptr<const FlowFilters> filters_of(const std::vector<Flow>& flows)
{
    if (flows.empty()) return nullptr;
    std::vector<Match> matches;
    for (const Flow& flow : flows) matches.push_back(flow.match);
    return std::make_shared<const FlowFilters>(matches);
}

} // namespace

Paths::Paths(const Profile& profile, Setup setup)
    : profile_{profile},
      setup_{std::move(setup)},
      filters_{filters_of(profile_.flows)},
      said_of_{paths_in(profile_)},
      now_{setup_.start}
{
    const auto begin = [&](const std::string& name) {
        beginnings_.push_back({name, Director{profile_of(profile_, name), setup_.start}});
    };
    for (const Flow& flow : profile_.flows) begin(flow_path("", flow.name));
    begin("");
    std::erase_if(said_of_, [](const std::string& name) { return !is_of_one(name); });
    for (const std::string& name : setup_.elsewhere) {
        keep_for_absent(name);
        for (const Flow& flow : profile_.flows) keep_for_absent(flow_path(name, flow.name));
    }
    if (setup_.takes_newcomers) {
        newcomers_ = beginnings_;
        mentioned_ = said_of_;
        for (const std::string& name : mentioned_) keep_for_absent(name);
    }
    find_next_change();
}

void Paths::keep_for_absent(const std::string& name)
{
    absent_.push_back({name, beginning_of(name)});
}

Director Paths::beginning_of(const std::string& name) const
{
    const bool has_its_own = std::ranges::find(said_of_, name) != said_of_.end();
    if (has_its_own) return Director{profile_of(profile_, name), setup_.start};
    return std::ranges::find(beginnings_, common_name(name), &Absent::name)->director;
}

/// Returns the director of a path that is added now.
Director Paths::director_for(const std::string& name)
{
    const auto known = std::ranges::find(absent_, name, &Absent::name);
    if (known != absent_.end()) {
        Director director = std::move(known->director);
        absent_.erase(known);
        return director;
    }
    if (newcomers_.empty()) return beginning_of(name);
    return std::ranges::find(newcomers_, common_name(name), &Absent::name)->director;
}

EmulatedPath& Paths::add(const std::string& name)
{
    EmulatedPath& rest = add_one(name);
    if (profile_.flows.empty()) return rest;
    std::vector<EmulatedPath*> flows;
    for (const Flow& flow : profile_.flows) {
        flows.push_back(&add_one(flow_path(name, flow.name)));
        if (flow.shares_rate) flows.back()->share_bottlenecks_of(rest);
    }
    rest.branch(std::make_unique<Branches>(filters_, std::move(flows)));
    return rest;
}

EmulatedPath& Paths::add_one(const std::string& name)
{
    base::ensure(std::ranges::find(paths_, name, &Named::name) == paths_.end());
    EmulatedPath::Setup setup{.seed = setup_.seed,
                              .start = setup_.start,
                              .limits = setup_.limits,
                              .slab = setup_.slab,
                              .stream_detail = setup_.stream_detail,
                              .name = name,
                              .changes_max = setup_.changes_max,
                              .place = due_times_->add()};
    if (setup_.replay) {
        static const Fates none; // without fates every datagram is dropped: replay_ended
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
    for (const Flow& flow : profile_.flows) remove_one(flow_path(name, flow.name));
    remove_one(name);
    find_next_change();
}

void Paths::remove_one(std::string_view name)
{
    const auto found = std::ranges::find(paths_, name, &Named::name);
    base::ensure(found != paths_.end());
    if (!newcomers_.empty() && std::ranges::find(mentioned_, name) != mentioned_.end()) {
        absent_.push_back({found->name, found->path->director()});
    }
    due_times_->remove(found->path->number());
    by_number_[found->path->number()] = nullptr;
    paths_.erase(found);
}

void Paths::advance_all(base::TimePoint now)
{
    const auto before = generations();
    Twins twins;
    const auto is_due = [&](const Director& director) {
        return base::is_due(director.next_change(), now) && director.now() <= now;
    };
    for (const Named& one : paths_) {
        const Director& director = one.path->director();
        if (is_due(director)) {
            one.path->follow(twins.advanced(director, now), now);
        } else {
            one.path->advance(now);
        }
    }
    // Paths that are added later stay twins of the existing ones.
    const auto advance = [&](Director& director) {
        if (is_due(director)) {
            director = twins.advanced(director, now);
        } else {
            director.advance(now);
        }
    };
    for (Absent& one : absent_) advance(one.director);
    for (Absent& one : newcomers_) advance(one.director);
    if (generations() != before) ++generation_;
    find_next_change();
}

void Paths::find_next_change()
{
    next_change_.reset();
    for (const Absent& one : newcomers_) {
        next_change_ = base::earlier(next_change_, one.director.next_change());
    }
    for (const Named& one : paths_) {
        next_change_ = base::earlier(next_change_, one.path->director().next_change());
    }
    for (const Absent& one : absent_) {
        next_change_ = base::earlier(next_change_, one.director.next_change());
    }
}

/// Keeps a director for each path that gets its own settings before it exists.
base::Result<void> Paths::expect(std::span<const std::string> mentioned)
{
    if (newcomers_.empty()) return {};
    for (const std::string& name : mentioned) {
        if (!is_of_one(name)) continue;
        if (std::ranges::find(mentioned_, name) != mentioned_.end()) continue;
        if (mentioned_.size() >= absent_max) {
            return base::fail(fmt::format("{} clients have settings of their own already; run "
                                          "reset to begin again",
                                          absent_max));
        }
        mentioned_.push_back(name);
        const bool is_there = std::ranges::find(paths_, name, &Named::name) != paths_.end();
        if (!is_there) absent_.push_back({name, director_for(name)});
    }
    return {};
}

base::Result<void> Paths::apply(const CommandFor& command, std::span<const std::string> mentioned,
                                base::TimePoint now, ChangeCause by)
{
    // A change has the time of the last arrival on any path, which may be later than `now`.
    catch_up(now);
    now = now_;
    if (auto expected = expect(mentioned); !expected) return expected;
    // First computes the new state of each path. If none refuses, applies all of them at once.
    Twins twins;
    std::deque<Director> own; // directors of the paths that the command names
    std::vector<const Director*> next;
    std::optional<Command> last;
    for (const auto& [name, director] : deciders()) {
        const bool is_mentioned =
            is_of_one(name) && std::ranges::find(mentioned, name) != mentioned.end();
        const Director* twin = is_mentioned ? nullptr : twins.find(*director);
        if (twin == nullptr) {
            auto told = command(name, director->path());
            if (!told) return tl::unexpected{told.error()};
            Director after = *director;
            if (auto done = after.apply(*told, now); !done) return done;
            twin = is_mentioned ? &own.emplace_back(std::move(after))
                                : &twins.add(*director, std::move(after));
            last = *std::move(told);
        }
        next.push_back(twin);
    }
    const auto before = generations();
    auto becomes = next.begin();
    for (const Named& one : paths_) one.path->follow(**becomes++, now, by);
    for (Absent& one : absent_) one.director = **becomes++;
    for (Absent& one : newcomers_) one.director = **becomes++;
    if (generations() != before) ++generation_;
    if (!newcomers_.empty() && last) forget_absent(*last, mentioned);
    find_next_change();
    return {};
}

/// Discards the settings of paths that do not exist, after another profile or a reset. Paths that
/// the profile names keep theirs.
void Paths::forget_absent(const Command& command, std::span<const std::string> mentioned)
{
    if (std::holds_alternative<Set>(command)) return;
    mentioned_ = std::holds_alternative<Reset>(command)
                     ? said_of_
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
    PathNames names = with_flows({.clients = setup_.takes_newcomers}, profile_.flows);
    if (names.clients) return names;
    for (const Named& one : paths_) {
        if (!one.name.empty() && parts_of(one.name).flow.empty()) names.links.push_back(one.name);
    }
    names.links.insert(names.links.end(), setup_.elsewhere.begin(), setup_.elsewhere.end());
    return names;
}

std::vector<Paths::Decider> Paths::deciders() const
{
    std::vector<Decider> all;
    for (const Named& one : paths_) all.push_back({one.name, &one.path->director()});
    for (const Absent& one : absent_) all.push_back({one.name, &one.director});
    for (const Absent& one : newcomers_) all.push_back({one.name, &one.director});
    return all;
}

} // namespace hapnet::emulator
