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

/// The algorithms that keep two copies of the shared body together: a closed set, by name. Each is
/// a small value that is told of every state that arrives (hear()), moves the world (tick()), and
/// forgets a run of the remote that has ended (forget()). docs/design/algorithms.md describes
/// them. SharedObject comes last: it stands for those that are no part of the program.
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

/// Returns the algorithm of a name in algorithm_names, with all defaults, or of "shared-object",
/// which names no file yet.
[[nodiscard]] base::Result<Algorithm> algorithm_named(std::string_view name);

/// "base", "sep", "dead-reckoning", ..., "shared-object"
[[nodiscard]] std::string_view name_of(const Algorithm& algorithm);

/// The treatment of states that were overtaken.
[[nodiscard]] Stale stale_of(const Algorithm& algorithm);
/// Tells it how many others there are and what this copy is like, before the first tick. Ensures
/// check_hands_of().
void prepare(Algorithm& algorithm, std::size_t others, const scene::World& world);
/// True if it puts the hands of the others into this copy of the scene.
[[nodiscard]] bool has_hands_of_others(const Algorithm& algorithm);
/// True if it can play with more than one other.
[[nodiscard]] bool plays_with_many(const Algorithm& algorithm);

/// True if it can be played: the file of one that is no part of the program has been loaded.
[[nodiscard]] bool is_loaded(const Algorithm& algorithm);

/// Refuses bodies that the algorithm cannot play; the error says why. Only remote-proxy and base
/// play several bodies, or bodies that turn. For base, only those options may then differ from
/// their defaults that also apply to such bodies.
[[nodiscard]] base::Result<void> check_bodies_of(const Algorithm& algorithm,
                                                 std::span<const SharedBody> bodies);
/// Refuses hands of the scene that the algorithm cannot play. With dry friction, which comes from
/// outside of the scene, the scene's ticks cannot be computed late or again.
[[nodiscard]] base::Result<void> check_hands_of(const Algorithm& algorithm,
                                                const scene::HandDescription& hands);

} // namespace hapnet::peer
