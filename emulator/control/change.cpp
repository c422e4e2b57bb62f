// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/control/change.hpp"

#include "emulator/control/moment.hpp"
#include "emulator/core/path_name.hpp"
#include "emulator/core/profile/paths.hpp"
#include "emulator/core/profile/regimes.hpp"

#include <algorithm>
#include <utility>

namespace hapnet::emulator {

Scripts::Scripts(const Profile& profile)
    : usual_{std::make_shared<const Script>(profile_of(profile, ""))}, mentioned_{paths_in(profile)}
{
    const auto add = [&](const std::string& path) {
        own_.emplace(path, std::make_shared<const Script>(profile_of(profile, path)));
    };
    for (const std::string& path : mentioned_) add(path);
    for (const Flow& flow : profile.flows) add(flow_path("", flow.name)); // if it is missing
}

const std::shared_ptr<const Script>& Scripts::of(std::string_view path) const
{
    for (const std::string_view name : {path, common_name(path)}) {
        if (const auto found = own_.find(name); found != own_.end()) return found->second;
    }
    return usual_;
}

Paths::CommandFor Scripts::command() const
{
    return [this](std::string_view path, const Path& now) -> base::Result<Command> {
        const auto& script = of(path);
        const auto same = ensure_same_regimes(script->profile().path, now);
        if (!same) return tl::unexpected{same.error()};
        return Apply{script};
    };
}

base::Result<Effect> change(Emulation& emulation, const Paths::CommandFor& command,
                            std::span<const std::string> mentioned, base::TimePoint now,
                            ChangeCause by)
{
    const Moment before = moment_of(emulation, now);
    AllPaths& paths = emulation.paths;
    base::Result<void> done;
    Effect effect;
    effect.next.reserve(before.deciders.size() + 1);
    emulation.work([&] {
        const auto generation = paths.generation();
        done = paths.apply(command, mentioned, now, by);
        effect.generation = paths.generation();
        effect.has_changed = effect.generation != generation;
        effect.elapsed = paths.elapsed();
        effect.at = std::max(now, paths.latest_now());
        for (const Paths::Named* one : paths.all()) {
            effect.next.push_back({one->name, one->path->link(Direction::up).statistics().received,
                                   one->path->link(Direction::down).statistics().received});
        }
        return true;
    });
    if (!done) return tl::unexpected{done.error()};
    return effect;
}

} // namespace hapnet::emulator
