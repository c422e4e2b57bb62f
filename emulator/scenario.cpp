// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/scenario.hpp"

#include "emulator/core/profile/flows.hpp"
#include "emulator/core/profile/paths.hpp"
#include "emulator/core/profile/regimes.hpp"
#include "emulator/core/profile/text.hpp"
#include "emulator/fates_file.hpp"
#include "emulator/profile_file.hpp"
#include "emulator/tools/describe.hpp"
#include "emulator/tools/netem.hpp"
#include "emulator/tools/predict.hpp"
#include "proto/base/text.hpp"
#include "proto/net/program.hpp"
#include "proto/net/text_file.hpp"

#include <algorithm>
#include <filesystem>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

namespace {

/// Returns the profile of --profile or --netem, before the settings of the command line.
base::Result<Profile> profile_named(const ConditionOptions& options,
                                    std::vector<std::string>& warnings, const PathNames& names)
{
    if (options.profile && options.netem) {
        return base::fail("a profile and --netem exclude each other: give one of them");
    }
    if (options.profile) return load_profile(*options.profile, names, options.profile_option);
    if (!options.netem) return Profile{};
    auto netem = netem_profile(*options.netem);
    if (!netem) return base::fail(fmt::format("--netem: {}", netem.error().message));
    for (std::string& warning : netem->warnings) warnings.push_back(std::move(warning));
    return std::move(netem->profile);
}

/// Applies the settings of the command line to the profile. They override its settings.
base::Result<void> take_typed(Profile& profile, const std::vector<TypedSetting>& typed,
                              const PathNames& names)
{
    std::vector<Setting> settings;
    auto paths = paths_in(profile);
    for (const auto& [key, value, before_key] : typed) {
        auto setting = parse_setting(key, value, net::text_of_file, names);
        if (!setting) return base::fail(fmt::format("{}{}", before_key, setting.error().message));
        const bool is_known =
            setting->path.empty() || std::ranges::find(paths, setting->path) != paths.end();
        if (!is_known) paths.push_back(setting->path);
        settings.push_back(*std::move(setting));
    }
    auto all = with_settings(profile.path, settings);
    if (!all) return tl::unexpected{all.error()};
    if (auto own = ensure_own_settings(settings, "", *all); !own) return own;
    std::vector<PathPatch> patches;
    for (const std::string& path : paths) {
        const auto own = with_settings(profile_of(profile, path).path, settings, path);
        if (!own) return tl::unexpected{own.error()};
        if (auto fine = ensure_own_settings(settings, path, *own); !fine) return fine;
        const PathPatch patch{path, difference(all->up, own->up), difference(all->down, own->down)};
        if (patch.up == Patch{} && patch.down == Patch{}) continue;
        patch_for(patches, path) = patch;
    }
    profile.path = *std::move(all);
    profile.paths = std::move(patches);
    return {};
}

/// Warns of effects of the conditions at 1000 datagrams a second that a user may not have intended,
/// with the numbers of a prediction.
void warn_of_conditions(Scenario& scenario, const std::string& path)
{
    const tools::Stream stream{.packets = 20'000};
    const Profile beginning{"", scenario.seed, profile_of(scenario.profile, path).path, {}};
    const auto& [up, down] = beginning.path;
    if (up == Conditions{} && down == Conditions{}) return;
    const tools::Prediction prediction = predict(beginning, stream, scenario.seed);
    const auto warn = [&](const char* where, const std::vector<std::string>& warnings) {
        for (const std::string& warning : warnings) {
            scenario.warnings.push_back(
                fmt::format("{}{}: {}", path.empty() ? "" : path + ", ", where, warning));
        }
    };
    const auto of_up = warnings(up, stream, prediction.up);
    if (up == down) return warn("both ways", of_up);
    warn("up", of_up);
    warn("down", warnings(down, stream, prediction.down));
}

/// Makes the name of a file in a law absolute, so that it stays valid wherever the profile is read
/// again.
void make_absolute(std::string& file, const std::string& beside)
{
    file = std::filesystem::absolute(path_beside(file, beside)).lexically_normal().string();
}

void make_absolute(Variation& variation, const std::string& beside)
{
    if (auto* table = std::get_if<TableLaw>(&variation.law)) make_absolute(table->file, beside);
    if (auto* trace = std::get_if<TraceLaw>(&variation.law)) make_absolute(trace->file, beside);
}

void make_absolute(std::vector<LossLaw>& laws, const std::string& beside)
{
    for (LossLaw& law : laws) {
        if (auto* trace = std::get_if<TraceLoss>(&law)) make_absolute(trace->file, beside);
        if (auto* trace = std::get_if<TimedTraceLoss>(&law)) make_absolute(trace->file, beside);
    }
}

void make_absolute(Rate& rate, const std::string& beside)
{
    if (rate.trace) make_absolute(rate.trace->file, beside);
}

void make_absolute(Regimes& regimes, const std::string& beside);

void make_absolute(Patch& patch, const std::string& beside)
{
    if (patch.delay) make_absolute(*patch.delay, beside);
    if (patch.jitter) make_absolute(*patch.jitter, beside);
    if (patch.loss) make_absolute(*patch.loss, beside);
    if (patch.rate) make_absolute(*patch.rate, beside);
    if (patch.regimes) make_absolute(*patch.regimes, beside);
}

void make_absolute(Regimes& regimes, const std::string& beside)
{
    if (regimes.empty()) return;
    std::vector<Regime> all = regimes.all.get();
    for (Regime& regime : all) make_absolute(regime.own, beside);
    regimes.all = std::move(all);
}

/// Makes the names of files absolute in a change, or in a path.
void make_absolute(auto& patches, const std::string& beside) requires requires
{
    patches.up.delay.has_value();
}
{
    for (Patch* way : {&patches.up, &patches.down}) make_absolute(*way, beside);
}

void make_absolute(Profile& profile, const std::string& beside)
{
    for (Conditions* way : {&profile.path.up, &profile.path.down}) {
        make_absolute(way->delay, beside);
        make_absolute(way->jitter, beside);
        make_absolute(way->loss, beside);
        make_absolute(way->rate, beside);
        make_absolute(way->regimes, beside);
    }
    for (PathPatch& own : profile.paths) make_absolute(own, beside);
    for (Change& change : profile.timeline) {
        make_absolute(change, beside);
        for (PathPatch& own : change.paths) make_absolute(own, beside);
    }
}

/// Refuses fates of paths that the run does not have.
base::Result<void> replayable(const FatesOfPaths& fates, const PathNames& names)
{
    const bool is_single = names.links.empty() && !names.clients;
    const bool are_single =
        std::ranges::all_of(fates, [](const auto& of) { return parts_of(of.first).path.empty(); });
    if (are_single != is_single && !fates.empty()) {
        return base::fail(is_single ? "these are fates of several paths: replay them with the "
                                      "same --link or --upstream"
                                    : "these are fates of the only path of a run: replay them "
                                      "with --listen-a and --listen-b");
    }
    for (const auto& [path, own] : fates) {
        if (!names.contains(path)) return base::fail(names.refusal(path));
    }
    const bool has_flows =
        std::ranges::any_of(fates, [](const auto& of) { return !parts_of(of.first).flow.empty(); });
    if (!has_flows && !names.flows.empty() && !fates.empty()) {
        return base::fail("it has no fates of flows: replay it without [[flow]], as the run that "
                          "wrote it");
    }
    return {};
}

} // namespace

base::Result<TranslatedProfile> netem_profile(const std::string& sentence)
{
    auto netem = tools::parse_netem(sentence);
    if (!netem) return tl::unexpected{netem.error()};
    Profile profile;
    profile.name = fmt::format("netem {}", sentence);
    profile.seed = netem->seed;
    profile.path = {netem->conditions, netem->conditions};
    return TranslatedProfile{std::move(profile), std::move(netem->warnings)};
}

base::Result<Profile> profile_for(const ConditionOptions& options,
                                  std::vector<std::string>& warnings, const PathNames& names)
{
    auto profile = profile_named(options, warnings, names);
    if (!profile) return profile;
    make_absolute(*profile, options.profile.value_or(""));
    const PathNames all = with_flows(names, profile->flows);
    if (const auto taken = take_typed(*profile, options.settings, all); !taken) {
        return tl::unexpected{taken.error()};
    }
    if (const auto valid = validate_timelines(*profile); !valid) {
        const auto& [index, message] = valid.error();
        return base::fail(fmt::format("the settings of the command line contradict change {} of "
                                      "the profile's timeline, at {}: {}",
                                      index + 1, base::to_text(profile->timeline[index].time),
                                      message));
    }
    return profile;
}

base::Result<Profile> profile_for_path(const ConditionOptions& options, const std::string& path,
                                       std::vector<std::string>& warnings)
{
    auto profile = profile_for(options, warnings);
    if (!profile) return profile;
    const auto paths = paths_in(*profile);
    const PathNames names = with_flows({.any = true}, profile->flows);
    if (!names.contains(path)) return base::fail(names.refusal(path));
    if (path.empty()) {
        if (paths.empty()) return profile;
        if (!profile->flows.empty()) {
            net::say("hapnet-emulator",
                     fmt::format("this describes what belongs to no flow; --flow NAME describes "
                                 "one of {}",
                                 fmt::join(names.flows, ", ")));
            return profile;
        }
        net::say("hapnet-emulator",
                 fmt::format("this describes a path without conditions of its own; --link NAME "
                             "describes one of those that have some: {}",
                             fmt::join(paths, ", ")));
    } else if (parts_of(path).flow.empty() && std::ranges::find(paths, path) == paths.end()) {
        net::say("hapnet-emulator",
                 fmt::format("the profile has nothing of its own for {}: this is what holds on all "
                             "paths",
                             path));
    }
    return path.empty() ? profile : profile_of(*profile, path);
}

base::Seed seed_of(const ConditionOptions& options, const Profile& profile)
{
    return options.seed ? *options.seed : profile.seed.value_or(base::Seed{1});
}

base::Result<Scenario> scenario_of(const Options& options, const PathNames& names)
{
    Scenario scenario;
    auto profile = profile_for(options.conditions, scenario.warnings, names);
    if (!profile) return tl::unexpected{profile.error()};
    scenario.profile = *std::move(profile);
    scenario.seed = seed_of(options.conditions, scenario.profile);
    scenario.profile.seed = scenario.seed;
    scenario.checks = scenario.profile.checks;
    scenario.checks.insert(scenario.checks.end(), options.required.begin(), options.required.end());
    if (options.replay) {
        auto fates = read_fates(*options.replay);
        if (!fates) return base::fail(fmt::format("--replay: {}", fates.error().message));
        const auto fits = replayable(*fates, with_flows(names, scenario.profile.flows));
        if (!fits) {
            return base::fail(
                fmt::format("--replay: {}: {}", *options.replay, fits.error().message));
        }
        for (auto& [path, own] : *fates) {
            const auto regimes = names_of_regimes(profile_of(scenario.profile, path).path);
            auto fates_of_run = with_regimes(std::move(own), regimes[0], regimes[1]);
            if (!fates_of_run) {
                return base::fail(
                    fmt::format("--replay: {}: {}", *options.replay, fates_of_run.error().message));
            }
            own = *std::move(fates_of_run);
        }
        scenario.replay = std::make_shared<const FatesOfPaths>(*std::move(fates));
        scenario.warnings.emplace_back("--replay gives the fates: mtu, loss, corrupt, duplicate, "
                                       "delay, jitter and reorder are those of the file; rate and "
                                       "order hold");
    } else {
        warn_of_conditions(scenario, "");
        for (const PathPatch& own : scenario.profile.paths) warn_of_conditions(scenario, own.path);
    }
    return scenario;
}

} // namespace hapnet::emulator
