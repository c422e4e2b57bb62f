// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/abi/shared_object.hpp"
#include "peer/core/shared_body.hpp"
#include "peer/core/sync/base_algorithm.hpp"
#include "peer/core/sync/base_tdpa.hpp"
#include "peer/core/sync/couple.hpp"
#include "peer/core/sync/dead_reckoning.hpp"
#include "peer/core/sync/estimator_predictor.hpp"
#include "peer/core/sync/lag.hpp"
#include "peer/core/sync/remote_proxy.hpp"
#include "peer/core/sync/rollback.hpp"
#include "peer/core/sync/wave.hpp"
#include "proto/base/result.hpp"

#include <span>
#include <string_view>
#include <variant>

namespace hapnet::peer {

/// The algorithms that keep two copies of the shared body consistent. The set is closed, and each
/// has a name. Each is a small value that receives every arriving state (hear()), advances the
/// world (tick()), and forgets a run of the remote that has ended (forget()).
/// docs/design/algorithms.md describes them. SharedObject comes last: it represents those that are
/// not part of the program.
using Algorithm = std::variant<BaseAlgorithm, DeadReckoning, EstimatorPredictor, RemoteProxy,
                               BaseTdpa, Wave, Couple, Lag, Rollback, SharedObject>;

/// The names of the algorithms that are part of the program, in the order of their variant.
inline constexpr auto algorithm_names =
    base::names(base::described_name<BaseOptions>, base::described_name<DeadReckoningOptions>,
                base::described_name<EstimatorPredictorOptions>,
                base::described_name<RemoteProxyOptions>, base::described_name<BaseTdpaOptions>,
                base::described_name<WaveOptions>, base::described_name<CoupleOptions>,
                base::described_name<LagOptions>, base::described_name<RollbackOptions>);

static_assert(std::variant_size_v<Algorithm> == algorithm_names.size() + 1);

/// Returns the algorithm with a name in algorithm_names, with all defaults, or that of
/// "shared-object", which names no file yet.
[[nodiscard]] base::Result<Algorithm> algorithm_named(std::string_view name);

/// Returns "base", "sep", "dead-reckoning", ..., or "shared-object".
[[nodiscard]] std::string_view name_of(const Algorithm& algorithm);

/// Returns the algorithm's treatment of states that newer ones have overtaken.
[[nodiscard]] Stale stale_of(const Algorithm& algorithm);
/// Gives the algorithm the number of other peers and this copy of the world, before the first tick.
/// Ensures check_hands_of().
void prepare(Algorithm& algorithm, std::size_t others, const scene::World& world);
/// True if the algorithm puts the hands of the others into this copy of the scene.
[[nodiscard]] bool has_hands_of_others(const Algorithm& algorithm);
/// True if the algorithm can play with more than one other peer.
[[nodiscard]] bool plays_with_many(const Algorithm& algorithm);

/// True if the algorithm can be played, which for a SharedObject means that its file has been
/// loaded.
[[nodiscard]] bool is_loaded(const Algorithm& algorithm);

/// Refuses bodies that the algorithm cannot play; the error says why. Only remote-proxy and base
/// play several bodies, or bodies that turn. Base then refuses values other than the default in
/// options that do not apply to such bodies.
[[nodiscard]] base::Result<void> check_bodies_of(const Algorithm& algorithm,
                                                 std::span<const SharedBody> bodies);
/// Refuses hands of the scene that the algorithm cannot play. Dry friction is added from outside of
/// the scene, so ticks of the scene with it cannot be computed late or again.
[[nodiscard]] base::Result<void> check_hands_of(const Algorithm& algorithm,
                                                const scene::HandDescription& hands);

} // namespace hapnet::peer
