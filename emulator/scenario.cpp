// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/scenario.hpp"

#include "emulator/core/profile/text.hpp"
#include "emulator/core/profile/timeline.hpp"
#include "emulator/fates_file.hpp"
#include "emulator/profile_file.hpp"
#include "emulator/tools/describe.hpp"
#include "emulator/tools/netem.hpp"
#include "emulator/tools/predict.hpp"
#include "proto/base/text.hpp"
#include "proto/net/text_file.hpp"

#include <filesystem>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

namespace {

/// What --profile or --netem says, before the settings of the command line.
base::Result<Profile> profile_named(const ConditionOptions& options,
                                    std::vector<std::string>& warnings)
{
    if (options.profile && options.netem) {
        return base::fail("a profile and --netem exclude each other: give one of them");
    }
    if (options.profile) return load_profile(*options.profile);
    if (!options.netem) return Profile{};
    auto netem = tools::parse_netem(*options.netem);
    if (!netem) return base::fail(fmt::format("--netem: {}", netem.error().message));
    for (std::string& warning : netem->warnings) warnings.push_back(std::move(warning));
    Profile profile;
    profile.name = fmt::format("netem {}", *options.netem);
    profile.seed = netem->seed;
    profile.path = {netem->conditions, netem->conditions};
    return profile;
}

base::Result<Path> with_typed(const Path& path, const std::vector<TypedSetting>& typed)
{
    std::vector<Setting> settings;
    for (const auto& [key, value] : typed) {
        auto setting = parse_setting(key, value, net::text_of_file);
        if (!setting) return base::fail("--" + setting.error().message);
        settings.push_back(*std::move(setting));
    }
    return with_settings(path, settings);
}

/// What the conditions do at 1000 datagrams a second that a user may not have meant, with the
/// numbers that a prediction finds.
void warn_of_conditions(Scenario& scenario)
{
    const tools::Stream stream{.packets = 20'000};
    const Profile beginning{"", scenario.seed, scenario.profile.path, {}};
    const auto& [up, down] = beginning.path;
    if (up == Conditions{} && down == Conditions{}) return;
    const tools::Prediction prediction = predict(beginning, stream, scenario.seed);
    const auto warn = [&](const char* where, const std::vector<std::string>& warnings) {
        for (const std::string& warning : warnings) {
            scenario.warnings.push_back(fmt::format("{}: {}", where, warning));
        }
    };
    const auto of_up = warnings(up, stream, prediction.up);
    if (up == down) return warn("both ways", of_up);
    warn("up", of_up);
    warn("down", warnings(down, stream, prediction.down));
}

/// Files that laws name, by paths that hold wherever the profile is read again.
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

void make_absolute(Profile& profile, const std::string& beside)
{
    for (Conditions* way : {&profile.path.up, &profile.path.down}) {
        make_absolute(way->delay, beside);
        make_absolute(way->jitter, beside);
        make_absolute(way->loss, beside);
        make_absolute(way->rate, beside);
    }
    for (Change& change : profile.timeline) {
        for (Patch* way : {&change.up, &change.down}) {
            if (way->delay) make_absolute(*way->delay, beside);
            if (way->jitter) make_absolute(*way->jitter, beside);
            if (way->loss) make_absolute(*way->loss, beside);
            if (way->rate) make_absolute(*way->rate, beside);
        }
    }
}

} // namespace

base::Result<Profile> profile_for(const ConditionOptions& options,
                                  std::vector<std::string>& warnings)
{
    auto profile = profile_named(options, warnings);
    if (!profile) return profile;
    make_absolute(*profile, options.profile.value_or(""));
    auto path = with_typed(profile->path, options.settings);
    if (!path) return tl::unexpected{path.error()};
    profile->path = *std::move(path);
    if (const auto valid = Timeline::validate(*profile); !valid) {
        const auto& [index, message] = valid.error();
        return base::fail(fmt::format("the settings of the command line contradict change {} of "
                                      "the profile's timeline, at {}: {}",
                                      index + 1, base::to_text(profile->timeline[index].time),
                                      message));
    }
    return profile;
}

base::Seed seed_of(const ConditionOptions& options, const Profile& profile)
{
    return options.seed ? *options.seed : profile.seed.value_or(base::Seed{1});
}

base::Result<Scenario> scenario_of(const Options& options)
{
    Scenario scenario;
    auto profile = profile_for(options.conditions, scenario.warnings);
    if (!profile) return tl::unexpected{profile.error()};
    scenario.profile = *std::move(profile);
    scenario.seed = seed_of(options.conditions, scenario.profile);
    scenario.profile.seed = scenario.seed;
    scenario.checks = scenario.profile.checks;
    scenario.checks.insert(scenario.checks.end(), options.required.begin(), options.required.end());
    if (options.replay) {
        auto fates = read_fates(*options.replay);
        if (!fates) return tl::unexpected{fates.error()};
        scenario.replay = std::make_shared<const Fates>(*std::move(fates));
        scenario.warnings.emplace_back("--replay gives the fates: mtu, loss, corrupt, duplicate, "
                                       "delay, jitter and reorder are those of the file; rate and "
                                       "order hold");
    } else {
        warn_of_conditions(scenario);
    }
    return scenario;
}

} // namespace hapnet::emulator
