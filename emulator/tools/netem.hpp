// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "proto/base/random.hpp"
#include "proto/base/result.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator::tools {

/// The translation of a sentence of tc-netem(8) into conditions of one direction. It has a warning
/// for everything that netem would not have done as the sentence says, and for everything that is
/// done differently here.
struct NetemProfile {
    Conditions conditions;
    std::optional<base::Seed> seed;
    std::vector<std::string> warnings;
};

/// Reads "delay 80ms 5ms 25% distribution normal loss gemodel 1% 30%"; a leading "tc qdisc ...
/// netem" is skipped. An impossible setting is an error that says so; nothing is left out silently.
///
/// The sentence is translated word by word. The exceptions are:
/// - jitter reorders (order free), unless a rate keeps the order, as in netem;
/// - a correlation of delays becomes a correlation time, for packets 1 ms apart;
/// - a correlation of losses becomes Gilbert's model of the same share, in which the losses of
///   neighbours have that correlation;
/// - for `reorder P gap N`, packets that netem sends at once leave at once, and the others leave
///   their delay behind their turn; with a gap their places are drawn instead of regular;
/// - `loss state` becomes the four-state model, or Gilbert's where it is only that.
[[nodiscard]] base::Result<NetemProfile> parse_netem(std::string_view sentence);

/// Returns the share that netem really loses with a configured `share` and this correlation: the
/// stationary probability of X <= share for X = (1 - correlation) U + correlation X', U uniform, X'
/// the previous X (net/sched/sch_netem.c, get_crandom). Within 1e-4 for correlations up to 0.99.
[[nodiscard]] double netem_correlated_share(double share, double correlation);

} // namespace hapnet::emulator::tools
