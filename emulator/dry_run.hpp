// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/tools/predict.hpp"
#include "proto/base/random.hpp"
#include "proto/net/program.hpp"

#include <optional>
#include <span>
#include <string>

namespace hapnet::emulator {

/// What `check` and `predict` ask for.
struct DryRun {
    std::string profile; // a file or the name of a preset
    Stream stream{};
    std::optional<base::Seed> seed; // nullopt: that of the profile, or 1
    bool as_json = false;
};

/// `hapnet-emulator check FILE|NAME`: prints the profile in canonical form, what each stage does,
/// and warnings. words[0] is "check". Gives the exit code.
[[nodiscard]] int check_command(std::span<char*> words);

/// `hapnet-emulator predict FILE|NAME --rate 1000`: prints what the profile will do to a stream.
/// words[0] is "predict". Gives the exit code.
[[nodiscard]] int predict_command(std::span<char*> words);

/// The seed that a dry run draws from.
[[nodiscard]] base::Seed seed_of(const DryRun& run, const Profile& profile);

/// The options of `check`, or of `predict`.
[[nodiscard]] net::CommandLine<DryRun> parse_check(std::span<char*> words);
[[nodiscard]] net::CommandLine<DryRun> parse_predict(std::span<char*> words);

} // namespace hapnet::emulator
