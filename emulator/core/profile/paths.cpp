// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/paths.hpp"

#include "emulator/core/path_name.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace hapnet::emulator {

namespace {

const PathPatch* find_patch(const std::vector<PathPatch>& patches, std::string_view path)
{
    const auto found = std::ranges::find(patches, path, &PathPatch::path);
    return found == patches.end() ? nullptr : &*found;
}

/// Removes the settings that all patches of one direction share, and returns them.
Patch taken_in_common(std::vector<PathPatch>& patches, Patch PathPatch::*way)
{
    Patch common;
    for_each_setting([&](const auto& slot) {
        const auto& first = (patches.front().*way).*slot.patch;
        const bool is_common = first && std::ranges::all_of(patches, [&](const PathPatch& one) {
                                   return (one.*way).*slot.patch == first;
                               });
        if (!is_common) return;
        common.*slot.patch = first;
        for (PathPatch& one : patches) ((one.*way).*slot.patch).reset();
    });
    return common;
}

/// Returns the conditions of all paths that a flow inherits at the beginning.
Conditions inherited_by(const Flow* flow, const Conditions& of_all)
{
    return flow != nullptr && flow->passes ? Conditions{} : Conditions{.mtu = of_all.mtu};
}

const Flow* find_flow(std::span<const Flow> flows, std::string_view path)
{
    const auto found = std::ranges::find(flows, parts_of(path).flow, &Flow::name);
    return found == flows.end() ? nullptr : &*found;
}

/// Removes from `own`, which is the profile of a flow, the settings that apply only to the other
/// traffic.
void leave_inherited(Profile& own, const Profile& profile, std::string_view path)
{
    const Flow* flow = find_flow(profile.flows, path);
    const auto leave = [&](Conditions Path::*way, Patch Change::*changed, Patch PathPatch::*patch) {
        own.path.*way = inherited_by(flow, profile.path.*way);
        const auto has_its_own = [&](std::string_view name) {
            const auto* found = find_patch(profile.paths, name);
            return found != nullptr && (found->*patch).mtu.has_value();
        };
        const bool inherits = !(flow != nullptr && flow->passes) && !has_its_own(path) &&
                              !has_its_own(common_name(path));
        for (Change& change : own.timeline) {
            const auto mtu = (change.*changed).mtu;
            change.*changed = Patch{};
            if (inherits) (change.*changed).mtu = mtu;
        }
    };
    leave(&Path::up, &Change::up, &PathPatch::up);
    leave(&Path::down, &Change::down, &PathPatch::down);
}

/// Returns the most frequent value of each setting; the first one, if there are several.
Conditions most_frequent(std::span<const NamedProfile> profiles, Conditions Path::*way)
{
    Conditions conditions;
    for_each_setting([&](const auto& slot) {
        std::ptrdiff_t most = 0;
        for (const auto& [path, profile] : profiles) {
            const auto& value = (profile.path.*way).*slot.value;
            const auto count = std::ranges::count_if(profiles, [&](const NamedProfile& one) {
                return (one.profile.path.*way).*slot.value == value;
            });
            if (count <= most) continue;
            most = count;
            conditions.*slot.value = value;
        }
    });
    return conditions;
}

} // namespace

Patch difference(const Conditions& before, const Conditions& after)
{
    Patch patch;
    for_each_setting([&](const auto& slot) {
        if (after.*slot.value != before.*slot.value) patch.*slot.patch = after.*slot.value;
    });
    return patch;
}

std::vector<std::string> paths_in(const Profile& profile)
{
    std::set<std::string> names;
    for (const PathPatch& one : profile.paths) names.insert(one.path);
    for (const Change& change : profile.timeline) {
        for (const PathPatch& one : change.paths) names.insert(one.path);
    }
    return {names.begin(), names.end()};
}

Profile profile_of(const Profile& profile, std::string_view path)
{
    Profile own = profile;
    own.paths.clear();
    own.flows.clear();
    const auto common = common_name(path);
    if (!common.empty()) leave_inherited(own, profile, path);
    const auto take = [&](std::string_view name) {
        if (const auto* patch = find_patch(profile.paths, name)) {
            own.path.up = patched(std::move(own.path.up), patch->up);
            own.path.down = patched(std::move(own.path.down), patch->down);
        }
        for (Change& change : own.timeline) {
            if (const auto* patch = find_patch(change.paths, name)) {
                change.up = merged(std::move(change.up), patch->up);
                change.down = merged(std::move(change.down), patch->down);
            }
        }
    };
    if (!common.empty()) take(common);
    if (path != common || path.empty()) take(path);
    for (Change& change : own.timeline) change.paths.clear();
    return own;
}

