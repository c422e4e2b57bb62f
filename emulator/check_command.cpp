// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/text.hpp"
#include "emulator/dry_run.hpp"
#include "emulator/profile_file.hpp"
#include "emulator/tools/describe.hpp"
#include "emulator/tools/predict.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

namespace {

std::string in_words(std::string_view title, const Conditions& conditions, const Stream& stream,
                     const DirectionPrediction& prediction)
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

/// The profile, and what it means as comments: the whole reads as a profile again.
base::Result<int> check_profile(const DryRun& dry_run)
{
    const auto profile = load_profile(dry_run.profile);
    if (!profile) return base::fail(profile.error().message);
    // What holds at the beginning; changes are not in it.
    const Profile beginning{profile->name, profile->seed, profile->path, {}};
    const Stream& stream = dry_run.stream;
    const auto prediction = predict(beginning, stream, seed_of(dry_run, *profile));
    const auto& [up, down] = profile->path;
    fmt::print("{}\n", to_text(*profile));
    if (up == down) {
        fmt::print("{}", in_words("both ways", up, stream, prediction.up));
    } else {
        fmt::print("{}{}", in_words("up: from A to B", up, stream, prediction.up),
                   in_words("down: from B to A", down, stream, prediction.down));
    }
    if (!profile->timeline.empty()) {
        fmt::print("# and {} changes later, the last at {:.6g} s\n", profile->timeline.size(),
                   base::to_seconds(profile->timeline.back().time));
    }
    return 0;
}

} // namespace

int check_command(std::span<char*> words)
{
    return net::run_program("hapnet-emulator check", parse_check(words), check_profile);
}

} // namespace hapnet::emulator
