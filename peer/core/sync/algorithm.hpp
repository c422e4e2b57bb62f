// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/shared_body.hpp"
#include "peer/core/sync/base_algorithm.hpp"
#include "peer/core/sync/base_tdpa.hpp"
#include "peer/core/sync/couple.hpp"
#include "peer/core/sync/dead_reckoning.hpp"
#include "peer/core/sync/estimator_predictor.hpp"
#include "peer/core/sync/remote_proxy.hpp"
#include "peer/core/sync/wave.hpp"
#include "proto/base/result.hpp"

#include <span>
#include <string_view>
#include <variant>

namespace hapnet::peer {

/// The algorithms that keep two copies of the shared body together: a closed set, by name. Each is
/// a small value that is told of every state that arrives (hear()), moves the world (tick()), and
/// forgets a run of the other side that has ended (forget()). docs/design/algorithms.md describes
/// them.
using Algorithm = std::variant<BaseAlgorithm, DeadReckoning, EstimatorPredictor, RemoteProxy,
                               BaseTdpa, Wave, Couple>;

/// The names of the algorithms, in the order of their variant.
inline constexpr auto algorithm_names =
    base::names(base::described_name<BaseOptions>, base::described_name<DeadReckoningOptions>,
                base::described_name<EstimatorPredictorOptions>,
                base::described_name<RemoteProxyOptions>, base::described_name<BaseTdpaOptions>,
                base::described_name<WaveOptions>, base::described_name<CoupleOptions>);

/// One of algorithm_names, with all defaults.
[[nodiscard]] base::Result<Algorithm> algorithm_named(std::string_view name);

/// What it does with states that were overtaken.
[[nodiscard]] Stale stale_of(const Algorithm& algorithm);
/// Tells it how many others there are, before the first tick.
void prepare(Algorithm& algorithm, std::size_t others);
/// Whether it puts the hands of the others into this copy of the scene.
[[nodiscard]] bool has_hands_of_others(const Algorithm& algorithm);
/// Whether it can play with more than one other.
[[nodiscard]] bool plays_with_many(const Algorithm& algorithm);

/// Whether it can play these bodies; the error says what it cannot. Bodies that turn, and several,
/// are for base alone, with the readings of the paper that they have, too.
[[nodiscard]] base::Result<void> check_bodies_of(const Algorithm& algorithm,
                                                 std::span<const SharedBody> bodies);

} // namespace hapnet::peer