tl::expected<void, Timeline::BadChange> validate_timelines(const Profile& profile)
{
    auto valid = Timeline::validate(profile);
    for (const std::string& path : paths_in(profile)) {
        if (valid) valid = Timeline::validate(profile_of(profile, path));
    }
    return valid;
}

PathPatch& patch_for(std::vector<PathPatch>& patches, std::string_view path)
{
    const auto place = std::ranges::lower_bound(patches, path, {}, &PathPatch::path);
    if (place != patches.end() && place->path == path) return *place;
    return *patches.insert(place, PathPatch{std::string{path}, {}, {}});
}

JoinedPatch joined(std::vector<PathPatch> patches)
{
    JoinedPatch all;
    if (patches.empty()) return all;
    all.up = taken_in_common(patches, &PathPatch::up);
    all.down = taken_in_common(patches, &PathPatch::down);
    std::erase_if(patches,
                  [](const PathPatch& one) { return one.up == Patch{} && one.down == Patch{}; });
    std::ranges::sort(patches, {}, &PathPatch::path);
    all.paths = std::move(patches);
    return all;
}

namespace {

/// Joins the profiles of paths of one kind: all that carry the traffic in no flow, or all of one
/// flow.
Profile joined_of_kind(std::span<const NamedProfile> profiles)
{
    Profile all;
    if (profiles.empty()) return all;
    all.name = profiles.front().profile.name;
    all.seed = profiles.front().profile.seed;
    all.checks = profiles.front().profile.checks;
    // The key of a change: its time, its ramp, and its number among the changes of one path that
    // have both in common.
    using Key = std::tuple<base::Duration, std::size_t, base::Duration>;
    std::map<Key, std::vector<PathPatch>> changes;
    for (const auto& [path, profile] : profiles) {
        std::map<base::Duration, std::size_t> before;
        for (const Change& change : profile.timeline) {
            const Key key{change.time, before[change.time]++, change.ramp};
            changes[key].push_back({path, change.up, change.down});
        }
    }
    all.path = {most_frequent(profiles, &Path::up), most_frequent(profiles, &Path::down)};
    for (const auto& [path, profile] : profiles) {
        const PathPatch own{path, difference(all.path.up, profile.path.up),
                            difference(all.path.down, profile.path.down)};
        if (own.up != Patch{} || own.down != Patch{}) patch_for(all.paths, path) = own;
    }
    for (auto& [key, patches] : changes) {
        JoinedPatch change;
        if (patches.size() == profiles.size()) {
            change = joined(std::move(patches));
        } else {
            std::ranges::sort(patches, {}, &PathPatch::path);
            change.paths = std::move(patches);
        }
        all.timeline.push_back({std::get<0>(key), std::get<2>(key), std::move(change.up),
                                std::move(change.down), std::move(change.paths)});
    }
    return all;
}

/// Adds the conditions and the timeline of one flow's paths.
void add_flow(Profile& all, const Flow& flow, const Profile& own)
{
    const auto name = flow_path("", flow.name);
    const PathPatch patch{name, difference(inherited_by(&flow, all.path.up), own.path.up),
                          difference(inherited_by(&flow, all.path.down), own.path.down)};
    if (patch.up != Patch{} || patch.down != Patch{}) patch_for(all.paths, name) = patch;
    for (const PathPatch& one : own.paths) patch_for(all.paths, one.path) = one;
    for (const Change& change : own.timeline) {
        Change of_flow{change.time, change.ramp, {}, {}, change.paths};
        if (change.up != Patch{} || change.down != Patch{}) {
            patch_for(of_flow.paths, name) = {name, change.up, change.down};
        }
        if (!of_flow.paths.empty()) all.timeline.push_back(std::move(of_flow));
    }
}

} // namespace

Profile joined(std::span<const NamedProfile> profiles, std::span<const Flow> flows)
{
    const auto of_kind = [&](std::string_view common) {
        std::vector<NamedProfile> kind;
        for (const NamedProfile& one : profiles) {
            if (common_name(one.path) == common) kind.push_back(one);
        }
        return joined_of_kind(kind);
    };
    if (flows.empty()) return joined_of_kind(profiles);
    Profile all = of_kind("");
    all.flows.assign(flows.begin(), flows.end());
    for (const Flow& flow : flows) add_flow(all, flow, of_kind(flow_path("", flow.name)));
    std::ranges::stable_sort(all.timeline, {}, &Change::time);
    return all;
}

} // namespace hapnet::emulator
