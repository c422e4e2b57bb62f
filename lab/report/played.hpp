// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/results/results.hpp"
#include "proto/page/blocks.hpp"

#include <string>

namespace hapnet::lab::report {

/// Returns one sentence about the played sessions: algorithms, tasks, seeds, hands, and the varied
/// parameters. Empty when the manifest has no experiment that this version understands.
[[nodiscard]] std::string sentence_of(const results::Run& run);

/// Describes the network's conditions: "delay 160 ms", "A to B: ..." where the directions differ,
/// and that they change where they do. Empty for a perfect network.
[[nodiscard]] std::string network_in_words(const emulator::Profile& profile);

/// Returns the amount that was played and the amount that is intended: `played` and `meant`, each
/// with `seeds` and `duration_s`. `meant` is the amount that the built-in experiment of the same
/// title plays; `built_in` is true if there is one. For limits or claims of a user's own, `meant`
/// is the amount that settles them; other experiments have none. Returns null where the
/// configuration cannot be read.
[[nodiscard]] page::Json amounts_of(const results::Run& run);

/// Returns the title of an experiment. Empty where it has none. Also empty where the experiment has
/// axes and the built-in experiment of this title has none, since it is then another experiment.
[[nodiscard]] std::string own_title_of(const results::Run& run);

} // namespace hapnet::lab::report
