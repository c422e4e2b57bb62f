// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/results/results.hpp"
#include "proto/page/blocks.hpp"

#include <string>

namespace hapnet::lab::report {

/// One sentence that says what was played: algorithms, tasks, seeds, hands, and what was varied.
/// Empty when the manifest has no experiment that this version understands.
[[nodiscard]] std::string sentence_of(const results::Run& run);

/// What a network is asked to do: "delay 160 ms", "A to B: ..." where the directions differ, and
/// that it changes where it does. Empty of a perfect one.
[[nodiscard]] std::string network_in_words(const emulator::Profile& profile);

/// How much was played, and how much is meant to be: `played` and `meant`, each with `seeds` and
/// `duration_s`. Meant is what the built-in experiment of the same title plays, which `built_in`
/// says is there, or that which settles a limit or a claim of one's own. null where the
/// configuration cannot be read; without `meant` of other experiments.
[[nodiscard]] page::Json amounts_of(const results::Run& run);

/// The title of an experiment. Empty where it has none, and where an axis of one's own makes
/// another experiment of the built-in one whose title it has.
[[nodiscard]] std::string own_title_of(const results::Run& run);

} // namespace hapnet::lab::report
