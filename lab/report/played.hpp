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

/// The network's conditions in words: "delay 160 ms", "A to B: ..." where the directions differ,
/// and that it changes where it does. Empty for a perfect network.
[[nodiscard]] std::string network_in_words(const emulator::Profile& profile);

/// The amount that was played, and the amount that is meant to be: `played` and `meant`, each with
/// `seeds` and `duration_s`. `meant` is the amount that the built-in experiment of the same title
/// plays; `built_in` is true if there is one. For limits or claims of a user's own, `meant` is the
/// amount that settles them; other experiments have none. The result is null where the
/// configuration cannot be read.
[[nodiscard]] page::Json amounts_of(const results::Run& run);

/// The title of an experiment. Empty where it has none. It is also empty where the experiment has
/// axes, and the built-in experiment of this title has none: then it is another experiment.
[[nodiscard]] std::string own_title_of(const results::Run& run);

} // namespace hapnet::lab::report
