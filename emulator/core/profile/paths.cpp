// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/paths.hpp"

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

/// Takes what all of them set alike out of the patches of one way, and returns it.
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

/// Of each setting the value that most of them have, the first of those.
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
    if (const auto* patch = find_patch(profile.paths, path)) {
        own.path.up = patched(std::move(own.path.up), patch->up);
        own.path.down = patched(std::move(own.path.down), patch->down);
    }
    for (Change& change : own.timeline) {
        if (const auto* patch = find_patch(change.paths, path)) {
            change.up = merged(std::move(change.up), patch->up);
            change.down = merged(std::move(change.down), patch->down);
        }
        change.paths.clear();
    }
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

Profile joined(std::span<const NamedProfile> profiles)
{
    Profile all;
    if (profiles.empty()) return all;
    all.name = profiles.front().profile.name;
    all.seed = profiles.front().profile.seed;
    all.checks = profiles.front().profile.checks;
    // A change by its time, its ramp, and which of those of one path that have both alike.
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

} // namespace hapnet::emulator
