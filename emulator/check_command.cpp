// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/commands.hpp"
#include "emulator/core/path_name.hpp"
#include "emulator/core/profile/paths.hpp"
#include "emulator/core/profile/text.hpp"
#include "emulator/scenario.hpp"
#include "emulator/tools/describe.hpp"
#include "emulator/tools/predict.hpp"
#include "proto/net/program.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <vector>

namespace hapnet::emulator {

namespace {

std::string in_words(std::string_view title, const Conditions& conditions,
                     const tools::Stream& stream, const tools::DirectionPrediction& prediction)
{
    std::string text = fmt::format("# {}\n", title);
    for (const auto& stage : describe(conditions, stream)) {
        text += fmt::format("#   {}\n", stage);
    }
    for (const auto& warning : warnings(conditions, stream, prediction)) {
        text += fmt::format("#   warning: {}\n", warning);
    }
    return text;
}

/// Prints the conditions of a flow when the run begins.
void print_flow(const Profile& profile, const Flow& flow, const CheckOptions& options)
{
    const Profile own = profile_of(profile, flow_path("", flow.name));
    const Profile beginning{own.name, own.seed, own.path, {}};
    const auto prediction =
        predict(beginning, options.stream, seed_of(options.conditions, profile));
    const auto& [up, down] = own.path;
    const auto print = [&](std::string_view way, const Conditions& conditions,
                           const tools::DirectionPrediction& of) {
        net::print(in_words(fmt::format("flow {}{}{}", flow.name, way,
                                        flow.passes        ? ": untouched"
                                        : flow.shares_rate ? ", and then the rate of the rest"
                                                           : ""),
                            conditions, options.stream, of));
    };
    if (up == down) return print(", both ways", up, prediction.up);
    print(", up", up, prediction.up);
    print(", down", down, prediction.down);
}

} // namespace

/// Prints the profile, and its meaning as comments. The output can be read as a profile.
base::Result<int> run(const CheckOptions& options)
{
    std::vector<std::string> netem_warnings;
    const std::string& path = options.stream.path;
    const auto profile = path.empty() ? profile_for(options.conditions, netem_warnings)
                                      : profile_for_path(options.conditions, path, netem_warnings);
    if (!profile) return tl::unexpected{profile.error()};
    // The profile at the beginning, without its changes.
    const Profile beginning{profile->name, profile->seed, profile->path, {}};
    const tools::Stream& stream = options.stream;
    const auto prediction = predict(beginning, stream, seed_of(options.conditions, *profile));
    const auto& [up, down] = profile->path;
    net::print(to_text(*profile) + "\n");
    for (const std::string& warning : netem_warnings) net::print("# warning: " + warning + "\n");
    if (up == down) {
        net::print(in_words("both ways", up, stream, prediction.up));
    } else {
        net::print(in_words(way_in_words(path, Direction::up), up, stream, prediction.up));
        net::print(in_words(way_in_words(path, Direction::down), down, stream, prediction.down));
    }
    for (const Flow& flow : profile->flows) {
        if (path.empty()) print_flow(*profile, flow, options);
    }
    const auto has_path = [](const PathPatch& own) { return !parts_of(own.path).path.empty(); };
    if (std::ranges::any_of(profile->paths, has_path)) {
        net::print(fmt::format("# where {} have nothing of their own: --link NAME describes one of "
                               "them\n",
                               fmt::join(paths_in(*profile), ", ")));
    }
    if (!profile->timeline.empty()) {
        fmt::print("# and {} changes later, the last at {:.6g} s\n", profile->timeline.size(),
                   base::to_seconds(profile->timeline.back().time));
    }
    return 0;
}

} // namespace hapnet::emulator
