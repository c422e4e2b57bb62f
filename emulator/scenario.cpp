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
base::Result<Profile> base_of(const Options& options, std::vector<std::string>& warnings)
{
    if (options.profile && options.netem) {
        return base::fail("--profile and --netem exclude each other: give one of them");
    }
    if (options.profile) return load_profile(*options.profile);
    if (!options.netem) return Profile{};
    auto netem = parse_netem(*options.netem);
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
        if (!setting) {
            const std::string why = setting.error().message.substr(key.size() + 2);
            const bool quotes = why.find(value) != std::string::npos;
            return base::fail(quotes ? fmt::format("--{}: {}", key, why)
                                     : fmt::format("--{}: '{}': {}", key, value, why));
        }
        settings.push_back(*std::move(setting));
    }
    return with_settings(path, settings);
}

/// What the conditions do at 1000 datagrams a second that a user may not have meant, with the
/// numbers that a prediction finds.
void warn_of_conditions(Scenario& scenario)
{
    const Stream stream{.packets = 20'000};
    const Profile beginning{"", scenario.seed, scenario.profile.path, {}};
    const auto& [up, down] = beginning.path;
    if (up == Conditions{} && down == Conditions{}) return;
    const Prediction prediction = predict(beginning, stream, scenario.seed);
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
    }
}

void make_absolute(Profile& profile, const std::string& beside)
{
    for (Conditions* way : {&profile.path.up, &profile.path.down}) {
        make_absolute(way->delay, beside);
        make_absolute(way->jitter, beside);
        make_absolute(way->loss, beside);
    }
    for (Change& change : profile.timeline) {
        for (Patch* way : {&change.up, &change.down}) {
            if (way->delay) make_absolute(*way->delay, beside);
            if (way->jitter) make_absolute(*way->jitter, beside);
            if (way->loss) make_absolute(*way->loss, beside);
        }
    }
}

} // namespace

base::Result<Scenario> scenario_of(const Options& options)
{
    Scenario scenario;
    auto profile = base_of(options, scenario.warnings);
    if (!profile) return tl::unexpected{profile.error()};
    scenario.profile = *std::move(profile);
    make_absolute(scenario.profile, options.profile.value_or(""));
    auto path = with_typed(scenario.profile.path, options.settings);
    if (!path) return tl::unexpected{path.error()};
    scenario.profile.path = *std::move(path);
    if (const auto valid = Timeline::validate(scenario.profile); !valid) {
        const auto& [index, message] = valid.error();
        return base::fail(
            fmt::format("the options conflict with change {} of the profile's "
                        "timeline, at {}: {}",
                        index + 1, base::to_text(scenario.profile.timeline[index].time), message));
    }
    scenario.seed = options.seed.value_or(scenario.profile.seed.value_or(base::Seed{1}));
    scenario.profile.seed = scenario.seed;
    if (options.replay) {
        auto fates = read_fates(*options.replay);
        if (!fates) return tl::unexpected{fates.error()};
        scenario.replay = std::make_shared<const Fates>(*std::move(fates));
        scenario.warnings.emplace_back("--replay gives the fates: mtu, loss, corruption, copies, "
                                       "delay and jitter of the conditions are not drawn; rate "
                                       "and order hold");
    } else {
        warn_of_conditions(scenario);
    }
    return scenario;
}

} // namespace hapnet::emulator
